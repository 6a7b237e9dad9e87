// Straight moves, dwells, threads, polar points, machine coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ValueMode;
using ir::WordOp;

void Maker::Ready() {
  if (known_.modes.feed_mode != ir::FeedMode::kUnknown || known_.modes.speed_mode != ir::SpeedMode::kUnknown) return;
  ir::BlockBuilder block = NewBlock();
  SetRpm(block);
  Emit(block);
}

void Maker::SetMotion(ir::BlockBuilder& block, ir::Motion motion) {
  if (known_.modes.motion == motion && random_.Percent(60)) return;
  Code(block, WordOp::kMotion, static_cast<std::uint8_t>(motion));
  if (known_.modes.motion != motion) Touch(kMotionGroup);
  known_.modes.motion = motion;
}

bool Maker::MayDrift(std::uint8_t axis, double mm) const {
  return drift_[axis] + static_cast<double>(times_) * mm <= drift_limit_;
}

void Maker::AddDrift(std::uint8_t axis, double mm) { drift_[axis] += static_cast<double>(times_) * mm; }

std::vector<std::uint8_t> Maker::SomeAxes(bool with_rotary) {
  std::vector<std::uint8_t> axes;
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    if (HasAxis(axis) && random_.Percent(55)) axes.push_back(axis);
  }
  if (axes.empty()) axes.push_back(random_.Percent(50) ? 0 : 2);
  if (with_rotary && Draw(Feature::kRotaryAxes)) {
    for (std::uint8_t axis = 3; axis < 6; ++axis) {
      if (HasAxis(axis) && random_.Percent(50)) axes.push_back(axis);
    }
  }
  for (std::size_t i = axes.size(); i > 1; --i)
    std::swap(axes[i - 1], axes[random_.Below(static_cast<std::uint32_t>(i))]);
  return axes;
}

void Maker::AxisValue(ir::BlockBuilder& block, std::uint8_t axis, ValueMode mode, ir::ExprId value) {
  moved_ |= static_cast<std::uint16_t>(1U << axis);
  known_.placed |= static_cast<std::uint16_t>(1U << axis);
  if (IsSinumerik() && !ir::IsRotary(axis) && axis != TransverseAxis() && Draw(Feature::kComputedAxis)) {
    block.Add(WordOp::kAxisComputed, value, 0, expr_.AxisName(axis).value);
    block.Last().mode = mode;
    return;
  }
  block.Axis(axis, value, mode);
}

void Maker::AxisLiteral(ir::BlockBuilder& block, std::uint8_t axis, ValueMode mode, double value) {
  block.Axis(axis, Literal(Interval::Point(value)).id, mode);
}

// Absolute or by a step, under whatever distance and diameter mode is in force, written in one of the ways that mean
// so.
void Maker::AxisWord(ir::BlockBuilder& block, std::uint8_t axis, bool absolute, int depth) {
  const bool transverse = axis == TransverseAxis();
  const bool transverse_machine = TransverseAxis() != 0xFF;
  const bool rotary = ir::IsRotary(axis);
  const double unit = rotary ? 1 : UnitFactor();
  double most = rotary ? 180 : AbsoluteLimit();
  absolute = absolute || !MayStep(axis);
  // A mill has G91 for steps, a lathe of system A the letters U, W and H.
  if (!IsSinumerik())
    absolute = known_.modes.distance == ir::Distance::kAbsolute &&
               (absolute || !transverse_machine || axis == 1 || axis == 3 || axis == 4);
  if (!absolute) {
    most = random_.Percent(50) ? 2 : 10;
    while (most > 0.1 && !MayDrift(axis, most * 2 * unit)) most *= 0.5;
    if (!MayDrift(axis, most * 2 * unit)) absolute = true;
    if (absolute) most = rotary ? 180 : AbsoluteLimit();
  }
  const Interval range{-most, most, false};
  const Made value = NumberIn(range, depth);
  // A step in diameters is half as far, one in radii as far as written.
  if (!absolute) AddDrift(axis, value.range.Magnitude() * unit);
  const ir::Distance wanted = absolute ? ir::Distance::kAbsolute : ir::Distance::kIncremental;
  const bool plain = known_.modes.distance == wanted;
  ValueMode mode = ValueMode::kModal;
  if (transverse && Draw(Feature::kDiameterWords)) {
    mode = absolute ? (random_.Percent(50) ? ValueMode::kAbsoluteDiameter : ValueMode::kAbsoluteRadius)
                    : (random_.Percent(50) ? ValueMode::kIncrementalDiameter : ValueMode::kIncrementalRadius);
  } else if (rotary && absolute && Has(Feature::kValueModes) && (!plain || random_.Percent(40))) {
    static constexpr ValueMode kModes[] = {ValueMode::kShortest, ValueMode::kPositive, ValueMode::kNegative,
                                           ValueMode::kAbsolute};
    mode = random_.Pick(kModes);
    if (mode != ValueMode::kAbsolute) {
      AxisValue(block, axis, mode, NumberIn({0, 359, false}, depth).id);
      return;
    }
  } else if (!plain || Draw(Feature::kValueModes)) {
    mode = absolute ? ValueMode::kAbsolute : ValueMode::kIncremental;
  }
  AxisValue(block, axis, mode, value.id);
}

