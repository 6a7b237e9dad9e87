#include "ir/transform/resolve_increments.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ir/analysis/flow_analyses.h"
#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/transform/drilling_flow.h"

namespace ncport::ir::transform {

namespace {

/// Whether a drilling cycle is in force: under one K is a count of holes, elsewhere a centre (fanuc-8.7).
struct HoleFlow {
  using State = std::uint8_t;
  static constexpr State kNone = 1, kHole = 2;

  const Module& module;

  [[nodiscard]] State Entry(ProgramId) const { return kNone; }
  [[nodiscard]] State Unknown(ProgramId) const { return kNone | kHole; }
  bool Join(BlockId, State& into, State from) const {
    const State old = into;
    into |= from;
    return into != old;
  }
  void Transfer(ProgramId, BlockId block, State& state) const {
    for (const WordId id : module.blocks[block].words) {
      const Word& word = module.words[id];
      if (word.op == WordOp::kMotion) state = kNone;
    }
    for (const WordId id : module.blocks[block].words) {
      const Word& word = module.words[id];
      if (word.op == WordOp::kCycle && word.extra == Id<void>::kNone) state = IsHole(word.index) ? kHole : kNone;
    }
  }
};

/// Milliseconds, thousandths of a degree or of a factor: they do not depend on any mode.
constexpr double kThousandth = 0.001;

class Pass {
 public:
  Pass(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink)
      : module_(module),
        source_(source),
        sink_(sink),
        make_(module),
        analyses_(module, source, {source.start, sub_entry}),
        flow_(analyses_.Modal()),
        hole_flow_{module},
        holes_(analyses_.Sources(), hole_flow_) {}

  bool Run() {
    const auto is_cycle = [](const Word& word) { return word.op == WordOp::kCycle; };
    if (std::ranges::any_of(module_.words.All(), is_cycle)) holes_.Run();
    for (const ProgramId program : module_.programs.Ids()) {
      for (const BlockId block : module_.programs[program].blocks) {
        state_ = flow_.At(program, block);
        for (const WordId word : module_.blocks[block].words) ResolveWord(block, word);
      }
    }
    return ok_;
  }

 private:
  void ResolveWord(BlockId block, WordId id) {
    Word word = module_.words[id];
    if (word.op == WordOp::kCall || word.op == WordOp::kModalCall) {
      if (!word.Extra<CallId>().Valid()) return;
      for (const ArgId arg : module_.calls[word.Extra<CallId>()].args) ResolveArgument(block, word, arg);
      return;
    }
    if (word.op == WordOp::kCenter && word.index == 2 && CountsHoles(block, word)) {
      word.op = WordOp::kCycleValue;
      word.index = static_cast<std::uint8_t>(CycleField::kRepeats);
      word.flags = static_cast<std::uint8_t>(word.flags & ~Word::kIncrements);
      module_.words[id] = word;
      return;
    }
    if ((word.flags & Word::kIncrements) == 0) return;
    const std::optional<double> unit = UnitOf(block, word);
    if (!unit) return;
    word.value = Scaled(word.value, *unit);
    word.flags = static_cast<std::uint8_t>(word.flags & ~Word::kIncrements);
    module_.words[id] = word;
  }

  /// K of a block that names neither a cycle nor a motion.
  bool CountsHoles(BlockId block, const Word& k) {
    const HoleFlow::State* before = holes_.Before(block);
    if (before == nullptr || *before == HoleFlow::kNone) return false;
    for (const WordId id : module_.blocks[block].words) {
      const WordOp op = module_.words[id].op;
      if (op == WordOp::kMotion || op == WordOp::kCycle) return false;
    }
    if (*before == HoleFlow::kHole) return true;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[block], k),
                 "whether a drilling cycle is in force", "K counts its holes under one and is a centre elsewhere");
    return false;
  }

