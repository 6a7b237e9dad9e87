// Threads, moves in machine coordinates, reference moves, dwell, and lines that are given by an angle.
#include <cmath>
#include <cstring>

#include "exec/kinematics.h"
#include "ir/ops/trigonometry.h"

namespace ncport::exec {

using ir::Motion;

/// Lead: the centre word of an axis, of the longer one on a taper (sinumerik-8.4), or F on controls that say so.
/// Decreasing leads have a negative change.
bool Kinematics::Thread(const BlockWork& work, Motion motion) {
  const bool tap = motion == Motion::kTapIn || motion == Motion::kTapOut;
  double centre = 0;
  int centres = 0;
  std::uint8_t along = 0;  // axis of the lead's letter
  for (std::uint8_t letter = 0; letter < 3; ++letter) {
    if ((work.centers & (1U << letter)) == 0) continue;
    centre = work.center[letter] * LengthFactor();
    along = letter;
    ++centres;
  }
  if (centres > 1) {
    session_.Alarm(ir::AlarmClass::kGeometry, "more than one lead");
    return false;
  }
  double lead = centre;
  double change = channel_.thread_change;
  if (session_.machine.thread_lead_from_feed) {
    lead = channel_.feed_known ? channel_.feed : 0;
    change = centre;
  }
  if (lead == 0) {
    session_.Alarm(ir::AlarmClass::kGeometry, "thread without a lead");
    return false;
  }
  contour_.OtherMotion();
  if (session_.halted) return false;
  const std::uint16_t from_known = channel_.base_known;
  Adopt();
  if (session_.halted) return false;
  Event& event = MotionEvent(tap ? EventKind::kTap : EventKind::kThread);
  event.value = tap ? lead : std::fabs(lead);
  if (!tap && !session_.machine.thread_lead_from_feed) {
    // Under the letter of the axis with the shorter way the lead would mean something else, and nobody says what.
    const auto way = [&](int axis) { return std::fabs(event.position[axis] - event.from[axis]); };
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      const bool known = ((from_known & event.known_axes) >> axis & 1U) != 0;
      if (!known || !(way(axis) > way(along) * (1 + 1e-9) + 1e-9)) continue;
      session_.Refuse(diag::Code::kCannotRun, "a lead under the letter of the axis with the shorter way");
      return false;
    }
  }
  // One word for both on controls whose change has the sign (fanuc-8.1).
  if (motion == Motion::kThreadIncreasing)
    event.change = session_.machine.thread_lead_from_feed ? change : std::fabs(change);
  if (motion == Motion::kThreadDecreasing) event.change = -std::fabs(change);
  if (work.Has(BlockWork::kStartAngle)) event.start_angle = work.start_angle;
  NoteDirection(event);
  emitter_.Send(event);
  return true;
}

/// G53, SUPA: end point in machine coordinates. Where that is in workpiece coordinates only the machine knows.
bool Kinematics::MachineMove(const BlockWork& work) {
  if (channel_.modal.motion != Motion::kRapid || work.Has(BlockWork::kOneShotMotion)) {
    session_.Refuse(diag::Code::kCannotRun, "a move in machine coordinates that is no rapid");
    return false;
  }
  if (work.Has(BlockWork::kPolarRadius | BlockWork::kPolarAngle)) {
    session_.Refuse(diag::Code::kCannotRun, "polar words in machine coordinates");
    return false;
  }
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((work.axes & AxisBit(axis)) == 0) continue;
    const ir::ValueMode mode = work.axis_mode[axis];
    const bool absolute = mode == ir::ValueMode::kModal
                              ? channel_.modal.distance == ir::Distance::kAbsolute
                              : mode == ir::ValueMode::kAbsolute || mode == ir::ValueMode::kAbsoluteDiameter ||
                                    mode == ir::ValueMode::kAbsoluteRadius || mode == ir::ValueMode::kShortest ||
                                    mode == ir::ValueMode::kPositive || mode == ir::ValueMode::kNegative;
    if (!absolute) {
      session_.Refuse(diag::Code::kCannotRun, "an increment in machine coordinates");
      return false;
    }
    if (!Target(work, axis)) return false;
  }
  contour_.OtherMotion();
  if (session_.halted) return false;
  moved_ = work.axes;
  reached_ = work.axes;
  Event& event = MotionEvent(EventKind::kRapidMachine);
  event.known_axes = work.axes;
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((work.axes & AxisBit(axis)) != 0) event.position[axis] = target_[axis];
  }
  emitter_.Send(event);
  channel_.base_known &= static_cast<std::uint16_t>(~work.axes);
  channel_.work_known = channel_.frame.ToWork(channel_.base, channel_.base_known, channel_.work);
  channel_.direction_known = false;
  return true;
}

