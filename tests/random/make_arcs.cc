// Arcs that are exact by construction: radius vectors are whole multiples of one length, (1,0) (0,1) and (3,4) (4,3)
// (5,0), so that start, end and centre fit whatever the length is.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprOp;
using ir::Type;
using ir::ValueMode;
using ir::WordOp;

namespace {

struct Vector {
  int x, y;
  constexpr bool operator==(const Vector&) const = default;
};
constexpr Vector kQuarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
constexpr Vector kFives[] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                             {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};

double AngleOf(Vector v) { return std::atan2(v.y, v.x) * 180 / 3.14159265358979323846; }
/// Degrees from `a` to `b` in the sense of the arc: over 0, at most 360 (360 when they are the same).
double Sweep(Vector a, Vector b, bool clockwise) {
  double sweep = clockwise ? AngleOf(a) - AngleOf(b) : AngleOf(b) - AngleOf(a);
  while (sweep <= 1e-9) sweep += 360;
  return sweep;
}

}  // namespace

Maker::Made Maker::Scaled(double factor, const Made& length) {
  if (factor == 1) return length;
  if (module_.exprs[length.id].op == ir::ExprOp::kLiteral)
    return Literal(Interval::Point(factor * module_.exprs[length.id].number));
  if (factor == 0) return Literal(Interval::Point(0));
  // The tree is used again: expressions are shared by value, never changed.
  if (factor == -1) {
    const Made group = Group(length);
    return {expr_.Unary(ExprOp::kNegate, group.id), length.type, -length.range};
  }
  const Made number = Literal(Interval::Point(std::fabs(factor)));
  const Made product = Operation(ExprOp::kMultiply, number, Group(length), Type::kReal, number.range * length.range);
  return factor > 0 ? product : Scaled(-1, product);
}

// A plane that arcs can lie in here; sets nothing but a frame that turns it, which is taken away.
bool Maker::ChooseFlat(Flat& flat) {
  static constexpr Flat kFlats[] = {{0, 1, 2, ir::Plane::kXY}, {2, 0, 1, ir::Plane::kZX}, {1, 2, 0, ir::Plane::kYZ}};
  const ir::Plane now = known_.modes.plane;
  if (now != ir::Plane::kUnknown && (!MayChange(kPlaneGroup) || !Has(Feature::kPlane) || random_.Percent(70))) {
    flat = kFlats[static_cast<std::size_t>(now) - 1];
  } else if (!Has(Feature::kPlane)) {
    flat = kFlats[static_cast<std::size_t>(initial_.modes.plane) - 1];
  } else {
    flat = HasAxis(1) ? random_.Pick(kFlats) : kFlats[1];
  }
  if (!HasAxis(flat.first) || !HasAxis(flat.second)) return false;
  const Turned turned = flat.plane == ir::Plane::kXY   ? Turned::kInXY
                        : flat.plane == ir::Plane::kZX ? Turned::kInZX
                                                       : Turned::kInYZ;
  if (known_.turned != Turned::kNo && known_.turned != turned) return ResetFrame();
  return true;
}