void Maker::MakeRapid() {
  Ready();
  ir::BlockBuilder block = NewBlock();
  NeedUnits(block);
  NeedDiameter(block);
  SetMotion(block, ir::Motion::kRapid);
  for (const std::uint8_t axis : SomeAxes(true)) AxisWord(block, axis, random_.Percent(70), 2);
  AddBeside(block);
  Emit(block, true);
}

void Maker::MakeLinear() {
  Ready();
  ir::BlockBuilder block = NewBlock();
  if (known_.modes.distance == ir::Distance::kUnknown && random_.Percent(40)) {
    SetDistance(block, random_.Percent(50) ? ir::Distance::kAbsolute : ir::Distance::kIncremental);
  }
  NeedUnits(block);
  NeedDiameter(block);
  if (Has(Feature::kAssignBeside) && Draw(Feature::kAssignBeside)) {
    // An assignment acts before the words behind it.
    const Place* const place = PickWritable();
    if (place != nullptr && place->range != Range::kText && place->range != Range::kAxis) {
      const ir::ExprId target = PlaceExpr(*place, 0);
      block.Assign(target, ValueFor(place->range, place->type, 1));
    }
  }
  SetMotion(block, ir::Motion::kLinear);
  const bool absolute = known_.modes.distance != ir::Distance::kIncremental;
  for (const std::uint8_t axis : SomeAxes(true)) {
    AxisWord(block, axis, Has(Feature::kValueModes) || !IsSinumerik() ? random_.Percent(60) : absolute, 3);
  }
  if (Has(Feature::kPathMode) && random_.Percent(5)) Code(block, WordOp::kExactOnce);
  if (known_.feed && known_.modes.feed_mode == ir::FeedMode::kPerMinute && Draw(Feature::kFeedOnce)) {
    Word(block, WordOp::kFeedOnce, NumberIn(BoundsOf(Range::kFeed), 1).id);
  } else {
    NeedFeed(block);
  }
  AddBeside(block);
  Emit(block, true);
}

void Maker::MakeDwell() {
  ir::BlockBuilder block = NewBlock();
  if (IsSinumerik()) {
    if (Draw(Feature::kDwellRevolutions)) {
      Word(block, WordOp::kDwellRevolutions, NumberIn({1, 20, false}, 1).id);
    } else {
      Word(block, WordOp::kDwellSeconds, NumberIn({0.1, 5, false}, 1).id);
    }
  } else {
    Word(block, WordOp::kDwellSeconds, NumberIn({0.1, 5, false}, 0).id);
  }
  Emit(block, true);
}

// A way in machine coordinates; afterwards each axis is programmed again.
void Maker::MakeMachineCoords() {
  const bool plain = known_.modes.distance == ir::Distance::kAbsolute;
  if (!plain && !IsSinumerik()) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  NeedUnits(block);
  NeedDiameter(block);
  SetMotion(block, ir::Motion::kRapid);
  Code(block, WordOp::kMachineCoords);
  const std::vector<std::uint8_t> axes = SomeAxes(false);
  for (const std::uint8_t axis : axes) {
    AxisValue(block, axis, plain ? ValueMode::kModal : ValueMode::kAbsolute,
              Literal({-AbsoluteLimit(), AbsoluteLimit(), false}).id);
  }
  Emit(block);
  Displace(0xFFFF);
  Approach(axes);
}

void Maker::CloseTurn() {
  std::vector<std::uint8_t> lost;
  for (std::uint8_t axis = 0; axis < ir::kLetterAxes; ++axis) {
    if ((turn_axes_ & ~known_.placed) >> axis & 1U) lost.push_back(axis);
  }
  if (!lost.empty()) Approach(lost);
}

// Absolute words for axes whose position was lost.
void Maker::Approach(const std::vector<std::uint8_t>& axes) {
  position_known_ = false;
  ir::BlockBuilder back = NewBlock();
  SetMotion(back, ir::Motion::kRapid);
  NeedUnits(back);
  NeedDiameter(back);
  // Under a turned frame an axis alone is not enough.
  for (std::uint8_t axis = 0; axis < ir::kLetterAxes; ++axis) {
    const bool lost = std::find(axes.begin(), axes.end(), axis) != axes.end();
    if (HasAxis(axis) && (lost || (axis < 3 && known_.turned != Turned::kNo))) AxisWord(back, axis, true, 1);
  }
  Emit(back);
  position_known_ = true;
}