/// Steps of nothing from a position that is not known: no axis goes anywhere.
bool Kinematics::StaysUnknown(const BlockWork& work) const {
  bool unknown = false;
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((work.axes & AxisBit(axis)) == 0) continue;
    const ir::ValueMode mode = work.axis_mode[axis];
    const bool step = mode == ir::ValueMode::kModal
                          ? channel_.modal.distance == ir::Distance::kIncremental
                          : mode == ir::ValueMode::kIncremental || mode == ir::ValueMode::kIncrementalDiameter ||
                                mode == ir::ValueMode::kIncrementalRadius;
    if (!step || work.axis[axis] != 0) return false;
    unknown = unknown || (channel_.base_known & ~channel_.uncertain & AxisBit(axis)) == 0;
  }
  return unknown;
}

/// To the reference point, by way of the point that the axis words name where the control has one.
void Kinematics::ReferenceMove(const BlockWork& work) {
  contour_.OtherMotion();
  if (session_.halted) return;
  if (work.reference == ir::ReferenceKind::kFromReference) {
    return session_.Refuse(diag::Code::kCannotRun, "a return from the reference point: its way is not known");
  }
  if (session_.machine.reference_via_point && work.axes != 0 && !StaysUnknown(work)) {
    if (!ResolveTargets(work)) return;
    Adopt();
    if (session_.halted) return;
    Event& via = MotionEvent(EventKind::kRapid);
    emitter_.Send(via);
    std::memcpy(from_, channel_.base, sizeof from_);
  }
  if (work.Has(BlockWork::kPoint) && work.point > 0xFFFF) {
    session_.Alarm(ir::AlarmClass::kRange, "number of a reference point");
    return;
  }
  Event& event = emitter_.BeginMotion(EventKind::kReference, from_);
  event.moved_axes = work.axes;
  event.number = static_cast<std::uint32_t>(work.reference);
  if (work.Has(BlockWork::kPoint) && work.point > 0) event.extension = static_cast<std::uint32_t>(work.point);
  emitter_.Send(event);
  channel_.base_known &= static_cast<std::uint16_t>(~work.axes);
  channel_.work_known = channel_.frame.ToWork(channel_.base, channel_.base_known, channel_.work);
  channel_.direction_known = false;
}

void Kinematics::Dwell(const BlockWork& work) {
  if (!(work.dwell >= 0)) return session_.Alarm(ir::AlarmClass::kRange, "dwell below 0");
  bool revolutions = work.dwell_revolutions;
  if (channel_.modal.feed_mode == ir::FeedMode::kPerRevolution && !revolutions) {
    if (session_.machine.dwell_per_revolution == ir::DwellUnit::kUnknown) {
      return session_.Refuse(diag::Code::kCannotRun,
                             "a dwell under feed per revolution: the profile leaves open whether it counts seconds");
    }
    revolutions = session_.machine.dwell_per_revolution == ir::DwellUnit::kRevolutions;
  }
  Event& event = emitter_.Begin(EventKind::kDwell);
  event.value = work.dwell;
  event.per_revolution = revolutions;
  emitter_.Send(event);
}

/// ANG with one end coordinate: the other one follows. Without any: the end waits for the next block. False: no line
/// yet.
bool Kinematics::ResolveAngle(const BlockWork& work) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return false;
  const PlaneAxes axes = AxesOf(channel_.modal.plane);
  if (!Known(axes.first, "a line by its angle") || !Known(axes.second, "a line by its angle")) return false;
  const bool first = (moved_ & AxisBit(axes.first)) != 0;
  const bool second = (moved_ & AxisBit(axes.second)) != 0;
  if (first && second) return true;  // the end point is complete, the angle says nothing more
  if (!first && !second) return OpenAngle(work);
  const double c = ir::ops::Cos(work.contour_angle);
  const double s = ir::ops::Sin(work.contour_angle);
  const double along = first ? c : s;
  const double way =
      first ? target_[axes.first] - channel_.work[axes.first] : target_[axes.second] - channel_.work[axes.second];
  if (along == 0 || (way != 0 && way / along < 0)) {
    session_.Alarm(ir::AlarmClass::kGeometry, "the angle does not lead to the end coordinate");
    return false;
  }
  if (first) {
    target_[axes.second] = channel_.work[axes.second] + way / c * s;
  } else {
    target_[axes.first] = channel_.work[axes.first] + way / s * c;
  }
  moved_ |= static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
  return true;
}