// Makes the modes known that decide what the words of an arc mean, in a block before it.
bool Maker::StartArc(Flat& flat) {
  if (!ChooseFlat(flat)) return false;
  for (const std::uint8_t axis : {flat.first, flat.second}) {
    if (!MayDrift(axis, 45)) return false;
  }
  // Without words for single increments the distance mode decides.
  if (!Has(Feature::kValueModes) && known_.modes.distance == ir::Distance::kUnknown && !MayChange(kDistanceGroup))
    return false;
  Ready();
  const bool distance = !Has(Feature::kValueModes) && known_.modes.distance == ir::Distance::kUnknown;
  const bool diameter = TransverseAxis() != 0xFF && known_.modes.diameter == ir::Diameter::kUnknown;
  if (known_.modes.plane != flat.plane || known_.modes.units == ir::Units::kUnknown || distance || diameter) {
    ir::BlockBuilder block = NewBlock();
    if (known_.modes.plane != flat.plane) SetPlane(block, flat.plane);
    NeedUnits(block);
    NeedDiameter(block);
    if (distance) SetDistance(block, random_.Percent(50) ? ir::Distance::kAbsolute : ir::Distance::kIncremental);
    Emit(block);
  }
  origin_set_ = false;
  const bool must = !Has(Feature::kValueModes) && known_.modes.distance == ir::Distance::kAbsolute;
  const std::uint16_t axes = static_cast<std::uint16_t>(1U << flat.first | 1U << flat.second);
  moved_ |= axes;
  const bool may_step = MayStep(flat.first) && MayStep(flat.second);
  if (!must && may_step && random_.Percent(55)) return true;
  known_.placed |= axes;
  // Go to a start point that is known: end and centre can then be absolute.
  origin_set_ = true;
  ir::BlockBuilder approach = NewBlock();
  SetMotion(approach, random_.Percent(50) ? ir::Motion::kRapid : ir::Motion::kLinear);
  if (known_.modes.motion == ir::Motion::kLinear) NeedFeed(approach);
  const double most = IsInch() ? 2 : 50;
  int i = 0;
  for (const std::uint8_t axis : {flat.first, flat.second}) {
    const Place* const place = random_.Percent(30) && !IsInch() ? FindPlace(Range::kLength, Type::kReal) : nullptr;
    origin_[i] = place != nullptr && !place->is_array
                     ? Made{expr_.Variable(place->variable), Type::kReal, BoundsOf(Range::kLength)}
                     : Literal({-most, most, false});
    const ValueMode mode = known_.modes.distance == ir::Distance::kAbsolute && !Draw(Feature::kValueModes)
                               ? ValueMode::kModal
                               : ValueMode::kAbsolute;
    approach.Axis(axis, origin_[i].id, mode);
    ++i;
  }
  Emit(approach);
  return true;
}

bool Maker::InDiameters(bool absolute) const {
  return known_.modes.diameter == ir::Diameter::kDiameter ||
         (absolute && known_.modes.diameter == ir::Diameter::kDiameterAbsolute);
}

// End point of an arc: `offset` from its start, lengths as radius. `most`: of its size.
void Maker::EndWord(ir::BlockBuilder& block, std::uint8_t axis, const Made& offset, double most) {
  const bool transverse = axis == TransverseAxis();
  const bool absolute_mode = known_.modes.distance == ir::Distance::kAbsolute;
  if (origin_set_ && (axis == origin_axes_[0] || axis == origin_axes_[1])) {
    const bool must = !Has(Feature::kValueModes) && absolute_mode;
    if (must || random_.Percent(60)) {
      const Made& from = origin_[axis == origin_axes_[0] ? 0 : 1];
      const Made way = Scaled(transverse && InDiameters(true) ? 2 : 1, offset);
      Made end;
      if (module_.exprs[from.id].op == ExprOp::kLiteral && module_.exprs[way.id].op == ExprOp::kLiteral) {
        const double sum = module_.exprs[from.id].number + module_.exprs[way.id].number;
        end = Literal(Interval::Point(std::round(sum * 1e6) / 1e6));
      } else {
        end = Operation(
            ExprOp::kAdd, from,
            module_.exprs[way.id].op == ExprOp::kLiteral && module_.exprs[way.id].number < 0 ? Group(way) : way,
            Type::kReal, from.range + way.range);
      }
      block.Axis(axis, end.id, absolute_mode && !Draw(Feature::kValueModes) ? ValueMode::kModal : ValueMode::kAbsolute);
      return;
    }
  }
  AddDrift(axis, most * UnitFactor());
  if (transverse && Draw(Feature::kDiameterWords)) {
    const bool diameter = random_.Percent(50);
    block.Axis(axis, Scaled(diameter ? 2 : 1, offset).id,
               diameter ? ValueMode::kIncrementalDiameter : ValueMode::kIncrementalRadius);
    return;
  }
  const Made value = Scaled(transverse && InDiameters(false) ? 2 : 1, offset);
  const bool plain = known_.modes.distance == ir::Distance::kIncremental && !Draw(Feature::kValueModes);
  block.Axis(axis, value.id, plain ? ValueMode::kModal : ValueMode::kIncremental);
}

// I J K: from the start point, or absolute where that is known.
void Maker::CenterWord(ir::BlockBuilder& block, std::uint8_t axis, const Made& offset) {
  const bool literal = module_.exprs[offset.id].op == ExprOp::kLiteral;
  if (origin_set_ && Has(Feature::kValueModes) && literal && random_.Percent(35)) {
    const Made& from = origin_[axis == origin_axes_[0] ? 0 : 1];
    if (module_.exprs[from.id].op == ExprOp::kLiteral) {
      const double factor = axis == TransverseAxis() && InDiameters(true) ? 2 : 1;
      const double sum = module_.exprs[from.id].number + factor * module_.exprs[offset.id].number;
      Word(block, WordOp::kCenter, Literal(Interval::Point(std::round(sum * 1e6) / 1e6)).id, axis);
      block.Last().mode = ValueMode::kAbsolute;
      return;
    }
  }
  Word(block, WordOp::kCenter, offset.id, axis);
  block.Last().mode = ValueMode::kStep;
}

