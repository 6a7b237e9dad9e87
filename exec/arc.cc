// Arcs by centre, radius, opening angle, intermediate point and tangent.
#include <cmath>

#include "exec/kinematics.h"

namespace ncport::exec {

using ir::ValueMode;

namespace {

constexpr std::uint16_t Bits(const PlaneAxes& axes) {
  return static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
}

}  // namespace

/// A centre or intermediate coordinate in workpiece coordinates. Increments count from the start of the arc and are
/// never diameters; absolute ones of the transverse axis are what the machine says (sinumerik-8.3, 8.5).
double Kinematics::CenterCoordinate(std::uint8_t axis, double value, ValueMode mode) const {
  value *= LengthFactor();
  if (mode == ValueMode::kModal) {
    mode = channel_.modal.distance == ir::Distance::kIncremental ? ValueMode::kStep : ValueMode::kAbsolute;
  }
  const bool transverse = axis == session_.machine.transverse_axis;
  switch (mode) {
    case ValueMode::kAbsolute:
      return transverse && session_.machine.centers_are_diameter_when_absolute && TransverseInDiameter(mode, false)
                 ? value / 2
                 : value;
    case ValueMode::kAbsoluteDiameter:
      return transverse ? value / 2 : value;
    case ValueMode::kAbsoluteRadius:
      return value;
    case ValueMode::kIncrementalDiameter:
      return channel_.work[axis] + (transverse ? value / 2 : value);
    default:
      return channel_.work[axis] + value;
  }
}

bool Kinematics::Center(const BlockWork& work, const PlaneAxes& axes, Point& center) {
  center = {channel_.work[axes.first], channel_.work[axes.second]};  // a missing letter is no offset from the start
  if ((work.centers & (1U << axes.first)) != 0)
    center.u = CenterCoordinate(axes.first, work.center[axes.first], work.center_mode[axes.first]);
  if ((work.centers & (1U << axes.second)) != 0)
    center.v = CenterCoordinate(axes.second, work.center[axes.second], work.center_mode[axes.second]);
  if ((work.centers & (1U << axes.normal)) != 0) {
    session_.Alarm(ir::AlarmClass::kCircle, "centre word outside the plane");
    return false;
  }
  return true;
}

bool Kinematics::ArcTrouble(const Arc& arc) {
  switch (arc.fault) {
    case ArcFault::kNone:
      return false;
    case ArcFault::kRadiusTooSmall:
      session_.Alarm(ir::AlarmClass::kCircle, "radius too small for the end point");
      break;
    case ArcFault::kNoEnd:
      session_.Alarm(ir::AlarmClass::kCircle, "end point is the start point");
      break;
    case ArcFault::kBadAngle:
      session_.Alarm(ir::AlarmClass::kCircle, "opening angle outside 0 to 360 degrees");
      break;
    case ArcFault::kRadiiDiffer:
      session_.Alarm(ir::AlarmClass::kCircle, fmt::format("radius is {:.6g} at the start and {:.6g} at the end",
                                                          arc.start_radius, arc.end_radius));
      break;
    case ArcFault::kCenterOnPoint:
      session_.Alarm(ir::AlarmClass::kCircle, "centre on the start or end point");
      break;
    case ArcFault::kOnLine:
      session_.Alarm(ir::AlarmClass::kCircle, "points of the arc lie on one line");
      break;
  }
  return true;
}

void Kinematics::ArcMove(const BlockWork& work, bool clockwise) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return;
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
  if (Unknown(channel_.modal.distance == ir::Distance::kUnknown, "absolute or incremental")) return;
  if (!FeedReady(work)) return;
  const PlaneAxes axes = AxesOf(channel_.modal.plane);
  if (!Known(axes.first, "an arc") || !Known(axes.second, "an arc")) return;

