#include "ir/analysis/value_flow.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "ir/block_words.h"

namespace ncport::ir::analysis {

namespace {

constexpr std::uint16_t kVisitsBeforeLandmarks = 3;
constexpr std::uint16_t kVisitsBeforeInfinity = 9;

}  // namespace

FlowPlan::FlowPlan(const Module& module, const Cfg& graph) : opaque(graph.Opaque()) {
  const IdRange<BlockId> blocks = graph.Blocks();
  heads.assign(blocks.count, kNone);
  std::vector<std::uint8_t> is_head(blocks.count, 0);
  const auto mark = [&](std::uint32_t index) {
    if (index < blocks.count) is_head[index] = 1;
  };
  mark(0);
  bool computed = false;
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    const auto ways_in = graph.Predecessors(blocks[i]);
    if (ways_in.size() != 1 || ways_in[0].value + 1 != blocks[i].value) mark(i);
    for (const Edge& edge : graph.Successors(blocks[i])) {
      if (edge.kind == EdgeKind::kComputed) computed = true;
      if (edge.to.Valid() && edge.kind != EdgeKind::kNext) mark(edge.to.value - blocks.begin);
      if (edge.kind != EdgeKind::kPartEnd) continue;
      if (i + 1 < blocks.count) {
        part_ends[i + 1].push_back(edge.to.value - blocks.begin);
      } else {
        opaque = true;  // ways past the last block of the text are not seen
      }
    }
    const Block& block = module.blocks[blocks[i]];
    if (HasWord(module, block, WordOp::kEndFor) && block.link.Valid()) {
      mark(block.link.value - blocks.begin + 1);
      mark(i + 1);
    }
  }
  if (computed) {
    for (const BlockId target : graph.ComputedTargets()) mark(target.value - blocks.begin);
  }
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    if (is_head[i] == 0 && !opaque) continue;
    heads[i] = static_cast<std::uint32_t>(positions.size());
    positions.push_back(i);
  }
}

ValueFlow::ValueFlow(const Module& module, const Machine& machine, const SlotMap& slots, const Cfg& graph,
                     const FlowPlan& plan, CallHandler& calls, Budget& budget)
    : module_(module),
      machine_(machine),
      slots_(slots),
      graph_(graph),
      plan_(plan),
      calls_(calls),
      budget_(budget),
      transfer_(module, machine, slots) {}

Interval ValueFlow::Widened(const Interval& old, const Interval& now, bool far) const {
  Interval result = now;
  if (!old.HasNumber() || !now.HasNumber()) return result;
  const std::vector<double>& marks = slots_.Landmarks();
  if (now.low < old.low) {
    const auto above = std::ranges::upper_bound(marks, now.low);
    result.low = far || above == marks.begin() ? -kInfinity : *(above - 1);
  }
  if (now.high > old.high) {
    const auto above = std::ranges::lower_bound(marks, now.high);
    result.high = far || above == marks.end() ? kInfinity : *above;
  }
  if (result.Has(Interval::kInteger)) {
    result.low = std::max(result.low, static_cast<double>(machine_.int_min));
    result.high = std::min(result.high, static_cast<double>(machine_.int_max));
  }
  // Where 0 is not among the values so far, it stays out until some way brings it.
  return result;
}

void ValueFlow::GoOne(std::uint32_t from, std::uint32_t to, const ValueState& state) {
  const std::uint32_t head = plan_.heads[to];
  if (head == FlowPlan::kNone) return;  // the chain goes there itself
  ValueState& at = (*in_)[head];
  if (mode_ == Mode::kShrink) {
    (void)JoinInto(at, state);
    return;
  }
  if (!at.reached || to > from) {
    if (!JoinInto(at, state)) return;
  } else {
    ValueState old = at;
    if (!JoinInto(at, state)) return;
    const std::uint16_t visits = ++visits_[head];
    if (visits > kVisitsBeforeLandmarks) {
      for (std::size_t i = 0; i < at.cells.size(); ++i) {
        if (at.cells[i] == old.cells[i]) continue;
        at.cells[i] = Widened(old.cells[i], at.cells[i], visits > kVisitsBeforeInfinity);
      }
    }
  }
  if (waiting_[head] != 0) return;
  waiting_[head] = 1;
  queue_.push_back(to);
  std::ranges::push_heap(queue_, std::greater<>{});
}

