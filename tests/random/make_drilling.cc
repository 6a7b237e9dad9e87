// Canned drilling cycles of mills (fanuc-8.7): holes by code and by the blocks behind it, in rows, in loops, jumped
// over, with data that change on the way, under increments, polar words and other zero points.
#include <fmt/format.h>

#include <utility>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::Cycle;
using ir::CycleField;
using ir::WordOp;

namespace {

constexpr Cycle kPlain[] = {Cycle::kDrill,    Cycle::kDrill,    Cycle::kDrillDwell, Cycle::kPeck,      Cycle::kPeckChip,
                            Cycle::kBoreFeed, Cycle::kBoreStop, Cycle::kBoreDwell,  Cycle::kDrillDwell};
constexpr Cycle kTaps[] = {Cycle::kTap, Cycle::kTapLeft};
constexpr Cycle kByHand[] = {Cycle::kFineBore, Cycle::kBackBore, Cycle::kBoreManual};

constexpr bool IsPeck(Cycle cycle) { return cycle == Cycle::kPeck || cycle == Cycle::kPeckChip; }
constexpr bool HasDwell(Cycle cycle) {
  return cycle == Cycle::kDrillDwell || cycle == Cycle::kBoreDwell || cycle == Cycle::kTap ||
         cycle == Cycle::kTapLeft || cycle == Cycle::kBoreManual;
}

}  // namespace

// A word of the cycle: R in a block that names the cycle is a word of it, in the blocks behind it a radius; K there a
// centre, which counts as it is written.
void Maker::CycleWord(ir::BlockBuilder& block, CycleField field, ir::ExprId value, bool named) {
  static constexpr std::string_view kLetters[] = {"R", "Q", "P", "K"};
  if (!named && field == CycleField::kLevel) return Word(block, WordOp::kRadius, value);
  const bool by_k = field == CycleField::kRepeats && random_.Percent(70);
  if (!named && by_k) {
    block.Add(WordOp::kCenter, value, 2);
    if (module_.exprs[value].op == ir::ExprOp::kLiteral && module_.exprs[value].number != 0 &&
        (module_.exprs[value].format.flags & ir::NumberFormat::kPoint) == 0 && random_.Percent(70))
      block.Last().flags |= ir::Word::kIncrements;
    return;
  }
  Word(block, WordOp::kCycleValue, value, static_cast<std::uint8_t>(field));
  if (field == CycleField::kDwell) block.Last().flags |= ir::Word::kIncrements;
  const std::string_view letter =
      field == CycleField::kRepeats && !by_k ? "L" : kLetters[static_cast<std::size_t>(field)];
  block.Last().spelling = ir::AddSpelling(module_, letter, "fanuc-8.7");
}

// Level, depth, peck, dwell: all of them in the first block, some in later ones.
void Maker::HoleData(ir::BlockBuilder& block, Holes& holes, bool named, bool all) {
  const double unit = IsInch() ? 0.04 : 1;
  const bool steps = known_.modes.distance == ir::Distance::kIncremental;
  const auto number = [&](const Interval& range) {
    return Draw(Feature::kDrillingData) ? NumberIn(range, 1) : Literal(range);
  };
  const bool level = all || random_.Percent(20);
  if (level) {
    const Interval range = steps ? Interval{-8 * unit, -2 * unit, false} : Interval{1 * unit, 8 * unit, false};
    CycleWord(block, CycleField::kLevel, number(range).id, named);
    if (steps) AddDrift(holes.normal, 8);
  }
  // Under increments the depth counts from the level.
  if (level || random_.Percent(20)) {
    const Interval range = steps ? Interval{-30 * unit, -4 * unit, false} : Interval{-40 * unit, -5 * unit, false};
    moved_ |= static_cast<std::uint16_t>(1U << holes.normal);
    block.Axis(holes.normal, number(range).id);
  }
  const bool peck = IsPeck(holes.cycle) && (!holes.step || random_.Percent(15));
  if (peck) {
    const Interval range{3 * unit, 12 * unit, false};
    CycleWord(block, CycleField::kStep, (Draw(Feature::kDrillingPecks) ? NumberIn(range, 1) : Literal(range)).id,
              named);
    holes.step = true;
  }
  if (HasDwell(holes.cycle) && random_.Percent(all ? 80 : 20)) {
    const Interval range{100, 2000, true};
    CycleWord(block, CycleField::kDwell, (Draw(Feature::kDrillingDwell) ? NumberIn(range, 1) : Literal(range)).id,
              named);
  }
}