  const Point start{channel_.work[axes.first], channel_.work[axes.second]};
  const bool has_end = (moved_ & Bits(axes)) != 0;
  const Point end{(moved_ & AxisBit(axes.first)) != 0 ? target_[axes.first] : start.u,
                  (moved_ & AxisBit(axes.second)) != 0 ? target_[axes.second] : start.v};
  const ir::Machine& machine = session_.machine;
  const ArcTolerance tolerance{machine.circle_tolerance, machine.circle_tolerance_factor, machine.arc_center_corrected,
                               machine.arc_correction_angle};
  Arc arc;
  bool full = false;
  if (work.Has(BlockWork::kRadius)) {
    if (work.centers != 0 && !machine.arc_radius_beats_center)
      return session_.Alarm(ir::AlarmClass::kCircle, "radius and centre in one block");
    const bool closed = end.u == start.u && end.v == start.v;
    if (closed && machine.arc_radius_without_end_stays) return;
    arc = ArcByRadius(start, end, work.radius * LengthFactor(), clockwise, tolerance);
  } else if (work.Has(BlockWork::kOpening)) {
    if (work.centers != 0 && has_end)
      return session_.Alarm(ir::AlarmClass::kCircle, "opening angle, centre and end point in one block");
    if (work.centers != 0) {
      Point center;
      if (!Center(work, axes, center)) return;
      arc = ArcByCenterAndAngle(start, center, work.opening, clockwise);
      full = work.opening == 360;
    } else {
      arc = ArcByAngle(start, end, work.opening, clockwise);
    }
  } else {
    Point center;
    if (work.centers != 0) {
      if (!Center(work, axes, center)) return;
    } else if (work.Has(BlockWork::kPolarRadius | BlockWork::kPolarAngle)) {
      center = channel_.pole;  // polar end point: the pole is the centre
    } else {
      return session_.Alarm(ir::AlarmClass::kCircle, "arc without centre and radius");
    }
    full = !has_end || (std::fabs(end.u - start.u) <= 1e-9 && std::fabs(end.v - start.v) <= 1e-9);
    arc = ArcByCenter(start, full ? start : end, center, clockwise, tolerance);
  }
  if (ArcTrouble(arc)) return;

  const PlaneMap map = MapPlane(channel_.frame, channel_.modal.plane);
  if (!map.parallel)
    return session_.Refuse(diag::Code::kCannotRun, "an arc in a plane that the frame tilts out of the main planes");
  if (!map.similar) {
    if (work.Has(BlockWork::kRadius) && channel_.layers.scales) return ScaledArc(work, axes, arc);
    return session_.Refuse(diag::Code::kCannotRun, "an arc under different scale factors");
  }

  // The centre in trace coordinates, at the height of the start.
  double center_work[ir::kMaxAxes] = {};
  double center_base[ir::kMaxAxes] = {};
  for (int axis = 0; axis < 3; ++axis) center_work[axis] = channel_.work[axis];
  center_work[axes.first] = arc.center.u;
  center_work[axes.second] = arc.center.v;
  const std::uint16_t known = channel_.frame.ToBase(center_work, channel_.work_known, center_base);
  const PlaneAxes base = AxesOf(map.plane);
  if ((known & Bits(base)) != Bits(base))
    return session_.Refuse(diag::Code::kCannotRun, "an arc whose centre depends on an unknown position");

  target_[axes.first] = arc.end.u;
  target_[axes.second] = arc.end.v;
  moved_ |= Bits(axes);
  Adopt();
  if (session_.halted) return;
  SendArc(work, map.plane, {center_base[base.first], center_base[base.second]}, arc.clockwise != map.mirrored,
          arc.start_radius * map.scale, full);
}

/// Under unequal factors a radius takes the larger one; the ends are scaled each by its own (fanuc-8.6).
void Kinematics::ScaledArc(const BlockWork& work, const PlaneAxes& axes, const Arc& programmed) {
  const PlaneMap map = MapPlane(channel_.frame, channel_.modal.plane);
  const FrameLayers& layers = channel_.layers;
  const double factor = std::fmax(std::fabs(layers.factor[axes.first]), std::fabs(layers.factor[axes.second]));
  target_[axes.first] = programmed.end.u;
  target_[axes.second] = programmed.end.v;
  moved_ |= Bits(axes);
  Adopt();
  if (session_.halted) return;
  const PlaneAxes base = AxesOf(map.plane);
  const ir::Machine& machine = session_.machine;
  const ArcTolerance tolerance{machine.circle_tolerance, machine.circle_tolerance_factor, machine.arc_center_corrected,
                               machine.arc_correction_angle};
  const bool clockwise = programmed.clockwise != map.mirrored;
  const Arc arc =
      ArcByRadius({from_[base.first], from_[base.second]}, {channel_.base[base.first], channel_.base[base.second]},
                  work.radius * LengthFactor() * factor, clockwise, tolerance);
  if (ArcTrouble(arc)) return;
  SendArc(work, map.plane, arc.center, clockwise, arc.start_radius, false);
}