void ValueFlow::Go(Context& context, std::uint32_t from, std::uint32_t to, const ValueState& state) {
  if (!state.reached || mode_ == Mode::kReplay) return;
  GoOne(from, to, state);
  if (plan_.part_ends.empty()) return;
  const auto ends = plan_.part_ends.find(to);
  if (ends == plan_.part_ends.end()) return;
  for (const std::uint32_t end : ends->second) GoOne(from, end, state);
  (void)context;
}

void ValueFlow::Exit(Context& context, const ValueState& state) {
  if (!state.reached) return;
  if (mode_ != Mode::kReplay) {
    (void)JoinInto(exit_, state);
    return;
  }
  ValueState copy = state;
  transfer_.On(copy);
  transfer_.Observer()->Exit(transfer_.Site(), transfer_);
  (void)context;
}

void ValueFlow::Leave(Context& context, BlockId id, Ways& ways) {
  const IdRange<BlockId> blocks = graph_.Blocks();
  const std::uint32_t from = id.value - blocks.begin;
  const auto index = [&](BlockId block) { return block.value - blocks.begin; };
  const auto all = [&] {
    ValueState joined = ways.fall;
    for (const ValueState* state : {&ways.escaped, &ways.taken, &ways.off, &ways.left}) {
      if (state->reached) (void)JoinInto(joined, *state);
    }
    return joined;
  };
  for (const Edge& edge : graph_.Successors(id)) {
    switch (edge.kind) {
      case EdgeKind::kNext:
        Go(context, from, index(edge.to), ways.escaped);
        // Where the next block has one way in the chain carries the values on.
        if (plan_.heads[index(edge.to)] != FlowPlan::kNone) Go(context, from, index(edge.to), ways.fall);
        break;
      case EdgeKind::kJump:
      case EdgeKind::kArm:
        Go(context, from, index(edge.to), ways.taken);
        break;
      case EdgeKind::kFalse:
        Go(context, from, index(edge.to), ways.off);
        break;
      case EdgeKind::kThenEnd:
        Go(context, from, index(edge.to), ways.left);
        break;
      case EdgeKind::kBack:
        if (ways.again.reached || ways.off.reached) {
          Go(context, from, index(edge.to) + 1, ways.again);
          if (from + 1 < blocks.count) {
            Go(context, from, from + 1, ways.off);
          } else {
            Exit(context, ways.off);
          }
        } else {
          Go(context, from, index(edge.to), ways.left);
        }
        break;
      case EdgeKind::kRestart:
        Go(context, from, index(edge.to), ways.left);
        break;
      case EdgeKind::kPart:
        Go(context, from, index(edge.to), ways.part);
        break;
      case EdgeKind::kPartEnd: {
        ValueState joined = all();
        if (ways.again.reached) (void)JoinInto(joined, ways.again);
        Go(context, from, index(edge.to), joined);
        break;
      }
      case EdgeKind::kComputed: {
        const ValueState joined = all();
        for (const BlockId target : graph_.ComputedTargets()) Go(context, from, index(target), joined);
        break;
      }
      case EdgeKind::kReturn:
        if (machine_.return_in_main_restarts && context.caller == nullptr) Go(context, from, 0, ways.left);
        Exit(context, ways.left);
        break;
      case EdgeKind::kEnd:
      case EdgeKind::kReturnToTarget:
        Exit(context, ways.left);
        break;
      case EdgeKind::kTextEnd:
        Exit(context, ways.fall);
        Exit(context, ways.escaped);
        Exit(context, ways.off);
        break;
      case EdgeKind::kAlarm:
      case EdgeKind::kMissing:
        break;
    }
  }
}

/// From a head along the blocks that have one way in.
void ValueFlow::Chain(Context& context, std::uint32_t position, ValueState start) {
  const IdRange<BlockId> blocks = graph_.Blocks();
  Ways ways;
  ways.fall = std::move(start);
  for (std::uint32_t at = position;; ++at) {
    if (++budget_.steps > budget_.most) return;
    Step(context, blocks[at], ways);
    Leave(context, blocks[at], ways);
    if (at + 1 >= blocks.count || plan_.heads[at + 1] != FlowPlan::kNone) return;
    // Both ways to the next block.
    if (ways.escaped.reached) (void)JoinInto(ways.fall, ways.escaped);
    if (!ways.fall.reached) return;
    for (ValueState* state : {&ways.escaped, &ways.taken, &ways.off, &ways.left, &ways.again, &ways.part})
      state->reached = false;
  }
}