void Maker::HolePlace(ir::BlockBuilder& block, Holes& holes, bool both) {
  if (holes.polar) return PolarPlace(block, holes, both);
  const bool first = both || random_.Percent(70);
  for (const std::uint8_t axis : {holes.first, holes.second}) {
    if (!both && (axis == holes.first ? !first : first && random_.Percent(40))) continue;
    AxisWord(block, axis, true, 1);
  }
}

// Radius and angle. What is left out stays, where the radius is a number: a computed one may be 0.
void Maker::PolarPlace(ir::BlockBuilder& block, Holes& holes, bool both) {
  both = both || !holes.radius_kept || random_.Percent(30);
  const bool radius = both || random_.Percent(30);
  const Interval lengths{IsInch() ? 0.2 : 6, IsInch() ? 2.0 : 60, false};
  if (radius) {
    holes.radius_kept = random_.Percent(80);
    moved_ |= static_cast<std::uint16_t>(1U << holes.first);
    block.Axis(holes.first, (holes.radius_kept ? Literal(lengths) : NumberIn(lengths, 1)).id);
  }
  if (!both && radius) return;
  moved_ |= static_cast<std::uint16_t>(1U << holes.second);
  block.Axis(holes.second, NumberIn(BoundsOf(Range::kAngle), 1).id);
}

// One hole: the first one and those of a new cycle name it.
void Maker::Hole(Holes& holes, bool named, bool all) {
  ir::BlockBuilder block = NewBlock();
  const ir::ReturnLevel now = holes.level;
  if (all || random_.Percent(12)) {
    holes.level = random_.Percent(50) ? ir::ReturnLevel::kInitial : ir::ReturnLevel::kRPlane;
    if (holes.level != now || random_.Percent(50))
      Code(block, WordOp::kReturnLevel, static_cast<std::uint8_t>(holes.level));
  }
  if (named) block.Add(WordOp::kCycle, {}, static_cast<std::uint8_t>(holes.cycle));
  if (all) NeedUnits(block);
  const bool place = !all || random_.Percent(85);
  if (place) HolePlace(block, holes, holes.polar && all);
  HoleData(block, holes, named, all);
  const bool row = !holes.polar && place && random_.Percent(8);
  if (row || random_.Percent(5)) {
    const double most = row ? 1 : 2;
    const Interval range{0, most, true};
    CycleWord(block, CycleField::kRepeats, (Draw(Feature::kDrillingCount) ? NumberIn(range, 1) : Literal(range)).id,
              named);
  }
  if (all || random_.Percent(10)) AddFeed(block);
  if (random_.Percent(10)) AddBeside(block);
  Emit(block, !named && !all);
}

// G91, a row of holes by one step each, G90.
void Maker::HoleRow(Holes& holes) {
  if (holes.polar || !IsPlaced(holes.first) || !IsPlaced(holes.second)) return Hole(holes, false, false);
  const double unit = UnitFactor();
  constexpr double kMost = 4;
  if (!MayDrift(holes.first, 2 * kMost * kMost * unit) || !MayDrift(holes.second, 2 * kMost * kMost * unit))
    return Hole(holes, false, false);
  const bool same_block = random_.Percent(50);
  const std::uint32_t blocks = 1 + random_.Below(2);
  for (std::uint32_t i = 0; i < blocks; ++i) {
    if (i == 0 && !same_block) {
      ir::BlockBuilder on = NewBlock();
      SetDistance(on, ir::Distance::kIncremental);
      Emit(on);
    }
    ir::BlockBuilder block = NewBlock();
    if (i == 0 && same_block) SetDistance(block, ir::Distance::kIncremental);
    const Interval range{-kMost, kMost, false};
    for (const std::uint8_t axis : {holes.first, holes.second}) {
      if (axis == holes.second && random_.Percent(50)) continue;
      AxisValue(block, axis, ir::ValueMode::kModal, NumberIn(range, 1).id);
      AddDrift(axis, kMost * kMost * unit);
    }
    if (random_.Percent(20) && MayDrift(holes.normal, 8)) HoleData(block, holes, false, random_.Percent(50));
    CycleWord(block, CycleField::kRepeats, Literal({0, kMost, true}).id, false);
    Emit(block);
  }
  ir::BlockBuilder off = NewBlock();
  SetDistance(off, ir::Distance::kAbsolute);
  if (random_.Percent(40)) HolePlace(off, holes, false);
  Emit(off);
}

