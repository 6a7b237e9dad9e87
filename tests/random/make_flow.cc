// Branches, loops and jumps. Loops count; what a body may change is forgotten where it starts.
#include <fmt/format.h>

#include <utility>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprId;
using ir::ExprOp;
using ir::Type;
using ir::WordOp;

void Maker::EmitMark(WordOp op, ExprId value, std::uint8_t number) {
  ir::BlockBuilder block = NewMark();
  Word(block, op, value, number);
  Emit(block);
}

std::uint32_t Maker::Turns() { return 1 + random_.Below(depth_ > 1 ? 3 : 5); }

const Place* Maker::TakeCounter() {
  const Place* found = nullptr;
  std::uint32_t seen = 0;
  for (Place& place : places_) {
    if (place.range == Range::kCount && !place.busy && random_.Below(++seen) == 0) found = &place;
  }
  return found;
}

ExprId Maker::CounterPlace(const Place& counter) {
  return counter.variable.Valid() ? expr_.Variable(counter.variable) : expr_.Cell(counter.space, counter.first);
}

void Maker::SetCounter(const Place& counter, double value) {
  ir::BlockBuilder block = NewBlock();
  block.Assign(CounterPlace(counter), As(Literal({value, value, true}), counter.type));
  Emit(block);
}

void Maker::StepCounter(const Place& counter) {
  ir::BlockBuilder block = NewBlock();
  const Made now{CounterPlace(counter), counter.type, BoundsOf(Range::kCount)};
  const Made one = Literal({1, 1, true});
  const Type type = counter.type == Type::kInt && one.type == Type::kInt ? Type::kInt : Type::kReal;
  const Made sum = random_.Percent(80) ? Operation(ExprOp::kAdd, now, one, type, now.range)
                                       : Operation(ExprOp::kAdd, one, now, type, now.range);
  block.Assign(CounterPlace(counter), As(sum, counter.type));
  Emit(block);
}

// True while the counter is below `turns`; sometimes with another condition that may end the loop sooner.
ExprId Maker::CounterBelow(const Place& counter, std::uint32_t turns) {
  const std::uint8_t flags = IsSinumerik() ? ir::Expr::kTolerance : std::uint8_t{0};
  const auto limit = [&](double value) { return Literal({value, value, true}).id; };
  const ExprId now = CounterPlace(counter);
  ExprId condition;
  switch (random_.Below(4)) {
    case 0:
      condition = expr_.Binary(ExprOp::kLessEqual, now, limit(turns - 1.0), flags);
      break;
    case 1:
      condition = expr_.Binary(ExprOp::kGreater, limit(turns), now, flags);
      break;
    case 2:
      condition = expr_.Binary(ExprOp::kNotEqual, now, limit(turns), flags);
      break;
    default:
      condition = expr_.Binary(ExprOp::kLess, now, limit(turns), flags);
      break;
  }
  if (Draw(Feature::kNestedConditions) && random_.Percent(60)) {
    const ExprId counted = expr_.Unary(ExprOp::kGroup, condition);
    return expr_.Binary(ExprOp::kAnd, counted, expr_.Unary(ExprOp::kGroup, Truth(1)));
  }
  return condition;
}

// The body runs up to `turns` times: it may change some groups, which nobody knows at its start then, and keeps the
// others.
template <class Body>
void Maker::Loop(std::uint32_t turns, const Body& body) {
  std::uint32_t changing = kMotionGroup | kPathGroup | kOffsetGroup;
  for (std::uint32_t group = 1; group < kAllGroups; group <<= 1U) {
    if (random_.Percent(40)) changing |= group;
  }
  changing &= ~frozen_;
  known_.Forget(changing);
  if (turns == 1 || random_.Percent(50)) known_.placed = 0;
  const Knowledge head = known_;
  const std::uint16_t outer_axes = std::exchange(turn_axes_, known_.placed);
  const std::uint32_t frozen = frozen_;
  frozen_ |= kAllGroups & ~changing;
  times_ *= turns;
  ++depth_;
  body();
  --depth_;
  times_ /= turns;
  frozen_ = frozen;
  turn_axes_ = outer_axes;
  known_.Join(head);
}

void Maker::MakeIf() {
  if (Deep()) return MakeLinear();
  EmitMark(WordOp::kIf, Truth(2));
  const Knowledge before = known_;
  ++depth_;
  Statements(1 + random_.Below(3));
  if (random_.Percent(50)) {
    const Knowledge then_end = known_;
    known_ = before;
    EmitMark(WordOp::kElse);
    Statements(random_.Below(3));
    known_.Join(then_end);
  } else {
    known_.Join(before);
  }
  --depth_;
  EmitMark(WordOp::kEndIf);
}

