#include "ir/transform/round_words.h"

#include <algorithm>
#include <optional>

#include "ir/analysis/flow_analyses.h"
#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/literal_value.h"
#include "ir/ops/arithmetic.h"
#include "ir/plane_axes.h"
#include "ir/transform/adapt_expressions.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::ir::transform {

namespace {

class Pass {
 public:
  Pass(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink)
      : module_(module),
        source_(source),
        sink_(sink),
        analyses_(module, source, {source.start, sub_entry}),
        flow_(analyses_.Modal()) {}

  bool Run() {
    everywhere_ = ReadsPositions() || HasArcToPoint() || HasPolarMode();
    pecks_ = HasPecks();
    changes_unit_ = ChangesUnit();
    for (const ProgramId program : module_.programs.Ids()) {
      for (const BlockId block : module_.programs[program].blocks) {
        state_ = flow_.At(program, block);
        shifts_ = MovesZero(block);
        for (const WordId word : module_.blocks[block].words) RoundWord(block, word);
      }
    }
    return ok_;
  }

 private:
  [[nodiscard]] bool ReadsPositions() const {
    for (const Expr& expr : module_.exprs.All()) {
      if (expr.op == ExprOp::kSystem &&
          module_.systems[SystemId{std::size_t{expr.a}}].kind == SystemKind::kProgrammedPosition)
        return true;
    }
    return false;
  }

  /// An arc with an end point: whether it is a full circle, and where its centre lies, hangs on the exact positions.
  [[nodiscard]] bool HasArcToPoint() const {
    for (const ProgramId program : module_.programs.Ids()) {
      for (const BlockId block : module_.programs[program].blocks) {
        const Motion motion = flow_.At(program, block).motion;
        if (motion != Motion::kArcCw && motion != Motion::kArcCcw && motion != Motion::kUnknown) continue;
        for (const WordId word : module_.blocks[block].words) {
          if (module_.words[word].op == WordOp::kAxis) return true;
        }
      }
    }
    return false;
  }

  /// The words of a shift, or of what else moves the zero: they are taken as they are, as exec does.
  [[nodiscard]] bool MovesZero(BlockId block) const {
    for (const WordId word : module_.blocks[block].words) {
      if (module_.words[word].op == WordOp::kFrame) return true;
    }
    return false;
  }

  /// An angle is rounded by another way than the radius makes of it.
  [[nodiscard]] bool HasPolarMode() const {
    return std::ranges::any_of(module_.words.All(),
                               [](const Word& word) { return word.op == WordOp::kPolarMode && word.index != 0; });
  }

  /// How many pecks a hole has hangs on its exact depth.
  [[nodiscard]] bool HasPecks() const {
    return std::ranges::any_of(module_.words.All(), [](const Word& word) {
      const auto cycle = static_cast<Cycle>(word.index);
      return word.op == WordOp::kCycle && (cycle == Cycle::kPeck || cycle == Cycle::kPeckChip);
    });
  }

  /// Some moves may be in inches, others in millimetres.
  [[nodiscard]] bool ChangesUnit() const {
    return std::ranges::any_of(module_.words.All(), [&](const Word& word) {
      return word.op == WordOp::kUnits && word.index != static_cast<std::uint8_t>(source_.start.units);
    });
  }

  void RoundWord(BlockId block, WordId id) {
    Word word = module_.words[id];
    if (word.value.Valid()) ResolveRound(block, id, word);
    if ((word.flags & Word::kRoundsValue) == 0) return;
    word.flags = static_cast<std::uint8_t>(word.flags & ~Word::kRoundsValue);
    switch (word.op) {
      case WordOp::kSpeed:
        // A whole number.
        word.value = ExprBuilder(module_).Function(Function::kRound, {word.value});
        break;
      case WordOp::kAxis: {
        const bool absolute = word.mode == ValueMode::kAbsolute ||
                              (word.mode == ValueMode::kModal && state_.distance == Distance::kAbsolute);
        // Half an increment of an absolute word is no difference, but one of an inch is seen where millimetres follow.
        const bool coarse =
            changes_unit_ && !IsRotary(word.index) && state_.units != Units::kMm && state_.units != Units::kMmGeometry;
        const bool depth = pecks_ && (state_.plane == Plane::kUnknown || word.index == AxesOf(state_.plane).normal);
        if (shifts_ || (absolute && !everywhere_ && !coarse && !depth)) break;
        const std::optional<double> step = StepOf(block, word);
        if (step) Round(word, *step);
        break;
      }
      case WordOp::kCycleValue:
        if (!IsLength(static_cast<CycleField>(word.index))) break;
        [[fallthrough]];
      case WordOp::kCenter:
      case WordOp::kRadius: {
        const std::optional<double> step = StepOf(block, word);
        if (step) Round(word, *step);
        break;
      }
      default:
        break;
    }
    module_.words[id] = word;
  }

  /// ROUND in a word rounds to the increment of its address, whose unit is known here.
  void ResolveRound(BlockId block, WordId id, Word& word) {
    const ExprId value = RewriteExpr(module_, word.value, [&](Module& module, ExprId part) {
      const Expr expr = module.exprs[part];
      if (expr.op != ExprOp::kFunction || static_cast<Function>(expr.a) != Function::kRoundToIncrement) return part;
      const std::optional<double> step = StepOf(block, word);
      if (!step) return part;
      return ExprBuilder(module).Unary(ExprOp::kGroup, RoundedTo(module, module.Item(expr.b), *step));
    });
    if (value == word.value) return;
    word.value = value;
    module_.words[id] = word;
  }

  void Round(Word& word, double step) {
    // `-[8.]` is a number that needs none.
    const std::optional<double> number = LiteralValue(module_, word.value);
    if (number && ops::RoundToIncrement(*number, step) == *number) return;
    word.value = RoundedTo(module_, word.value, step);
  }

  std::optional<double> StepOf(BlockId block, const Word& word) {
    if (source_.word_error == WordError::kNone) return std::nullopt;
    if (source_.word_error == WordError::kTruncate) {
      // 0.29 times 1000 may be less than 290: cutting would show the noise of binary numbers.
      ok_ = false;
      sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[block], word),
                   "a computed word that the control cuts to its least increment",
                   "a control that takes the whole value");
      return std::nullopt;
    }
    if (word.op == WordOp::kAxis && IsRotary(word.index)) return source_.increment;
    if (state_.units == Units::kMm || state_.units == Units::kMmGeometry) return source_.increment;
    if (LengthsAreInches(state_.units)) return source_.increment / 10;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[block], word),
                 "the unit of lengths (mm or inch)", "the control rounds this word to it");
    return std::nullopt;
  }

  Module& module_;
  const Machine& source_;
  diag::Sink& sink_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& flow_;
  ModalState state_;
  bool everywhere_ = false;
  bool changes_unit_ = false;
  bool pecks_ = false;
  bool shifts_ = false;  // the words of the block are a shift
  bool ok_ = true;
};

}  // namespace

bool RoundWords(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink) {
  return Pass(module, source, sub_entry, sink).Run();
}

}  // namespace ncport::ir::transform