bool Kinematics::OpenAngle(const BlockWork& work) {
  if (moved_ != 0) {
    session_.Refuse(diag::Code::kCannotRun, "a line by its angle that moves axes besides the plane");
    return false;
  }
  if (!FeedReady(work)) return false;
  open_ = {true, work.contour_angle, channel_.feed_known, channel_.feed, channel_.modal.feed_mode,
           work, session_.block};
  return false;
}

/// The second line of a contour of two: both angles and the end point give the corner between them.
bool Kinematics::CloseAngle(const BlockWork& work) {
  const Open open = open_;
  open_.active = false;
  const PlaneAxes axes = AxesOf(channel_.modal.plane);
  const auto both = static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
  const bool complete = channel_.modal.motion == Motion::kLinear && work.Has(BlockWork::kContourAngle) &&
                        !work.Has(BlockWork::kOneShotMotion) && (work.axes & both) == both;
  if (!complete) {
    session_.Alarm(ir::AlarmClass::kGeometry,
                   "a line with only an angle needs a line with angle and end point behind it");
    return false;
  }
  for (const std::uint8_t axis : {axes.first, axes.second}) {
    const ir::ValueMode mode = work.axis_mode[axis];
    const bool absolute = mode == ir::ValueMode::kModal
                              ? channel_.modal.distance == ir::Distance::kAbsolute
                              : mode == ir::ValueMode::kAbsolute || mode == ir::ValueMode::kAbsoluteDiameter ||
                                    mode == ir::ValueMode::kAbsoluteRadius;
    if (absolute) continue;
    session_.Refuse(diag::Code::kCannotRun, "an increment behind a line with only an angle");
    return false;
  }
  if (!ResolveTargets(work)) return false;
  const double c1 = ir::ops::Cos(open.angle), s1 = ir::ops::Sin(open.angle);
  const double c2 = ir::ops::Cos(work.contour_angle), s2 = ir::ops::Sin(work.contour_angle);
  const double end_u = target_[axes.first], end_v = target_[axes.second];
  const double du = end_u - channel_.work[axes.first], dv = end_v - channel_.work[axes.second];
  const double cross = c1 * s2 - s1 * c2;
  if (std::fabs(cross) < 1e-9) {
    session_.Alarm(ir::AlarmClass::kGeometry, "the two lines are parallel");
    return false;
  }
  const double along = (du * s2 - dv * c2) / cross;
  const double rest = (c1 * dv - s1 * du) / cross;
  if (along < 0 || rest < 0) {
    session_.Alarm(ir::AlarmClass::kGeometry, "the angles do not lead to the end point");
    return false;
  }
  const std::uint16_t moved = moved_;
  double target[ir::kMaxAxes];
  std::memcpy(target, target_, sizeof target);

  // The first line goes out with the feed of its own block.
  const ir::BlockId block = session_.block;
  const Open now{false, 0, channel_.feed_known, channel_.feed, channel_.modal.feed_mode, {}, {}};
  const auto use_feed = [&](const Open& of) {
    channel_.feed_known = of.feed_known;
    channel_.feed = of.feed;
    channel_.modal.feed_mode = of.feed_mode;
  };
  session_.block = open.block;
  use_feed(open);
  target_[axes.first] = channel_.work[axes.first] + along * c1;
  target_[axes.second] = channel_.work[axes.second] + along * s1;
  moved_ = both;
  Line(open.work, EventKind::kLine);
  session_.block = block;
  use_feed(now);
  if (session_.halted) return false;

  std::memcpy(from_, channel_.base, sizeof from_);
  from_known_ = channel_.base_known;
  std::memcpy(target_, target, sizeof target);
  moved_ = moved;
  Line(work, EventKind::kLine);
  return true;
}

}  // namespace ncport::exec