void Maker::MakeWhile() {
  const Place* const counter = TakeCounter();
  if (Deep() || counter == nullptr || while_depth_ >= 3) return MakeLinear();
  const Place place = *counter;
  Busy(place, true);
  const std::uint32_t turns = Turns();
  SetCounter(place, 0);
  ++while_depth_;
  // DO1 to DO3; SINUMERIK loops have no number.
  const auto number = static_cast<std::uint8_t>(IsSinumerik() ? 0 : while_depth_);
  Loop(turns, [&] {
    EmitMark(WordOp::kWhile, CounterBelow(place, turns), number);
    if (random_.Percent(30))
      StepCounter(place);
    else {
      Statements(1 + random_.Below(3));
      StepCounter(place);
      CloseTurn();
      EmitMark(WordOp::kEndWhile, {}, number);
      return;
    }
    Statements(1 + random_.Below(3));
    CloseTurn();
    EmitMark(WordOp::kEndWhile, {}, number);
  });
  --while_depth_;
  Busy(place, false);
}

void Maker::Busy(const Place& counter, bool busy) {
  for (Place& place : places_) {
    if (place.variable == counter.variable && place.space == counter.space && place.first == counter.first)
      place.busy = busy;
  }
}

void Maker::MakeFor() {
  const Place* const counter = TakeCounter();
  if (Deep() || counter == nullptr) return MakeLinear();
  const Place place = *counter;
  Busy(place, true);
  const std::uint32_t turns = Turns();
  const double first = random_.Below(4);
  Loop(turns, [&] {
    ir::BlockBuilder block = NewMark();
    // The end is a number or a value that cannot be larger; start beyond end is a loop without a turn.
    const double last = first + turns - 1;
    const Made end =
        random_.Percent(60) ? Literal({last, last, true}) : NumberIn({std::max(0.0, first - 1), last, true}, 1);
    block.For(CounterPlace(place), As(Literal({first, first, true}), place.type), As(end, place.type));
    Emit(block);
    Statements(1 + random_.Below(3));
    CloseTurn();
    EmitMark(WordOp::kEndFor);
  });
  Busy(place, false);
}

// LOOP without end, left by a jump.
void Maker::MakeLoop() {
  const Place* const counter = TakeCounter();
  if (Deep() || counter == nullptr) return MakeLinear();
  const Place place = *counter;
  Busy(place, true);
  const std::uint32_t turns = Turns();
  SetCounter(place, 0);
  Pending out = NewTarget(false);
  Loop(turns, [&] {
    EmitMark(WordOp::kLoop);
    const bool test_first = random_.Percent(50);
    const auto leave = [&] {
      StepCounter(place);
      out.known = known_;
      const std::uint8_t flags = IsSinumerik() ? ir::Expr::kTolerance : std::uint8_t{0};
      const ExprId over = expr_.Binary(ExprOp::kGreaterEqual, CounterPlace(place),
                                       Literal({double(turns), double(turns), true}).id, flags);
      EmitJump(out, over, true);
    };
    if (test_first) {
      leave();
      Statements(1 + random_.Below(3));
    } else {
      Statements(1 + random_.Below(3));
      leave();
    }
    CloseTurn();
    EmitMark(WordOp::kEndLoop);
  });
  known_ = out.known;
  PlaceLabel(out);
  Busy(place, false);
}

void Maker::MakeRepeat() {
  const Place* const counter = TakeCounter();
  if (Deep() || counter == nullptr) return MakeLinear();
  const Place place = *counter;
  Busy(place, true);
  const std::uint32_t turns = Turns();
  SetCounter(place, 0);
  Loop(turns, [&] {
    EmitMark(WordOp::kRepeat);
    Statements(1 + random_.Below(3));
    CloseTurn();
    StepCounter(place);
    const std::uint8_t flags = IsSinumerik() ? ir::Expr::kTolerance : std::uint8_t{0};
    ExprId over = expr_.Binary(ExprOp::kGreaterEqual, CounterPlace(place),
                               Literal({double(turns), double(turns), true}).id, flags);
    if (Draw(Feature::kNestedConditions))
      over = expr_.Binary(ExprOp::kOr, expr_.Unary(ExprOp::kGroup, over), expr_.Unary(ExprOp::kGroup, Truth(1)));
    EmitMark(WordOp::kUntil, over);
  });
  Busy(place, false);
}