std::vector<std::uint8_t> Maker::AllAxes() const {
  std::vector<std::uint8_t> axes;
  for (std::uint8_t axis = 0; axis < ir::kLetterAxes; ++axis) {
    if (HasAxis(axis)) axes.push_back(axis);
  }
  return axes;
}

void Maker::MakeReference() {
  if (!ResetFrame()) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  const bool fixed = Draw(Feature::kFixedPoint);
  Code(block, WordOp::kReference,
       static_cast<std::uint8_t>(fixed ? ir::ReferenceKind::kFixedPoint : ir::ReferenceKind::kReference));
  const std::vector<std::uint8_t> axes = SomeAxes(false);
  for (const std::uint8_t axis : axes) block.Axis(axis, expr_.Number("0", ir::Type::kInt));
  Emit(block);
  Approach(axes);
}

// Two lines at a right angle in the plane with a chamfer or rounding between them.
void Maker::MakeChamfer() {
  Flat flat;
  if (!ChooseFlat(flat)) return MakeLinear();
  Ready();
  if (known_.modes.plane != flat.plane && !MayChange(kPlaneGroup)) return MakeLinear();
  ir::BlockBuilder start = NewBlock();
  if (known_.modes.plane != flat.plane) SetPlane(start, flat.plane);
  NeedUnits(start);
  NeedDiameter(start);
  SetMotion(start, ir::Motion::kLinear);
  NeedFeed(start);
  for (const std::uint8_t axis : {flat.first, flat.second}) AxisWord(start, axis, true, 1);
  Emit(start);
  const bool per_block_feed = known_.modes.feed_mode == ir::FeedMode::kInverseTime;
  origin_set_ = false;
  // Steps of 4 to 10 leave room for corners of up to 1.5.
  for (int i = 0; i < 2; ++i) {
    ir::BlockBuilder block = NewBlock();
    SetMotion(block, ir::Motion::kLinear);
    const std::uint8_t axis = i == 0 ? flat.first : flat.second;
    const Made step = Literal(random_.Percent(50) ? Interval{4, 10, false} : Interval{-10, -4, false});
    EndWord(block, axis, step, 10);
    if (i == 0) {
      static constexpr ir::ChamferKind kKinds[] = {ir::ChamferKind::kLength, ir::ChamferKind::kLeg,
                                                   ir::ChamferKind::kRound};
      const Interval size{0.1, IsInch() ? 0.4 : 1.5, false};
      Word(block, WordOp::kChamfer, (MayCompute() ? NumberIn(size, 1) : Literal(size)).id,
           static_cast<std::uint8_t>(random_.Pick(kKinds)));
    }
    if (per_block_feed) AddFeed(block);
    Emit(block);
  }
}

// One thread along the axis of a lathe or a mill, then away.
void Maker::MakeThread() {
  if (known_.modes.distance == ir::Distance::kUnknown && !MayChange(kDistanceGroup)) return MakeLinear();
  const bool keeps_feed = Draw(Feature::kFeedAcrossThread);
  if (!keeps_feed && !MayChange(kFeedGroup)) return MakeLinear();
  if (!known_.frame_clear && !ResetFrame()) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  NeedUnits(block);
  NeedDiameter(block);
  const ir::Motion motion = !Draw(Feature::kThreadVariable) ? ir::Motion::kThread
                            : random_.Percent(50)           ? ir::Motion::kThreadIncreasing
                                                            : ir::Motion::kThreadDecreasing;
  Code(block, WordOp::kMotion, static_cast<std::uint8_t>(motion));
  Touch(kMotionGroup);
  known_.modes.motion = motion;
  AxisWord(block, 2, true, 1);
  const double unit = IsInch() ? 0.04 : 1;
  if (IsSinumerik()) {
    Word(block, WordOp::kCenter, NumberIn({0.5 * unit, 4 * unit, false}, 1).id, 2);
    if (motion != ir::Motion::kThread) {
      Word(block, WordOp::kFeed, Literal({0.01 * unit, 0.1 * unit, false}).id);
      Touch(kFeedGroup);
      known_.feed = false;
    }
    if (!keeps_feed) {
      Touch(kFeedGroup);
      known_.feed = false;
    }
    if (Draw(Feature::kThreadStart)) Word(block, WordOp::kStartAngle, NumberIn({0, 359, false}, 1).id);
  } else {
    Word(block, WordOp::kFeed, NumberIn({0.5 * unit, 4 * unit, false}, 1).id);
    Touch(kFeedGroup);
    known_.feed = false;
  }
  Emit(block);
  MakeRapid();
}

