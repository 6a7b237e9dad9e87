// Loops of the form LABEL .. IF condition GOTO LABEL whose condition cannot change any more once it holds.
#include <fmt/format.h>

#include <optional>

#include "check/endings.h"
#include "check/loop_drift.h"
#include "check/value_rules.h"

namespace ncport::check {

using ir::BlockId;
using ir::WordOp;
using ir::analysis::Cfg;
using ir::analysis::Edge;
using ir::analysis::EdgeKind;

namespace {

class JumpLoops final : public ValueRule {
 public:
  JumpLoops(const ValueRuleInput& input, ValueFindings& findings, const ir::analysis::FlowGraphs& graphs)
      : ValueRule(input, findings), graphs_(graphs) {}

  void Condition(const Site&, ir::ExprId condition, const Interval& truth) override {
    Interval& known = truths_.try_emplace(condition.value, Interval::None()).first->second;
    known = ir::analysis::Join(known, truth);
  }
  void Operation(const Site&, ir::ExprId expr, const Interval* operands, std::size_t count, Lookup&) override {
    sums_.Add(input_.module, expr, operands, count);
  }

  void Finish(diag::Sink& sink) override {
    for (const ir::ProgramId program : input_.module.programs.Ids()) {
      if (input_.module.programs[program].library || graphs_.Of(program).Opaque()) continue;
      for (const BlockId block : input_.module.programs[program].blocks) Look(program, block, sink);
    }
  }

 private:
  /// The jump of a block whose way on it alone decides, else null.
  [[nodiscard]] const ir::Word* OnlyJump(BlockId id) const {
    const ir::Block& block = input_.module.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0 || block.skip_level != ir::Block::kNoSkip) return nullptr;
    const ir::Word* jump = nullptr;
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = input_.module.words[word_id];
      const bool decides = word.phase == ir::Phase::kFlow || word.phase == ir::Phase::kLast ||
                           word.op == WordOp::kWhen || word.op == WordOp::kSkipRest;
      if (decides && (jump != nullptr || word.op != WordOp::kJump)) return nullptr;
      if (word.op == WordOp::kJump) jump = &word;
    }
    return jump;
  }

  [[nodiscard]] BlockId TargetOf(ir::ProgramId program, BlockId from, const ir::Word& word) const {
    const ir::Jump& jump = input_.module.jumps[word.Extra<ir::JumpId>()];
    return graphs_.LabelsOf(program).Find(jump.target, from, jump.search);
  }

  [[nodiscard]] Interval TruthOf(const ir::Word& jump) const {
    const auto truth = truths_.find(jump.value.value);
    return truth == truths_.end() ? Interval::None() : truth->second;
  }

  void Look(ir::ProgramId program, BlockId id, diag::Sink& sink) {
    const ir::Word* jump = OnlyJump(id);
    if (jump == nullptr) return;
    const BlockId first = TargetOf(program, id, *jump);
    if (!first.Valid() || first > id) return;
    // Each look goes over the body: loops nested without end would take the square of their number.
    looked_ += id.value - first.value + 1;
    if (looked_ > kMostLooked) return;
    const LoopBlocks loop{program, first, id};
    const ir::Word* way_out = jump->value.Valid() ? jump : nullptr;
    bool stays = true;  // the truth with which the loop goes on
    if (!HasNoOtherWayOut(loop, way_out, stays)) return;
    if (way_out == nullptr) return;  // a loop without a test: another rule
    const Interval truth = TruthOf(*way_out);
    if (!truth.HasNumber()) return;
    LoopDrift drift(input_.module, changes_, sums_, loop);
    const Course course = drift.Of(way_out->value, stays);
    const bool always = truth.IsPoint() && (truth.low == 1) == stays;
    const bool never = truth.IsPoint() && !always;
    // A test elsewhere than at the end may be passed by in the first pass.
    if (way_out != jump && !always) return;
    const SourceRange at = input_.module.RangeOf(input_.module.blocks[id], *jump);
    if (course == Course::kDrifts) {
      drift.Explain(sink.Report(never ? diag::Code::kJumpNeverTaken : diag::Code::kEndlessLoop, at), stays, never);
    } else if (course == Course::kStill && always) {
      sink.Report(diag::Code::kEndlessLoop, at).notes.push_back({{}, "nothing in it changes the condition"});
    } else if (always && !MayEndInside(input_.module, first, id)) {
      sink.Report(diag::Code::kEndlessLoop, at)
          .notes.push_back({{}, fmt::format("the condition is {} in each pass", stays ? "true" : "false")});
    }
  }

  /// All ways out of the loop are those of one jump with a condition. `way_out`: the jump at the end if that has one;
  /// else set to the one inside that leaves, and `stays` to the truth with which that does not.
  bool HasNoOtherWayOut(const LoopBlocks& loop, const ir::Word*& way_out, bool& stays) const {
    const Cfg& graph = graphs_.Of(loop.program);
    const auto inside = [&](const Edge& edge) {
      return edge.to.Valid() && edge.to >= loop.first && edge.to <= loop.last;
    };
    for (std::uint32_t i = loop.first.value; i <= loop.last.value; ++i) {
      const BlockId id{std::size_t{i}};
      if (Stops(id)) return false;
      for (const Edge& edge : graph.Successors(id)) {
        if (inside(edge) && edge.kind != EdgeKind::kRestart) continue;
        const ir::Word* word = OnlyJump(id);
        if (word == nullptr || !word->value.Valid() || (way_out != nullptr && way_out != word)) return false;
        const BlockId to = TargetOf(loop.program, id, *word);
        if (!to.Valid()) return false;
        const bool by_jump = edge.kind == EdgeKind::kJump && edge.to == to;
        // The text may end behind the loop.
        if (!by_jump && edge.kind != EdgeKind::kNext && edge.kind != EdgeKind::kFalse &&
            edge.kind != EdgeKind::kTextEnd)
          return false;
        way_out = word;
        stays = !by_jump;
      }
    }
    return true;
  }

  /// An operator stands at the machine and decides how often, or something is not understood.
  [[nodiscard]] bool Stops(BlockId id) const {
    const ir::Block& block = input_.module.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) return true;
    for (const ir::WordId word : block.words) {
      const WordOp op = input_.module.words[word].op;
      if (op == WordOp::kStop || op == WordOp::kOptionalStop || op == WordOp::kVerbatim) return true;
    }
    return false;
  }

  static constexpr std::uint64_t kMostLooked = 20'000'000;  // blocks of bodies, all loops of the module together

  const ir::analysis::FlowGraphs& graphs_;
  PlaceChanges changes_{input_.module};
  SumOperands sums_;
  std::unordered_map<std::uint32_t, Interval> truths_;
  std::uint64_t looked_ = 0;
};

}  // namespace

std::unique_ptr<ValueRule> MakeJumpLoops(const ValueRuleInput& input, ValueFindings& findings,
                                         const ir::analysis::FlowGraphs& graphs) {
  return std::make_unique<JumpLoops>(input, findings, graphs);
}

}  // namespace ncport::check