// WHILE: holes at places that its counter gives.
void Maker::HoleLoop(Holes& holes) {
  const Place* const counter = TakeCounter();
  if (Deep() || counter == nullptr || while_depth_ >= 3) return Hole(holes, false, false);
  const Place place = *counter;
  Busy(place, true);
  const std::uint32_t turns = Turns();
  SetCounter(place, 0);
  ++while_depth_;
  ++depth_;
  times_ *= turns;
  const auto number = static_cast<std::uint8_t>(while_depth_);
  EmitMark(WordOp::kWhile, CounterBelow(place, turns), number);
  ir::BlockBuilder block = NewBlock();
  const double pitch = IsInch() ? 0.5 : 9;
  for (const std::uint8_t axis : {holes.first, holes.second}) {
    if (axis == holes.second && !holes.polar && random_.Percent(60)) continue;
    const Made now{CounterPlace(place), place.type, BoundsOf(Range::kCount)};
    const Made way =
        Operation(ir::ExprOp::kMultiply, now, Literal({1, pitch, false}), ir::Type::kReal, {0, pitch * 12, false});
    const Made value =
        Operation(ir::ExprOp::kAdd, Literal({0, pitch, false}), way, ir::Type::kReal, {0, pitch * 13, false});
    moved_ |= static_cast<std::uint16_t>(1U << axis);
    block.Axis(axis, value.id);
  }
  holes.radius_kept = false;
  if (random_.Percent(20)) HoleData(block, holes, false, false);
  Emit(block);
  if (random_.Percent(30)) Hole(holes, false, false);
  if (random_.Percent(30)) Between(holes);
  StepCounter(place);
  EmitMark(WordOp::kEndWhile, {}, number);
  times_ /= turns;
  --depth_;
  --while_depth_;
  Busy(place, false);
}

// What may stand between two holes.
void Maker::Between(Holes& holes) {
  switch (random_.Below(8)) {
    case 6: {
      // Data of a block without a place, a depth or a level are not stored.
      ir::BlockBuilder block = NewBlock();
      if (random_.Percent(50)) {
        CycleWord(block, CycleField::kStep, Literal({2, 12, false}).id, false);
      } else {
        CycleWord(block, CycleField::kDwell, Literal({100, 2000, true}).id, false);
      }
      return Emit(block);
    }
    case 0:
      return MakeAux();
    case 1:
      return MakeDwell();
    case 2:
      return MakeAssign();
    case 3:
      return MakeCommentLine();
    case 4:
      return MakeSpindle();
    case 5: {
      ir::BlockBuilder block = NewBlock();
      AddFeed(block);
      return Emit(block);
    }
    default: {
      if (!Has(Feature::kWorkOffset) || !MayChange(kOffsetGroup) || holes.level != ir::ReturnLevel::kRPlane)
        return MakeCommentLine();
      // Another zero point: the next hole names its place.
      ir::BlockBuilder block = NewBlock();
      Code(block, WordOp::kWorkOffset, 0, 54 + random_.Below(6));
      Touch(kOffsetGroup);
      known_.modes.work_offset = {};
      Displace(0xFFFF);
      holes.moved_zero = true;
      HolePlace(block, holes, true);
      return Emit(block);
    }
  }
}

void Maker::NewCycle(Holes& holes) {
  if (Draw(Feature::kDrillingByHand)) {
    holes.cycle = random_.Pick(kByHand);
    holes.step = false;
  } else if (!holes.step && random_.Percent(20)) {
    holes.cycle = random_.Pick(kTaps);  // a stored peck would make it tapping with pecks
  } else {
    holes.cycle = random_.Pick(kPlain);
  }
}