void Maker::EmitJump(const Pending& target, ExprId condition, bool forward, bool backward) {
  ir::BlockBuilder block = NewBlock();
  ir::Jump jump;
  SetTarget(jump.target, target);
  jump.search = forward ? ir::Search::kForward : ir::Search::kBackward;
  if (backward || !IsSinumerik())
    jump.search = IsSinumerik() ? ir::Search::kForwardThenBackward : ir::Search::kForwardThenFromStart;
  jump.quiet = backward && IsSinumerik() && random_.Percent(20);
  Word(block, WordOp::kJump, condition, 0, module_.jumps.Add(jump).value);
  Emit(block);
}

void Maker::SetTarget(ir::Target& where, const Pending& target) {
  if (target.label.empty()) {
    where.kind = ir::TargetKind::kNumber;
    where.number = target.number;
    if (IsSinumerik() && Draw(Feature::kComputedTarget)) {
      where = {};
      where.kind = ir::TargetKind::kExpression;
      where.expr = expr_.Text(fmt::format("N{}", target.number));
    }
    return;
  }
  if (IsSinumerik() && Draw(Feature::kComputedTarget)) {
    // "LAB"<<7
    std::size_t digits = target.label.size();
    while (digits > 0 && target.label[digits - 1] >= '0' && target.label[digits - 1] <= '9') --digits;
    where.kind = ir::TargetKind::kExpression;
    const ExprId number = expr_.Number(target.label.substr(digits), Type::kInt);
    where.expr = expr_.Binary(ExprOp::kConcat, expr_.Text(target.label.substr(0, digits)), number);
    module_.exprs[where.expr].type = Type::kString;
    return;
  }
  where.label = module_.strings.Intern(target.label);
}

// A jump over some of what follows here or behind the statement around.
void Maker::MakeForwardJump() {
  // Out of structures, but not out of a part that is repeated by its labels.
  std::size_t frame = frames_.size() - 1;
  while (frame > 0 && !frames_[frame - 1].barrier && random_.Percent(30)) --frame;
  Pending* target = nullptr;
  for (Pending& other : frames_[frame].pending) {
    if (random_.Percent(40)) target = &other;
  }
  const ExprId condition = Draw(Feature::kPlainJump) ? ExprId{} : Truth(2);
  if (target != nullptr) {
    target->known.Join(known_);
  } else {
    Pending made = NewTarget(true);
    made.known = known_;
    frames_[frame].pending.push_back(made);
    target = &frames_[frame].pending.back();
  }
  const Pending copy = *target;
  EmitJump(copy, condition, true, !copy.label.starts_with("DOWN") && random_.Percent(25));
}

void Maker::MakeBackwardJump() {
  const Place* const counter = TakeCounter();
  if (Deep() || counter == nullptr) return MakeLinear();
  const Place place = *counter;
  Busy(place, true);
  const std::uint32_t turns = Turns();
  SetCounter(place, 0);
  Pending target = NewTarget(false);
  Loop(turns, [&] {
    target.known = known_;
    PlaceLabel(target);
    StepCounter(place);
    Statements(1 + random_.Below(3));
    CloseTurn();
    const ExprId again = CounterBelow(place, turns);
    EmitJump(target, again, false, random_.Percent(25));
  });
  Busy(place, false);
}

// B stands before A but runs after it: GOTOF L2, L1: A, GOTOF L3, L2: B, GOTOB L1, L3:
void Maker::MakeTangle() {
  if (Deep()) return MakeLinear();
  Pending first = NewTarget(false);
  Pending second = NewTarget(false);
  Pending third = NewTarget(false);
  // Nothing of what the state was may be relied on in A: B ran before it.
  Loop(1, [&] {
    second.known = known_;
    EmitJump(second, {}, true);
    first.known = known_;
    PlaceLabel(first);
    Statements(1 + random_.Below(2));
    third.known = known_;
    EmitJump(third, {}, true);
    PlaceLabel(second);
    Statements(1 + random_.Below(2));
    EmitJump(first, {}, false);
  });
  PlaceLabel(third);
}

