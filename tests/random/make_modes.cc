// Modal words: planes, distances, units, feeds, diameters, frames, work offsets.
#include <fmt/format.h>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::WordOp;

namespace {
template <class Mode>
std::uint8_t At(Mode mode) {
  return static_cast<std::uint8_t>(mode);
}
}  // namespace

void Maker::SetPlane(ir::BlockBuilder& block, ir::Plane plane) {
  Code(block, WordOp::kPlane, At(plane));
  if (known_.modes.plane != plane) Touch(kPlaneGroup);
  known_.modes.plane = plane;
}

void Maker::SetDistance(ir::BlockBuilder& block, ir::Distance distance) {
  Code(block, WordOp::kDistance, At(distance));
  if (known_.modes.distance != distance) Touch(kDistanceGroup);
  known_.modes.distance = distance;
}

void Maker::SetUnits(ir::BlockBuilder& block, ir::Units units) {
  Code(block, WordOp::kUnits, At(units));
  if (known_.modes.units != units) {
    Touch(kUnitsGroup);
    // A feed in force may keep its number or its speed: it is written again.
    if (MayChange(kFeedGroup)) {
      Touch(kFeedGroup);
      known_.feed = false;
    }
  }
  known_.modes.units = units;
}

void Maker::SetDiameter(ir::BlockBuilder& block, ir::Diameter diameter) {
  Code(block, WordOp::kDiameter, At(diameter));
  if (known_.modes.diameter != diameter) Touch(kDiameterGroup);
  known_.modes.diameter = diameter;
}

void Maker::SetFeedMode(ir::BlockBuilder& block, ir::FeedMode mode) {
  Code(block, WordOp::kFeedMode, At(mode));
  if (known_.modes.feed_mode != mode) {
    Touch(kFeedGroup);
    known_.feed = false;
  }
  known_.modes.feed_mode = mode;
}

// Speed in revolutions; it must be written before the feed mode is chosen again.
void Maker::SetRpm(ir::BlockBuilder& block) {
  Code(block, WordOp::kSpeedMode, At(ir::SpeedMode::kRpm));
  Word(block, WordOp::kSpeed, Literal({200, 3000, true}).id);
  Touch(kFeedGroup);
  known_.modes.speed_mode = ir::SpeedMode::kRpm;
  known_.modes.feed_mode = ir::FeedMode::kUnknown;
  known_.feed = false;
}

bool Maker::IsInch() const {
  return known_.modes.units == ir::Units::kInch || known_.modes.units == ir::Units::kInchGeometry;
}

double Maker::UnitFactor() const { return IsInch() ? 25.4 : 1; }

void Maker::NeedUnits(ir::BlockBuilder& block) {
  if (known_.modes.units == ir::Units::kUnknown) SetUnits(block, initial_.modes.units);
}

// The transverse axis means something only under a known diameter mode.
void Maker::NeedDiameter(ir::BlockBuilder& block) {
  if (IsSinumerik() && TransverseAxis() != 0xFF && known_.modes.diameter == ir::Diameter::kUnknown)
    SetDiameter(block, initial_.modes.diameter);
}

void Maker::AddFeed(ir::BlockBuilder& block) {
  if (known_.modes.feed_mode == ir::FeedMode::kUnknown) SetFeedMode(block, ir::FeedMode::kPerMinute);
  Interval range = BoundsOf(Range::kFeed);
  if (known_.modes.feed_mode == ir::FeedMode::kPerRevolution) range = {0.05, 1, false};
  if (known_.modes.feed_mode == ir::FeedMode::kInverseTime) range = {0.5, 20, false};
  Word(block, WordOp::kFeed, NumberIn(range, random_.Percent(30) ? 2 : 0).id);
  if (!known_.feed) Touch(kFeedGroup);
  known_.feed = true;
}

void Maker::NeedFeed(ir::BlockBuilder& block) {
  // Inverse time wants its word in each block.
  if (known_.feed && known_.modes.feed_mode != ir::FeedMode::kInverseTime) {
    if (random_.Percent(20)) AddFeed(block);
    return;
  }
  AddFeed(block);
}

void Maker::MakePlane() {
  static constexpr ir::Plane kPlanes[] = {ir::Plane::kXY, ir::Plane::kZX, ir::Plane::kYZ};
  const ir::Plane plane = !Has(Feature::kPlane) ? initial_.modes.plane
                          : HasAxis(1)          ? random_.Pick(kPlanes)
                                                : ir::Plane::kZX;
  if (!MayChange(kPlaneGroup)) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  SetPlane(block, plane);
  AddBeside(block);
  Emit(block, true);
}

void Maker::MakeDistance() {
  if (!IsSinumerik()) return MakeSteps();
  if (!MayChange(kDistanceGroup)) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  SetDistance(block, random_.Percent(50) ? ir::Distance::kAbsolute : ir::Distance::kIncremental);
  AddBeside(block);
  Emit(block, true);
}