void ValueFlow::Grow(Context& context) {
  mode_ = Mode::kGrow;
  in_ = &context.in;
  visits_.assign(plan_.positions.size(), 0);
  waiting_.assign(plan_.positions.size(), 0);
  queue_.clear();
  // Blocks reached before are looked at again: what calls give may have grown.
  (void)JoinInto(context.in[0], context.entry);
  for (std::size_t i = 0; i < context.in.size(); ++i) {
    if (!context.in[i].reached) continue;
    waiting_[i] = 1;
    queue_.push_back(plan_.positions[i]);
  }
  std::ranges::make_heap(queue_, std::greater<>{});
  while (!queue_.empty() && !budget_.Spent()) {
    std::ranges::pop_heap(queue_, std::greater<>{});
    const std::uint32_t position = queue_.back();
    queue_.pop_back();
    waiting_[plan_.heads[position]] = 0;
    Chain(context, position, context.in[plan_.heads[position]]);
  }
}

/// One descending step: what the present values lead to, without the present ones. Sound, for every run stays inside
/// the present values.
void ValueFlow::Shrink(Context& context) {
  mode_ = Mode::kShrink;
  const std::vector<ValueState> present = std::move(context.in);
  std::vector<ValueState> next(present.size());
  next[0] = context.entry;
  exit_ = ValueState{};
  in_ = &next;
  for (std::size_t i = 0; i < present.size() && !budget_.Spent(); ++i) {
    if (present[i].reached) Chain(context, plan_.positions[i], present[i]);
  }
  context.in = std::move(next);
  in_ = &context.in;
}

/// Any block may follow any other: each is looked at by itself with nothing known.
void ValueFlow::Opaque(Context& context) {
  mode_ = Mode::kGrow;
  ValueState any = context.entry;
  transfer_.On(any);
  transfer_.Forget(true, true);
  for (ValueState& state : context.in) state = any;
  exit_ = any;
  visits_.assign(plan_.positions.size(), 0);
  waiting_.assign(plan_.positions.size(), 1);
  in_ = &context.in;
  const IdRange<BlockId> blocks = graph_.Blocks();
  for (const BlockId block : blocks) {
    Ways ways;
    ways.fall = any;
    if (++budget_.steps > budget_.most) return;
    Step(context, block, ways);
  }
}

void ValueFlow::Solve(Context& context) {
  if (graph_.Blocks().Empty()) {
    context.exit = context.entry;
    return;
  }
  context.in.resize(plan_.positions.size());
  transfer_.Enter(context, context.shared_references, context.keeps_locals);
  transfer_.Observe(nullptr);
  exit_ = ValueState{};
  ++context.runs;
  if (plan_.opaque || slots_.IsOpaque(context.program)) {
    // Heads of an opaque program are all blocks only if its own graph says so.
    Opaque(context);
    context.exit = exit_;
    return;
  }
  Grow(context);
  constexpr std::uint32_t kShrinkingRuns = 8;
  for (int i = 0; i < 2 && context.runs <= kShrinkingRuns; ++i) Shrink(context);
  context.exit = exit_;
}

void ValueFlow::Replay(Context& context, RangeObserver& observer) {
  if (graph_.Blocks().Empty() || !context.entry.reached) return;
  mode_ = Mode::kReplay;
  in_ = &context.in;
  transfer_.Enter(context, context.shared_references, context.keeps_locals);
  transfer_.Observe(&observer);
  if (plan_.opaque || slots_.IsOpaque(context.program)) {
    for (const BlockId block : graph_.Blocks()) {
      Ways ways;
      ways.fall = context.exit;
      ++budget_.steps;
      Step(context, block, ways);
    }
  } else {
    for (const std::uint32_t position : plan_.positions) {
      const ValueState& start = context.in[plan_.heads[position]];
      if (start.reached) Chain(context, position, start);
    }
  }
  transfer_.Observe(nullptr);
}

}  // namespace ncport::ir::analysis