Maker::Made Maker::ArcLength(bool fives, bool computed) {
  // The radius is this length, or five of it.
  const double unit = IsInch() ? 0.04 : 1;
  const Interval range = fives ? Interval{0.2 * unit, 4 * unit, false} : Interval{0.5 * unit, 20 * unit, false};
  return random_.Percent(55) || !computed ? Literal(range) : NumberIn(range, 2);
}

Maker::Arc Maker::DrawArc(bool full_too) {
  Arc arc;
  arc.clockwise = random_.Percent(50);
  arc.fives = random_.Percent(40);
  const auto draw = [&] {
    const Vector v = arc.fives ? random_.Pick(kFives) : random_.Pick(kQuarters);
    return std::array<int, 2>{v.x, v.y};
  };
  arc.start = draw();
  do {
    arc.end = draw();
  } while (!full_too && arc.end == arc.start);
  arc.full = arc.end == arc.start;
  arc.sweep = Sweep({arc.start[0], arc.start[1]}, {arc.end[0], arc.end[1]}, arc.clockwise);
  arc.length = ArcLength(arc.fives);
  return arc;
}

void Maker::ArcEnd(ir::BlockBuilder& block, const Flat& flat, const Arc& arc) {
  const std::uint8_t axes[] = {flat.first, flat.second};
  origin_axes_[0] = flat.first;
  origin_axes_[1] = flat.second;
  // The end words come in either order.
  const int first = random_.Percent(80) ? 0 : 1;
  for (const int i : {first, 1 - first}) {
    const int units = arc.end[i] - arc.start[i];
    if (units == 0 && !arc.full && random_.Percent(50)) continue;
    EndWord(block, axes[i], Scaled(units, arc.length), std::abs(units) * arc.length.range.high);
  }
}

void Maker::AddHelix(ir::BlockBuilder& block, const Flat& flat, bool turns) {
  if (!HasAxis(flat.normal) || !Draw(Feature::kHelix)) return;
  const bool absolute =
      Has(Feature::kValueModes) ? random_.Percent(60) : known_.modes.distance != ir::Distance::kIncremental;
  AxisWord(block, flat.normal, absolute, 1);
  if (turns && Draw(Feature::kTurns)) Word(block, WordOp::kTurns, As(Literal({1, 3, true}), Type::kInt));
}

void Maker::MakeArcCenter() {
  Flat flat;
  if (!StartArc(flat)) return MakeLinear();
  const Arc arc = DrawArc(true);
  ir::BlockBuilder block = NewBlock();
  SetMotion(block, arc.clockwise ? ir::Motion::kArcCw : ir::Motion::kArcCcw);
  if (!arc.full || random_.Percent(40)) ArcEnd(block, flat, arc);
  origin_axes_[0] = flat.first;
  origin_axes_[1] = flat.second;
  const std::uint8_t axes[] = {flat.first, flat.second};
  for (int i = 0; i < 2; ++i) {
    if (arc.start[i] == 0 && random_.Percent(50)) continue;
    CenterWord(block, axes[i], Scaled(-arc.start[i], arc.length));
  }
  AddHelix(block, flat, true);
  NeedFeed(block);
  Emit(block);
}

void Maker::MakeArcRadius() {
  Flat flat;
  if (!StartArc(flat)) return MakeLinear();
  Arc arc = DrawArc(false);
  const bool rounded = !Draw(Feature::kComputedRadius);
  // Where words are rounded, so does the centre of a short arc or a half circle move: quarters only.
  while (rounded && (arc.fives || std::fabs(arc.sweep - 180) < 1)) arc = DrawArc(false);
  // A half circle by its radius hangs on the last digit: only with plain numbers.
  if (rounded) {
    arc.length = Literal({1, IsInch() ? 1.0 : 8.0, true});
  } else if (std::fabs(arc.sweep - 180) < 1) {
    arc.length =
        Literal(arc.fives ? Interval{0.2, IsInch() ? 0.3 : 4, false} : Interval{0.5, IsInch() ? 0.8 : 20, false});
  }
  ir::BlockBuilder block = NewBlock();
  SetMotion(block, arc.clockwise ? ir::Motion::kArcCw : ir::Motion::kArcCcw);
  ArcEnd(block, flat, arc);
  const double sign = arc.sweep > 181 ? -1 : 1;
  Word(block, WordOp::kRadius, Scaled(sign * (arc.fives ? 5 : 1), arc.length).id);
  AddHelix(block, flat, false);
  NeedFeed(block);
  Emit(block);
}