void Maker::MakeUnits() {
  if (!MayChange(kUnitsGroup) || !MayChange(kFeedGroup)) return MakeLinear();
  static constexpr ir::Units kSinumerik[] = {ir::Units::kMmGeometry, ir::Units::kInchGeometry, ir::Units::kMm,
                                             ir::Units::kInch};
  static constexpr ir::Units kOthers[] = {ir::Units::kMm, ir::Units::kInch};
  ir::BlockBuilder block = NewBlock();
  SetUnits(block, IsSinumerik() ? random_.Pick(kSinumerik) : random_.Pick(kOthers));
  Emit(block);
}

void Maker::MakeFeedMode() {
  if (!MayChange(kFeedGroup) || known_.modes.speed_mode != ir::SpeedMode::kRpm) return MakeLinear();
  static constexpr ir::FeedMode kModes[] = {ir::FeedMode::kPerMinute, ir::FeedMode::kPerMinute,
                                            ir::FeedMode::kPerRevolution, ir::FeedMode::kPerRevolution,
                                            ir::FeedMode::kInverseTime};
  ir::BlockBuilder block = NewBlock();
  SetFeedMode(block, random_.Pick(kModes));
  AddFeed(block);
  Emit(block, true);
}

void Maker::MakeSurfaceSpeed() {
  if (!MayChange(kFeedGroup)) return MakeLinear();
  if (known_.modes.speed_mode != ir::SpeedMode::kRpm) {
    ir::BlockBuilder block = NewBlock();
    SetRpm(block);
    Emit(block);
    return;
  }
  if (TransverseAxis() == 0xFF) return MakeLinear();
  ir::BlockBuilder limit = NewBlock();
  Word(limit, WordOp::kSpeedLimit, Literal({1000, 4000, true}).id);
  Emit(limit);
  ir::BlockBuilder block = NewBlock();
  Code(block, WordOp::kSpeedMode, At(ir::SpeedMode::kConstantSurface));
  Word(block, WordOp::kSpeed, NumberIn({50, 300, !Draw(Feature::kFractionalSpeed)}, 1).id);
  Touch(kFeedGroup);
  known_.modes.speed_mode = ir::SpeedMode::kConstantSurface;
  known_.modes.feed_mode = IsSinumerik() ? ir::FeedMode::kPerRevolution : ir::FeedMode::kUnknown;
  known_.feed = false;
  AddFeed(block);
  Emit(block);
}

void Maker::MakeDiameter() {
  if (TransverseAxis() == 0xFF || !MayChange(kDiameterGroup)) return MakeLinear();
  static constexpr ir::Diameter kModes[] = {ir::Diameter::kRadius, ir::Diameter::kDiameter,
                                            ir::Diameter::kDiameterAbsolute};
  ir::BlockBuilder block = NewBlock();
  SetDiameter(block, random_.Pick(kModes));
  Emit(block, true);
}

void Maker::MakePathMode() {
  if (!MayChange(kPathGroup)) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  const ir::PathMode mode = random_.Percent(50) ? ir::PathMode::kExact : ir::PathMode::kContinuous;
  Code(block, WordOp::kPathMode, At(mode));
  Touch(kPathGroup);
  known_.modes.path = mode;
  Emit(block, true);
}

void Maker::MakeWorkOffset() {
  if (!MayChange(kOffsetGroup)) return MakeLinear();
  ir::BlockBuilder block = NewBlock();
  static constexpr std::uint32_t kSinumerik[] = {54, 55, 56, 57, 505, 523, 0};
  static constexpr std::uint32_t kOthers[] = {54, 55, 56, 57, 58, 59};
  Code(block, WordOp::kWorkOffset, 0, IsSinumerik() ? random_.Pick(kSinumerik) : random_.Pick(kOthers));
  Touch(kOffsetGroup);
  known_.modes.work_offset = {};
  Emit(block, true);
  // Where the machine stands in the new system is not known.
  Displace(0xFFFF);
  Approach(AllAxes());
}

// Compensation on with a straight move, one or two more, off with a straight move: nothing else lies between.
void Maker::MakeCutterComp() {
  const ir::Plane plane = known_.modes.plane;
  if (plane == ir::Plane::kUnknown) return MakePlane();
  const std::uint8_t first = plane == ir::Plane::kXY ? 0 : plane == ir::Plane::kZX ? 2 : 1;
  const std::uint8_t second = plane == ir::Plane::kXY ? 1 : plane == ir::Plane::kZX ? 0 : 2;
  if (!HasAxis(first) || !HasAxis(second)) return MakeLinear();
  const std::uint32_t moves = 2 + random_.Below(2);
  for (std::uint32_t i = 0; i <= moves; ++i) {
    ir::BlockBuilder block = NewBlock();
    NeedUnits(block);
    NeedDiameter(block);
    if (i == 0)
      Code(block, WordOp::kCutterComp, At(random_.Percent(50) ? ir::CutterComp::kLeft : ir::CutterComp::kRight));
    if (i == moves) Code(block, WordOp::kCutterComp, At(ir::CutterComp::kOff));
    SetMotion(block, ir::Motion::kLinear);
    AxisWord(block, first, true, 1);
    AxisWord(block, second, true, 1);
    NeedFeed(block);
    Emit(block);
  }
}