// CASE with its parts behind it.
void Maker::MakeCase() {
  if (Deep()) return MakeLinear();
  const std::uint32_t arms = 1 + random_.Below(3);
  const bool has_default = random_.Percent(60);
  Pending end = NewTarget(false);
  std::vector<Pending> targets;
  for (std::uint32_t i = 0; i < arms + (has_default ? 1 : 0); ++i) {
    targets.push_back(NewTarget(false));
  }
  const Made value = NumberIn({-2, 6, true}, 2);
  std::vector<ir::SwitchArm> made;
  std::int64_t constant = random_.Between(-2, 1);
  for (std::uint32_t i = 0; i < targets.size(); ++i) {
    ir::Jump jump;
    jump.target.kind = targets[i].label.empty() ? ir::TargetKind::kNumber : ir::TargetKind::kLabel;
    if (targets[i].label.empty())
      jump.target.number = targets[i].number;
    else
      jump.target.label = module_.strings.Intern(targets[i].label);
    jump.search = random_.Percent(80) ? ir::Search::kForward : ir::Search::kForwardThenBackward;
    ir::SwitchArm arm;
    if (i < arms) {
      arm.value = expr_.Number(fmt::format("{}", constant), Type::kInt);
      constant += random_.Between(1, 3);
    }
    arm.jump = module_.jumps.Add(jump);
    made.push_back(arm);
  }
  ir::Switch block_switch;
  block_switch.first_arm = static_cast<std::uint32_t>(module_.switch_arms.size());
  block_switch.arm_count = static_cast<std::uint32_t>(made.size());
  module_.switch_arms.insert(module_.switch_arms.end(), made.begin(), made.end());
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kSwitch, As(value, Type::kInt), 0, module_.switches.Add(block_switch).value);
  Emit(block);
  const Knowledge before = known_;
  end.known = before;
  ++depth_;
  // Without a match and a default the run goes on behind the CASE.
  if (!has_default || random_.Percent(30)) EmitJump(end, {}, true);
  for (Pending& target : targets) {
    target.known = before;
    known_ = before;
    PlaceLabel(target);
    Statements(1 + random_.Below(2));
    end.known.Join(known_);
    EmitJump(end, {}, true);
  }
  --depth_;
  known_ = end.known;
  PlaceLabel(end);
}

// A part between labels that runs once as it is met and then some more times.
void Maker::MakeRepeatPart() {
  if (Deep() || in_part_) return MakeLinear();
  const std::uint32_t turns = 1 + random_.Below(2);
  const std::uint32_t form = random_.Below(3);
  Pending start;
  start.label = NewLabel();
  Pending end;
  end.label = NewLabel();
  ir::Part part;
  part.first.label = module_.strings.Intern(start.label);
  Loop(turns + 1, [&] {
    start.known = known_;
    PlaceLabel(start);
    frames_.emplace_back().barrier = true;
    in_part_ = true;
    ir::BlockBuilder opening = NewBlock();
    if (form == 0) {
      // The single block with the label.
      NeedUnits(opening);
      NeedDiameter(opening);
      SetMotion(opening, ir::Motion::kRapid);
      for (const std::uint8_t axis : SomeAxes(false)) AxisWord(opening, axis, random_.Percent(50), 1);
      part.single = true;
    }
    Emit(opening);
    if (form > 0) Statements(1 + random_.Below(2));
    // A label at the end of the part must not stand at the block that repeats it.
    FlushLabel();
    if (form == 2) {
      end.known = known_;
      PlaceLabel(end);
      ir::BlockBuilder closing = NewBlock();
      Emit(closing);
      part.has_last = true;
      part.last.label = module_.strings.Intern(end.label);
    }
    in_part_ = false;
    frames_.pop_back();
  });
  ir::BlockBuilder block = NewBlock();
  const ExprId count =
      turns == 1 && random_.Percent(50) ? ExprId{} : As(Literal({double(turns), double(turns), true}), Type::kInt);
  Word(block, WordOp::kRepeatPart, count, 0, module_.parts.Add(part).value);
  Emit(block);
}

// A part of this program between two labels, run again from behind it.
void Maker::MakeBlockRange() {
  if (Deep() || in_part_) return MakeLinear();
  Pending start;
  start.label = NewLabel();
  Pending end;
  end.label = NewLabel();
  Loop(2, [&] {
    start.known = known_;
    PlaceLabel(start);
    frames_.emplace_back().barrier = true;
    in_part_ = true;
    ir::BlockBuilder opening = NewBlock();
    Emit(opening);
    Statements(1 + random_.Below(2));
    end.known = known_;
    PlaceLabel(end);
    ir::BlockBuilder closing = NewBlock();
    Emit(closing);
    in_part_ = false;
    frames_.pop_back();
  });
  ir::Call call;
  call.form = ir::CallForm::kBlockRange;
  call.from.label = module_.strings.Intern(start.label);
  call.to.label = module_.strings.Intern(end.label);
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kCall, {}, 0, module_.calls.Add(call).value);
  Emit(block);
}

}  // namespace ncport::tests::random
