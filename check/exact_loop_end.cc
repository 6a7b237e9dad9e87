#include <fmt/format.h>

#include <cmath>
#include <string>

#include "check/places.h"
#include "check/structure_rules.h"

namespace ncport::check {

namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

ExprId Bare(const ir::Module& module, ExprId id) {
  for (;;) {
    const Expr& expr = module.exprs[id];
    if (expr.op != ExprOp::kGroup && expr.op != ExprOp::kConvert) return id;
    id = ExprId{std::size_t{expr.a}};
  }
}

/// `place = place + 0.1`, also with minus: a step that binary numbers do not hold exactly.
bool StepsInFractions(const ir::Module& module, const ir::Word& word, const Expr& place) {
  if (word.op != WordOp::kAssign || !SamePlace(module.exprs[word.Extra<ExprId>()], place)) return false;
  const Expr& sum = module.exprs[Bare(module, word.value)];
  if (sum.op != ExprOp::kAdd && sum.op != ExprOp::kSubtract) return false;
  const Expr& left = module.exprs[Bare(module, ExprId{std::size_t{sum.a}})];
  const Expr& right = module.exprs[Bare(module, ExprId{std::size_t{sum.b}})];
  const auto fraction = [](const Expr& step) {
    // Halves, quarters and so on add up exactly.
    return step.op == ExprOp::kLiteral && step.number * 1024 != std::trunc(step.number * 1024);
  };
  return (SamePlace(left, place) && fraction(right)) || (SamePlace(right, place) && fraction(left));
}

class ExactLoopEnds {
 public:
  ExactLoopEnds(const ir::Module& module, ir::ProgramId program, const ir::analysis::FlowGraphs& graphs,
                diag::Sink& sink)
      : module_(module), program_(program), graphs_(graphs), sink_(sink) {}

  void Run() {
    for (const BlockId id : module_.programs[program_].blocks) {
      const ir::Block& block = module_.blocks[id];
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module_.words[word_id];
        switch (word.op) {
          case WordOp::kWhile:
            if (block.link.Valid()) Test(id, block.link, block, word, ExprOp::kNotEqual);
            break;
          case WordOp::kUntil:
            if (block.link.Valid()) Test(block.link, id, block, word, ExprOp::kEqual);
            break;
          case WordOp::kJump:
            JumpBack(id, block, word);
            break;
          case WordOp::kFor:
            Start(block, word);
            break;
          default:
            break;
        }
      }
    }
  }

 private:
  /// `ends_by`: the comparison with which a loop goes on (WHILE) or ends (UNTIL) by one value alone.
  void Test(BlockId first, BlockId last, const ir::Block& block, const ir::Word& word, ExprOp ends_by) {
    if (!word.value.Valid()) return;
    const Expr& test = module_.exprs[Bare(module_, word.value)];
    if (test.op != ends_by) return;
    const ExprId sides[2] = {Bare(module_, ExprId{std::size_t{test.a}}), Bare(module_, ExprId{std::size_t{test.b}})};
    for (int side = 0; side < 2; ++side) {
      const Expr& place = module_.exprs[sides[side]];
      if (!IsPlace(place)) continue;
      for (std::uint32_t i = first.value; i <= last.value; ++i) {
        for (const ir::WordId id : module_.blocks[BlockId{std::size_t{i}}].words) {
          if (!StepsInFractions(module_, module_.words[id], place)) continue;
          diag::Diagnostic& finding =
              sink_.Report(diag::Code::kExactLoopEnd, module_.RangeOf(block, word), NameOfPlace(module_, place),
                           EndText(module_.exprs[sides[1 - side]]));
          finding.notes.push_back({module_.RangeOf(module_.blocks[BlockId{std::size_t{i}}], module_.words[id]),
                                   "its steps are no exact binary numbers"});
          finding.help = "compare with < or >, or count in whole numbers";
          return;
        }
      }
    }
  }

  [[nodiscard]] std::string EndText(const Expr& end) const {
    if (end.op == ExprOp::kLiteral) return fmt::format("{:.10g}", end.number);
    return IsPlace(end) ? NameOfPlace(module_, end) : "its end";
  }

  /// `IF [#1 NE 5] GOTO 10` with N10 above it is a loop as well.
  void JumpBack(BlockId id, const ir::Block& block, const ir::Word& word) {
    if (!word.value.Valid()) return;
    const ir::Jump& jump = module_.jumps[word.Extra<ir::JumpId>()];
    const BlockId first = graphs_.LabelsOf(program_).Find(jump.target, id, jump.search);
    if (!first.Valid() || first > id) return;
    looked_ += id.value - first.value;
    if (looked_ <= kMostLooked) Test(first, id, block, word, ExprOp::kNotEqual);
  }

  /// The control rounds the counter when the loop starts.
  void Start(const ir::Block& block, const ir::Word& word) {
    if (!word.value.Valid()) return;
    const Expr& start = module_.exprs[Bare(module_, word.value)];
    if (start.op != ExprOp::kLiteral || start.number == std::trunc(start.number)) return;
    const Expr& counter = module_.exprs[Bare(module_, module_.fors[word.Extra<ir::ForId>()].variable)];
    if (counter.op == ExprOp::kVariable &&
        module_.variables[ir::VariableId{std::size_t{counter.a}}].type == ir::Type::kInt)
      return;  // the conversion says it
    sink_.Report(diag::Code::kLostFraction, module_.RangeOf(block, word.value), fmt::format("{:.6g}", start.number),
                 fmt::format("{:.0f}", std::round(start.number)));
  }

  const ir::Module& module_;
  static constexpr std::uint64_t kMostLooked = 5'000'000;  // blocks, all jumps of the program together

  ir::ProgramId program_;
  const ir::analysis::FlowGraphs& graphs_;
  diag::Sink& sink_;
  std::uint64_t looked_ = 0;
};

}  // namespace

void CheckExactLoopEnds(const ir::Module& module, ir::ProgramId program, const ir::analysis::FlowGraphs& graphs,
                        diag::Sink& sink) {
  ExactLoopEnds{module, program, graphs, sink}.Run();
}

}  // namespace ncport::check