bool Maker::ResetFrame() {
  if (!Has(Feature::kFrame)) {
    known_.frame_clear = true;
    known_.turned = Turned::kNo;
    return true;
  }
  if (!MayChange(kFrameGroup)) return false;
  ir::BlockBuilder block = NewBlock();
  static constexpr ir::FrameOp kOps[] = {ir::FrameOp::kTranslate, ir::FrameOp::kRotate, ir::FrameOp::kScale,
                                         ir::FrameOp::kMirror};
  Code(block, WordOp::kFrame, At(Has(Feature::kFrameTurns) ? random_.Pick(kOps) : ir::FrameOp::kTranslate));
  Touch(kFrameGroup);
  known_.frame_clear = true;
  known_.turned = Turned::kNo;
  Displace(0xFFFF);
  Emit(block);
  return true;
}

// Shifts, rotations in the plane of two axes, one factor for all axes, mirrors. At most two after each other, so that
// positions stay on the machine.
void Maker::MakeFrame() {
  if (!MayChange(kFrameGroup)) return MakeLinear();
  if (!known_.frame_clear) {
    ResetFrame();
    return;
  }
  const std::uint32_t words = 1 + random_.Below(2);
  Turned turned = Turned::kNo;
  for (std::uint32_t i = 0; i < words; ++i) {
    if (known_.modes.units == ir::Units::kUnknown) {
      ir::BlockBuilder units = NewBlock();
      NeedUnits(units);
      Emit(units);
    }
    ir::BlockBuilder block = NewBlock();
    const std::uint32_t kind = Draw(Feature::kFrameTurns) ? 1 + random_.Below(3) : 0;
    const bool additive = i > 0 || random_.Percent(30);
    static constexpr ir::FrameOp kAbsolute[] = {ir::FrameOp::kTranslate, ir::FrameOp::kRotate, ir::FrameOp::kScale,
                                                ir::FrameOp::kMirror};
    static constexpr ir::FrameOp kAdditive[] = {ir::FrameOp::kAddTranslate, ir::FrameOp::kAddRotate,
                                                ir::FrameOp::kAddScale, ir::FrameOp::kAddMirror};
    Code(block, WordOp::kFrame, At(additive ? kAdditive[kind] : kAbsolute[kind]));
    if (!additive) turned = Turned::kNo;
    if (kind == 0) {
      const double most = IsInch() ? 1.5 : 40;
      for (const std::uint8_t axis : SomeAxes(false))
        Word(block, WordOp::kAxis, NumberIn({-most, most, false}, 1).id, axis);
    } else if (kind == 1) {
      const ir::ExprId angle = NumberIn(BoundsOf(Range::kAngle), 1).id;
      if (random_.Percent(30) && known_.modes.plane != ir::Plane::kUnknown) {
        Word(block, WordOp::kFrameAngle, angle);
        const Turned now = known_.modes.plane == ir::Plane::kXY   ? Turned::kInXY
                           : known_.modes.plane == ir::Plane::kZX ? Turned::kInZX
                                                                  : Turned::kInYZ;
        turned = turned == Turned::kNo || turned == now ? now : Turned::kUnknown;
      } else {
        // Around Z, on lathes without Y around Y.
        const std::uint8_t axis =
            HasAxis(1) ? (random_.Percent(70) ? 2 : static_cast<std::uint8_t>(random_.Below(3))) : 1;
        Word(block, WordOp::kAxis, angle, axis);
        const Turned now = axis == 2 ? Turned::kInXY : axis == 1 ? Turned::kInZX : Turned::kInYZ;
        turned = turned == Turned::kNo || turned == now ? now : Turned::kUnknown;
      }
    } else if (kind == 2) {
      static constexpr std::string_view kFactors[] = {"0.5", "1.5", "2", "1.25"};
      const std::string_view factor = i > 0 ? "0.75" : random_.Pick(kFactors);
      for (std::uint8_t axis = 0; axis < 3; ++axis) {
        if (HasAxis(axis)) Word(block, WordOp::kAxis, expr_.Number(factor), axis);
      }
    } else {
      Word(block, WordOp::kAxis, expr_.Number("0", ir::Type::kInt),
           HasAxis(1) ? static_cast<std::uint8_t>(random_.Below(3)) : (random_.Percent(50) ? 0 : 2));
    }
    Touch(kFrameGroup);
    known_.frame_clear = false;
    known_.turned = turned;
    Displace(0xFFFF);
    Emit(block);
  }
}

}  // namespace ncport::tests::random