void Kinematics::SendArc(const BlockWork& work, ir::Plane base_plane, Point base_center, bool clockwise, double radius,
                         bool full) {
  Event& event = MotionEvent(EventKind::kArc);
  event.plane = base_plane;
  event.clockwise = clockwise;
  event.center[0] = base_center.u;
  event.center[1] = base_center.v;
  event.radius = radius;
  event.full_circle = full;
  if (work.Has(BlockWork::kFeedOnce)) event.feed = work.feed_once * FeedFactor();
  if (work.Has(BlockWork::kTurns)) {
    if (!(work.turns >= 0 && work.turns <= 999))
      return session_.Alarm(ir::AlarmClass::kRange, "turns outside 0 to 999");
    event.turns = static_cast<std::uint32_t>(std::round(work.turns));
  }
  const PlaneAxes axes = AxesOf(base_plane);
  const Point direction = DirectionAt({channel_.base[axes.first], channel_.base[axes.second]}, base_center, clockwise);
  channel_.direction_known = true;
  channel_.direction[axes.first] = direction.u;
  channel_.direction[axes.second] = direction.v;
  channel_.direction[axes.normal] = 0;
  const Contour::Wish wish = WishOf(work);
  if (!session_.halted) contour_.Element(event, wish);
}

/// Three points in space (CIP): plane and sense follow from them. Runs when their plane is parallel to a main plane.
void Kinematics::ArcVia(const BlockWork& work) {
  if (!FeedReady(work)) return;
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    const bool named = (moved_ & AxisBit(axis)) != 0 || (work.vias & (1U << axis)) != 0;
    if (named && !Known(axis, "an arc through a point")) return;
  }
  double via_work[ir::kMaxAxes] = {};
  double via[ir::kMaxAxes] = {};
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    via_work[axis] = (work.vias & (1U << axis)) != 0 ? CenterCoordinate(axis, work.via[axis], work.via_mode[axis])
                                                     : channel_.work[axis];
  }
  const std::uint16_t via_known = channel_.frame.ToBase(via_work, channel_.work_known, via);
  Adopt();
  if (session_.halted) return;
  const double* const start = from_;
  const double* const end = channel_.base;
  bool on_line = false;
  // A plane is taken when its normal axis stays where it is; an axis that nobody has named stays.
  for (const std::uint8_t normal : {std::uint8_t{2}, std::uint8_t{1}, std::uint8_t{0}}) {
    const PlaneAxes axes = AxesOf(PlaneWithNormal(normal));
    const bool flat = (via_known & AxisBit(normal)) == 0 ||
                      (start[normal] == end[normal] && std::fabs(via[normal] - start[normal]) < 1e-9);
    if (!flat || (via_known & Bits(axes)) != Bits(axes) || (from_known_ & Bits(axes)) != Bits(axes)) continue;
    const Arc arc = ArcThrough({start[axes.first], start[axes.second]}, {via[axes.first], via[axes.second]},
                               {end[axes.first], end[axes.second]});
    if (arc.fault == ArcFault::kNone)
      return SendArc(work, PlaneWithNormal(normal), arc.center, arc.clockwise, arc.start_radius, false);
    if (arc.fault != ArcFault::kOnLine) {
      ArcTrouble(arc);
      return;
    }
    on_line = true;  // seen in this plane; perhaps all three lie in another one as well
  }
  if (on_line) return session_.Alarm(ir::AlarmClass::kCircle, "points of the arc lie on one line");
  session_.Refuse(diag::Code::kCannotRun, "an arc through a point in a plane that is parallel to no main plane");
}

/// CT: leaves the path before it without a corner, in the active plane.
void Kinematics::ArcTangent(const BlockWork& work) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return;
  if (!FeedReady(work)) return;
  const PlaneMap map = MapPlane(channel_.frame, channel_.modal.plane);
  if (!map.parallel || !map.similar)
    return session_.Refuse(diag::Code::kCannotRun, "a tangent arc under a tilted or unevenly scaled frame");
  const PlaneAxes axes = AxesOf(map.plane);
  const Point direction{channel_.direction[axes.first], channel_.direction[axes.second]};
  const bool known = channel_.direction_known && (channel_.base_known & ~channel_.uncertain & Bits(axes)) == Bits(axes);
  if (!known || (direction.u == 0 && direction.v == 0)) {
    return session_.Refuse(diag::Code::kCannotRun,
                           "a tangent arc behind a path whose direction in the plane is not known");
  }
  Adopt();
  if (session_.halted) return;
  const Arc arc = ArcByTangent({from_[axes.first], from_[axes.second]}, direction,
                               {channel_.base[axes.first], channel_.base[axes.second]});
  if (ArcTrouble(arc)) return;
  if (!arc.line) return SendArc(work, map.plane, arc.center, arc.clockwise, arc.start_radius, false);
  Event& event = MotionEvent(EventKind::kLine);
  if (work.Has(BlockWork::kFeedOnce)) event.feed = work.feed_once * FeedFactor();
  NoteDirection(event);
  const Contour::Wish wish = WishOf(work);
  if (!session_.halted) contour_.Element(event, wish);
}

}  // namespace ncport::exec