// End point and opening angle, or centre and opening angle.
void Maker::MakeArcAngle() {
  Flat flat;
  if (!StartArc(flat)) return MakeLinear();
  Arc arc = DrawArc(false);
  arc.fives = false;
  arc.length = ArcLength(false, MayCompute());
  const std::uint32_t from = random_.Below(4);
  const std::uint32_t quarters = 1 + random_.Below(3);
  arc.start = {kQuarters[from].x, kQuarters[from].y};
  const Vector end = kQuarters[(from + (arc.clockwise ? 4 - quarters : quarters)) % 4];
  arc.end = {end.x, end.y};
  ir::BlockBuilder block = NewBlock();
  SetMotion(block, arc.clockwise ? ir::Motion::kArcCw : ir::Motion::kArcCcw);
  if (random_.Percent(50)) {
    ArcEnd(block, flat, arc);
    Word(block, WordOp::kOpeningAngle, Literal(Interval::Point(90.0 * quarters)).id);
    Displace(0xFFFF);
  } else {
    Displace(0xFFFF);
    const std::uint8_t axes[] = {flat.first, flat.second};
    origin_axes_[0] = flat.first;
    origin_axes_[1] = flat.second;
    for (int i = 0; i < 2; ++i) {
      if (arc.start[i] != 0) CenterWord(block, axes[i], Scaled(-arc.start[i], arc.length));
      AddDrift(axes[i], 2 * arc.length.range.high * UnitFactor());
    }
    const Interval angle{10, 350, false};
    Word(block, WordOp::kOpeningAngle, (MayCompute() ? NumberIn(angle, 1) : Literal(angle)).id);
  }
  NeedFeed(block);
  Emit(block);
}

// Through a point between: on mills, in a plane of two axes.
void Maker::MakeArcVia() {
  Flat flat;
  if (TransverseAxis() != 0xFF || !StartArc(flat)) return MakeLinear();
  Arc arc = DrawArc(false);
  arc.fives = false;
  arc.length = ArcLength(false, MayCompute());
  const std::uint32_t from = random_.Below(4);
  const std::uint32_t via = (from + 1 + random_.Below(3)) % 4;
  std::uint32_t to = (via + 1 + random_.Below(3)) % 4;
  if (to == from) to = (to + 1) % 4 == via ? (to + 2) % 4 : (to + 1) % 4;
  arc.start = {kQuarters[from].x, kQuarters[from].y};
  arc.end = {kQuarters[to].x, kQuarters[to].y};
  ir::BlockBuilder block = NewBlock();
  SetMotion(block, ir::Motion::kArcVia);
  ArcEnd(block, flat, arc);
  const int between[] = {kQuarters[via].x - arc.start[0], kQuarters[via].y - arc.start[1]};
  const std::uint8_t axes[] = {flat.first, flat.second};
  for (int i = 0; i < 2; ++i) {
    Word(block, WordOp::kVia, Scaled(between[i], arc.length).id, axes[i]);
    block.Last().mode = known_.modes.distance == ir::Distance::kIncremental && random_.Percent(80)
                            ? ValueMode::kModal
                            : ValueMode::kIncremental;
  }
  NeedFeed(block);
  Emit(block);
}

// A line, then the arc that leaves it without a corner.
void Maker::MakeArcTangent() {
  Flat flat;
  if (TransverseAxis() != 0xFF || !StartArc(flat)) return MakeLinear();
  origin_set_ = false;
  ir::BlockBuilder line = NewBlock();
  SetMotion(line, ir::Motion::kLinear);
  EndWord(line, flat.first, Literal({1, 5, false}), 5);
  NeedFeed(line);
  Emit(line);
  ir::BlockBuilder block = NewBlock();
  SetMotion(block, ir::Motion::kArcTangent);
  EndWord(block, flat.first, Literal({-3, 3, false}), 3);
  EndWord(block, flat.second, Literal(random_.Percent(50) ? Interval{1, 5, false} : Interval{-5, -1, false}), 5);
  NeedFeed(block);
  Emit(block);
}

}  // namespace ncport::tests::random