// Rigid tapping in and out, or with a compensating chuck.
void Maker::MakeTap() {
  if (!known_.frame_clear && !ResetFrame()) return MakeLinear();
  ir::BlockBuilder above = NewBlock();
  NeedUnits(above);
  SetMotion(above, ir::Motion::kRapid);
  const ValueMode mode = known_.modes.distance == ir::Distance::kAbsolute ? ValueMode::kModal : ValueMode::kAbsolute;
  AxisLiteral(above, 2, mode, 2);
  Emit(above);
  if (random_.Percent(30)) {
    Ready();
    ir::BlockBuilder block = NewBlock();
    Code(block, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kTapFloating));
    AxisValue(block, 2, mode, NumberIn({-6, -1, false}, 1).id);
    NeedFeed(block);
    Emit(block);
    return;
  }
  ir::BlockBuilder orient = NewBlock();
  Word(orient, WordOp::kSpindlePosition, NumberIn({0, 359, false}, 0).id);
  Emit(orient);
  const Made lead = Literal(IsInch() ? Interval{0.02, 0.1, false} : Interval{0.5, 2, false});
  ir::BlockBuilder in = NewBlock();
  Code(in, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kTapIn));
  AxisLiteral(in, 2, mode, -4);
  Word(in, WordOp::kCenter, lead.id, 2);
  Word(in, WordOp::kSpeed, Literal({100, 600, true}).id);
  Emit(in);
  ir::BlockBuilder out = NewBlock();
  Code(out, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kTapOut));
  AxisLiteral(out, 2, mode, 2);
  Word(out, WordOp::kCenter, Literal(lead.range).id, 2);
  Emit(out);
  Touch(kMotionGroup);
  known_.modes.motion = ir::Motion::kTapOut;
  ir::BlockBuilder again = NewBlock();
  Code(again, WordOp::kSpindle, 0, static_cast<std::uint32_t>(ir::SpindleState::kCw));
  Emit(again);
}

// A pole and points by radius and angle; on mills, where both axes are lengths of one kind.
void Maker::MakePolar() {
  Flat flat;
  if (TransverseAxis() != 0xFF || !ChooseFlat(flat)) return MakeLinear();
  Ready();
  if (known_.modes.plane != flat.plane) {
    if (!MayChange(kPlaneGroup)) return MakeLinear();
    ir::BlockBuilder plane = NewBlock();
    SetPlane(plane, flat.plane);
    Emit(plane);
  }
  if (known_.modes.units == ir::Units::kUnknown || known_.modes.distance == ir::Distance::kUnknown) {
    if (known_.modes.distance == ir::Distance::kUnknown && !MayChange(kDistanceGroup)) return MakeLinear();
    ir::BlockBuilder modes = NewBlock();
    NeedUnits(modes);
    if (known_.modes.distance == ir::Distance::kUnknown) SetDistance(modes, ir::Distance::kAbsolute);
    Emit(modes);
  }
  const double most = IsInch() ? 1 : 20;
  ir::BlockBuilder pole = NewBlock();
  Code(pole, WordOp::kPole, static_cast<std::uint8_t>(ir::PoleBase::kWorkpieceZero));
  pole.Axis(flat.first, NumberIn({-most, most, false}, 1).id);
  pole.Axis(flat.second, NumberIn({-most, most, false}, 1).id);
  Emit(pole);
  Displace(0xFFFF);
  const std::uint32_t points = 1 + random_.Below(3);
  for (std::uint32_t i = 0; i < points; ++i) {
    ir::BlockBuilder block = NewBlock();
    const bool rapid = random_.Percent(30);
    SetMotion(block, rapid ? ir::Motion::kRapid : ir::Motion::kLinear);
    // The first point names both words: an angle is a step only from an angle before it.
    Word(block, WordOp::kPolarAngle, NumberIn(BoundsOf(Range::kAngle), 1).id);
    block.Last().mode = i > 0 && random_.Percent(30) ? ValueMode::kIncremental : ValueMode::kAbsolute;
    const Interval radius{0.5, most, false};
    Word(block, WordOp::kPolarRadius, (MayCompute() ? NumberIn(radius, 1) : Literal(radius)).id);
    if (random_.Percent(25) && HasAxis(flat.normal)) AxisWord(block, flat.normal, true, 1);
    if (!rapid) NeedFeed(block);
    Emit(block);
  }
}

}  // namespace ncport::tests::random