void Maker::MakeDrilling() {
  if (TransverseAxis() != 0xFF) return MakeLinear();
  const bool needs_mode =
      known_.modes.feed_mode == ir::FeedMode::kUnknown || known_.modes.feed_mode == ir::FeedMode::kInverseTime;
  if ((needs_mode || !known_.feed) && !MayChange(kFeedGroup)) return MakeLinear();
  if (known_.modes.plane == ir::Plane::kUnknown && !MayChange(kPlaneGroup)) return MakeLinear();
  if (!MayChange(kMotionGroup) && known_.modes.motion == ir::Motion::kUnknown) return MakeLinear();
  Ready();
  Holes holes;
  ir::BlockBuilder start = NewBlock();
  if (known_.modes.plane == ir::Plane::kUnknown) SetPlane(start, initial_.modes.plane);
  const ir::Plane plane = known_.modes.plane;
  holes.normal = plane == ir::Plane::kXY ? 2 : plane == ir::Plane::kZX ? 1 : 0;
  holes.first = plane == ir::Plane::kXY ? 0 : plane == ir::Plane::kZX ? 2 : 1;
  holes.second = plane == ir::Plane::kXY ? 1 : plane == ir::Plane::kZX ? 0 : 2;
  NeedUnits(start);
  if (needs_mode) SetFeedMode(start, ir::FeedMode::kPerMinute);
  SetMotion(start, ir::Motion::kRapid);
  // The level at which the cycle begins, and a place: behind calls nobody knows it.
  const double unit = IsInch() ? 0.04 : 1;
  AxisValue(start, holes.normal, ir::ValueMode::kModal, NumberIn({10 * unit, 60 * unit, false}, 1).id);
  if (random_.Percent(40)) HolePlace(start, holes, true);
  Emit(start);
  if (Draw(Feature::kDrillingPolar)) {
    holes.polar = true;
    ir::BlockBuilder on = NewBlock();
    Code(on, WordOp::kPolarMode, 1);
    Emit(on);
    Displace(static_cast<std::uint16_t>(1U << holes.first | 1U << holes.second));
  }
  NewCycle(holes);
  Hole(holes, true, true);
  const std::uint32_t items = random_.Below(6);
  for (std::uint32_t i = 0; i < items; ++i) {
    switch (random_.Below(10)) {
      case 0:
        NewCycle(holes);
        Hole(holes, true, random_.Percent(30));
        break;
      case 1:
      case 2:
        Between(holes);
        break;
      case 3:
        HoleRow(holes);
        break;
      case 4:
        HoleLoop(holes);
        break;
      case 5: {
        if (Deep()) break;
        Pending over = NewTarget(false);
        over.known = known_;
        EmitJump(over, Truth(1), true);
        Hole(holes, false, false);
        holes.radius_kept = false;
        PlaceLabel(over);
        break;
      }
      default:
        Hole(holes, false, false);
        break;
    }
  }
  EndDrilling(holes);
}

// G80, or any word of motion.
void Maker::EndDrilling(const Holes& holes) {
  ir::BlockBuilder end = NewBlock();
  const bool by_motion = !holes.polar && random_.Percent(25);
  if (by_motion) {
    Code(end, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kRapid));
    if (known_.modes.motion != ir::Motion::kRapid) Touch(kMotionGroup);
    known_.modes.motion = ir::Motion::kRapid;
    AxisWord(end, holes.first, true, 1);
  } else {
    end.Add(WordOp::kCycle, {}, static_cast<std::uint8_t>(Cycle::kNone));
    if (holes.polar && random_.Percent(50)) Code(end, WordOp::kPolarMode, 0);
  }
  Emit(end);
  if (holes.polar) {
    ir::BlockBuilder off = NewBlock();
    Code(off, WordOp::kPolarMode, 0);
    Emit(off);
  }
  if (holes.moved_zero) {
    Displace(0xFFFF);
    Approach(AllAxes());
  }
}

// G52 with some axes: positions are seen from another zero point.
void Maker::MakeLocalShift() {
  if (known_.modes.units == ir::Units::kUnknown) {
    ir::BlockBuilder units = NewBlock();
    NeedUnits(units);
    Emit(units);
  }
  ir::BlockBuilder block = NewBlock();
  Code(block, WordOp::kFrame, static_cast<std::uint8_t>(ir::FrameOp::kLocalShift));
  const double most = IsInch() ? 1 : 20;
  const bool off = random_.Percent(40);
  std::vector<std::uint8_t> axes;
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    if (HasAxis(axis)) axes.push_back(axis);
  }
  if (Draw(Feature::kShiftedAxes)) axes = SomeAxes(false);
  for (const std::uint8_t axis : axes)
    block.Axis(axis, off ? expr_.Number("0.") : NumberIn({-most, most, false}, 1).id);
  Emit(block);
  Displace(0xFFFF);
  if (random_.Percent(50)) Approach(AllAxes());
}

}  // namespace ncport::tests::random
