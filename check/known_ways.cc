#include "check/known_ways.h"

#include "ir/block_words.h"

namespace ncport::check {

using ir::WordOp;
using ir::analysis::EdgeKind;
using ir::analysis::Interval;

void KnownWays::Condition(ir::BlockId block, ir::ExprId condition, const Interval& truth) {
  const auto [found, fresh] = conditions_.try_emplace(block.value, Seen{.condition = condition});
  Seen& seen = found->second;
  seen.several = seen.several || seen.condition != condition;
  seen.holds = seen.holds || !truth.HasNumber() || truth.high != 0;
  seen.fails = seen.fails || truth.HasZero() || truth.Has(Interval::kVacant);
}

void KnownWays::CountedLoop(ir::BlockId block, const Interval& start, const Interval& end, const Interval& step) {
  Loop& loop = loops_[block.value];
  const bool known = start.HasNumber() && end.HasNumber() && step.HasNumber();
  const bool up = known && step.low >= 0;
  const bool down = known && step.high < 0;
  loop.idles = loop.idles || !((up && start.high <= end.low) || (down && start.low >= end.high));
  loop.passes = loop.passes || !((up && start.low > end.high) || (down && start.high < end.low));
}

bool KnownWays::MayPass(ir::BlockId loop) const {
  const auto found = loops_.find(loop.value);
  return found == loops_.end() || found->second.passes;
}

bool KnownWays::MayIdle(ir::BlockId loop) const {
  const auto found = loops_.find(loop.value);
  return found == loops_.end() || found->second.idles;
}

bool KnownWays::MayTake(ir::BlockId block, const ir::analysis::Edge& edge) const {
  const auto found = conditions_.find(block.value);
  if (found == conditions_.end() || found->second.several) return true;
  const Seen& seen = found->second;
  const ir::Block& text = module_.blocks[block];
  for (const WordOp mark : {WordOp::kIf, WordOp::kWhile, WordOp::kUntil}) {
    const ir::Word* word = ir::FindWord(module_, text, mark);
    if (word != nullptr && word->value == seen.condition)
      return edge.kind == EdgeKind::kFalse ? seen.fails : seen.holds;
  }
  const ir::Word* jump = ir::FindWord(module_, text, WordOp::kJump);
  if (jump == nullptr || jump->value != seen.condition || module_.jumps[jump->Extra<ir::JumpId>()].quiet) return true;
  if (edge.kind == EdgeKind::kJump || edge.kind == EdgeKind::kComputed) return seen.holds;
  return edge.kind != EdgeKind::kNext || seen.fails;
}

}  // namespace ncport::check