  void ResolveArgument(BlockId block, const Word& word, ArgId id) {
    Arg arg = module_.args[id];
    if (!arg.increments) return;
    const bool rotary = arg.letter == 'A' || arg.letter == 'B' || arg.letter == 'C';
    const std::optional<double> unit = rotary ? source_.increment : LengthUnit(block, word);
    if (!unit) return;
    arg.value = Scaled(arg.value, *unit);
    arg.increments = false;
    module_.args[id] = arg;
  }

  std::optional<double> UnitOf(BlockId block, const Word& word) {
    switch (word.op) {
      case WordOp::kDwellSeconds:
      case WordOp::kStartAngle:
      case WordOp::kFrameFactor:
        return kThousandth;
      case WordOp::kCycleValue:
        if (word.index == static_cast<std::uint8_t>(CycleField::kDwell)) return kThousandth;
        return LengthUnit(block, word);
      case WordOp::kFrameAngle:
      case WordOp::kContourAngle:
        return source_.increment;
      case WordOp::kFeed:
        return FeedUnit(block, word);
      case WordOp::kAxis:
        if (IsRotary(word.index)) return source_.increment;
        return LengthUnit(block, word);
      default:
        return LengthUnit(block, word);
    }
  }

  /// Of a length: the least input increment, a tenth of its number under inch.
  std::optional<double> LengthUnit(BlockId block, const Word& word) {
    switch (state_.units) {
      case Units::kMm:
      case Units::kMmGeometry:
        return source_.increment;
      case Units::kInch:
      case Units::kInchGeometry:
        return source_.increment / 10;
      case Units::kUnknown:
        break;
    }
    return Unknown(block, word, "the unit of lengths (mm or inch)");
  }

  std::optional<double> FeedUnit(BlockId block, const Word& word) {
    const NumberUnits& units = source_.units;
    const auto of = [&](bool revolution, bool inch) {
      if (revolution) return inch ? units.feed_per_revolution_inch : units.feed_per_revolution;
      return inch ? units.feed_per_minute_inch : units.feed_per_minute;
    };
    const bool thread = state_.motion == Motion::kThread || state_.motion == Motion::kThreadIncreasing;
    if (!thread && state_.feed_mode == FeedMode::kInverseTime) return 1.0;
    const bool minute = !thread && state_.feed_mode != FeedMode::kPerRevolution;
    const bool revolution = thread || state_.feed_mode != FeedMode::kPerMinute;
    const bool inch = state_.units != Units::kMm && state_.units != Units::kMmGeometry;
    const bool mm = !LengthsAreInches(state_.units);
    std::optional<double> unit;
    for (const bool per_revolution : {false, true}) {
      if (per_revolution ? !revolution : !minute) continue;
      for (const bool in_inch : {false, true}) {
        if (in_inch ? !inch : !mm) continue;
        const double here = of(per_revolution, in_inch);
        if (unit && *unit != here) return Unknown(block, word, "the unit of the feed");
        unit = here;
      }
    }
    return unit;
  }

  std::nullopt_t Unknown(BlockId block, const Word& word, std::string_view what) {
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[block], word), what,
                 "a number without decimal point counts in it");
    return std::nullopt;
  }

  /// The literal keeps its digits where nothing changes.
  ExprId Scaled(ExprId value, double unit) {
    if (unit == 1) return value;
    const Expr expr = module_.exprs[value];
    if (expr.op == ExprOp::kLiteral) {
      // Steps are powers of ten: the quotient of two whole numbers is the nearest double of the decimal number.
      const double steps = std::round(1 / unit);
      const bool exact = std::fabs(steps * unit - 1) < 1e-12;
      return make_.Literal(exact ? expr.number / steps : expr.number * unit);
    }
    return make_.Binary(ExprOp::kMultiply, value, make_.Literal(unit), expr.flags);
  }

  Module& module_;
  const Machine& source_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& flow_;
  HoleFlow hole_flow_;
  analysis::ForwardFlow<HoleFlow> holes_;
  ModalState state_;
  bool ok_ = true;
};

}  // namespace

bool ResolveIncrements(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink) {
  return Pass(module, source, sub_entry, sink).Run();
}

}  // namespace ncport::ir::transform
