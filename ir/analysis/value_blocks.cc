// One block: its words in the order in which a run evaluates them, and the ways out.
#include <algorithm>
#include <utility>

#include "ir/analysis/value_flow.h"

namespace ncport::ir::analysis {

bool StopsAlways(const ir::Word& alarm, const Interval& number, const Machine& machine) {
  if (alarm.index != static_cast<std::uint8_t>(AlarmKind::kByNumber))
    return alarm.index == static_cast<std::uint8_t>(AlarmKind::kStops);
  return std::ranges::none_of(machine.shown_alarms, [&](const AlarmRange& shown) {
    return number.low <= shown.last && number.high >= shown.first;
  });
}

void ValueFlow::Step(Context& context, BlockId id, Ways& ways) {
  const Block& block = module_.blocks[id];
  transfer_.On(ways.fall);
  transfer_.At(id, block.words.Empty() ? WordId{} : block.words[0]);
  if (mode_ == Mode::kReplay) transfer_.Observer()->Block(transfer_.Site(), transfer_);
  if ((block.flags & Block::kRefused) != 0) {
    // Nobody knows what it does, and its finding is reported.
    transfer_.Forget(true, true);
    ways.off = ways.taken = ways.left = ways.part = ways.fall;
    return;
  }
  if (block.skip_level != Block::kNoSkip) ways.escaped = ways.fall;
  for (const WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    if (word.phase == Phase::kFlow || word.phase == Phase::kLast) continue;
    Turn(id, word_id);
    Word(context, block, word, ways);
    if (!ways.fall.reached) return;
  }
  for (const WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    if (word.phase != Phase::kFlow) continue;
    Turn(id, word_id);
    FlowWord(context, block, word, ways);
    if (!ways.fall.reached) return;
  }
  for (const WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    if (word.phase != Phase::kLast) continue;
    transfer_.At(id, word_id);
    if (word.value.Valid()) (void)transfer_.Eval(word.value);
    (void)JoinInto(ways.left, ways.fall);
    ways.fall.reached = false;
    return;
  }
}

void ValueFlow::Turn(BlockId block, WordId word) {
  transfer_.At(block, word);
  if (mode_ == Mode::kReplay) transfer_.Observer()->WordTurn(transfer_.Site(), transfer_);
}

void ValueFlow::Word(Context& context, const Block& /*block*/, const ir::Word& word, Ways& ways) {
  Interval value;
  if (word.value.Valid()) value = transfer_.Eval(word.value);
  switch (word.op) {
    case WordOp::kAssign:
      transfer_.Store(word.Extra<ExprId>(), value);
      return;
    case WordOp::kAssignList:
      transfer_.Assign(module_.assign_lists[word.Extra<AssignListId>()]);
      return;
    case WordOp::kDefine:
      transfer_.Define(word.Extra<VariableId>());
      return;
    case WordOp::kAxisComputed:
    case WordOp::kMessage:
      if (word.Extra<ExprId>().Valid()) (void)transfer_.Eval(word.Extra<ExprId>());
      return;
    case WordOp::kAlarm:
      if (word.Extra<ExprId>().Valid()) (void)transfer_.Eval(word.Extra<ExprId>());
      if (StopsAlways(word, value, machine_)) ways.fall.reached = false;
      return;
    case WordOp::kWhen: {
      if (mode_ == Mode::kReplay) transfer_.Observer()->Condition(transfer_.Site(), word.value, Truth(value));
      ValueState no = ways.fall;
      transfer_.On(no);
      if (transfer_.Assume(word.value, false)) (void)JoinInto(ways.escaped, no);
      transfer_.On(ways.fall);
      if (!transfer_.Assume(word.value, true)) ways.fall.reached = false;
      return;
    }
    case WordOp::kSkipRest:
      (void)JoinInto(ways.escaped, ways.fall);
      return;
    case WordOp::kComputedG:
    case WordOp::kComputedM:
      // The code may be one that ends the program.
      Exit(context, ways.fall);
      transfer_.On(ways.fall);
      return;
    case WordOp::kDataSetting: {
      for (const ArgId arg : module_.calls[word.Extra<CallId>()].args) {
        if (module_.args[arg].value.Valid()) (void)transfer_.Eval(module_.args[arg].value);
      }
      return;
    }
    case WordOp::kVerbatim:
      transfer_.Forget(true, true);
      return;
    default:
      return;
  }
}

/// Splits `yes`, the present state, by the condition.
void ValueFlow::Conditional(const ir::Word& word, ValueState& yes, ValueState& no) {
  const Interval value = transfer_.Eval(word.value);
  if (mode_ == Mode::kReplay) transfer_.Observer()->Condition(transfer_.Site(), word.value, Truth(value));
  ValueState other = yes;
  transfer_.On(other);
  if (transfer_.Assume(word.value, false)) (void)JoinInto(no, other);
  transfer_.On(yes);
  if (!transfer_.Assume(word.value, true)) yes.reached = false;
}

void ValueFlow::FlowWord(Context& context, const Block& block, const ir::Word& word, Ways& ways) {
  switch (word.op) {
    case WordOp::kJump: {
      const Jump& jump = module_.jumps[word.Extra<JumpId>()];
      if (jump.target.expr.Valid()) (void)transfer_.Eval(jump.target.expr);
      if (!word.value.Valid()) {
        (void)JoinInto(ways.taken, ways.fall);
        if (!jump.quiet) ways.fall.reached = false;
        return;
      }
      ValueState stays;
      Conditional(word, ways.fall, stays);
      if (ways.fall.reached) (void)JoinInto(ways.taken, ways.fall);
      if (jump.quiet && ways.fall.reached) (void)JoinInto(stays, ways.fall);
      ways.fall = std::move(stays);
      transfer_.On(ways.fall);
      return;
    }
    case WordOp::kSwitch: {
      (void)transfer_.Eval(word.value);
      (void)JoinInto(ways.taken, ways.fall);
      const Switch& choice = module_.switches[word.Extra<SwitchId>()];
      for (std::uint32_t i = 0; i < choice.arm_count; ++i) {
        const SwitchArm& arm = module_.switch_arms[choice.first_arm + i];
        if (!arm.value.Valid() && !module_.jumps[arm.jump].quiet) ways.fall.reached = false;
      }
      return;
    }
    case WordOp::kCall:
    case WordOp::kModalCall:
      if (word.Extra<CallId>().Valid()) {
        calls_.Through(context, module_.calls[word.Extra<CallId>()], word.Extra<CallId>(),
                       word.op == WordOp::kModalCall, transfer_, mode_ != Mode::kReplay);
      }
      return;
    case WordOp::kRepeatPart:
      if (word.value.Valid()) (void)transfer_.Eval(word.value);
      ways.part = ways.fall;
      return;
    case WordOp::kIf:
    case WordOp::kWhile:
    case WordOp::kUntil:
      Conditional(word, ways.fall, ways.off);
      return;
    case WordOp::kElse:
    case WordOp::kEndWhile:
    case WordOp::kEndLoop:
      (void)JoinInto(ways.left, ways.fall);
      ways.fall.reached = false;
      return;
    case WordOp::kFor:
      return Loop(block, true, ways);
    case WordOp::kEndFor:
      if (!block.link.Valid()) return;
      Loop(module_.blocks[block.link], false, ways);
      return;
    default:
      return;
  }
}

/// FOR: start value, then the test before each pass. `first`: at the opening word; else at the closing one, where the
/// counter has moved on.
void ValueFlow::Loop(const Block& opening, bool first, Ways& ways) {
  const ir::Word* mark = nullptr;
  for (const WordId id : opening.words) {
    if (module_.words[id].op == WordOp::kFor) mark = &module_.words[id];
  }
  if (mark == nullptr) return;
  const auto id = mark->Extra<ForId>();
  const For& loop = module_.fors[id];
  const Interval step = loop.step.Valid() ? transfer_.Eval(loop.step) : Interval::Point(1);
  Interval counter;
  if (first) {
    counter = transfer_.Eval(mark->value);
    if (machine_.for_counter_rounds) counter = Rounded(VacantAsZero(counter));
  } else {
    counter = Sum(VacantAsZero(transfer_.Eval(loop.variable)), VacantAsZero(step));
    counter.flags &= static_cast<std::uint8_t>(~Interval::kInteger);
    if (!counter.HasNumber()) counter = Interval::Unknown();
  }
  const std::uint32_t end_slot = slots_.Of(id);
  Interval end = Interval::Unknown();
  if (first || !machine_.for_end_once) {
    end = VacantAsZero(transfer_.Eval(loop.end));
  } else if (end_slot != SlotMap::kNone) {
    end = ways.fall.cells[end_slot];
  }
  if (end_slot != SlotMap::kNone) ways.fall.cells[end_slot] = end;
  if (first && mode_ == Mode::kReplay) transfer_.Observer()->CountedLoop(transfer_.Site(), counter, end, step);
  transfer_.Store(loop.variable, counter);
  const double tolerance = machine_.compare_tolerance;
  const bool up = step.low >= 0;
  const bool down = step.high < 0;
  ValueState through = ways.fall;
  ValueState again = ways.fall;
  if (up || down) {
    const ExprOp in = up ? ExprOp::kLessEqual : ExprOp::kGreaterEqual;
    const ExprOp out = up ? ExprOp::kGreater : ExprOp::kLess;
    if (Compared(in, counter, end, tolerance).high != 1) again.reached = false;
    if (Compared(out, counter, end, tolerance).high != 1) through.reached = false;
    if (again.reached) {
      transfer_.On(again);
      if (!transfer_.Bind(loop.variable, Constrained(in, counter, end, tolerance))) again.reached = false;
    }
    if (through.reached) {
      transfer_.On(through);
      if (!transfer_.Bind(loop.variable, Constrained(out, counter, end, tolerance))) through.reached = false;
    }
  }
  ways.fall.reached = false;
  if (first) {
    ways.fall = std::move(again);
  } else {
    ways.again = std::move(again);
  }
  ways.off = std::move(through);
  transfer_.On(ways.fall);
}

}  // namespace ncport::ir::analysis
