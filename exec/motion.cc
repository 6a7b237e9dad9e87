// The motion of a block: where its words lead, and straight lines.
#include <cmath>
#include <cstring>

#include "exec/kinematics.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/trigonometry.h"

namespace ncport::exec {

using ir::Motion;
using ir::ValueMode;

namespace {

constexpr bool IsIncremental(ValueMode mode) {
  return mode == ValueMode::kIncremental || mode == ValueMode::kIncrementalDiameter ||
         mode == ValueMode::kIncrementalRadius || mode == ValueMode::kStep;
}

constexpr bool NeedsFeed(EventKind kind) {
  return kind == EventKind::kLine || kind == EventKind::kArc || kind == EventKind::kProbe;
}

}  // namespace

bool Kinematics::Move(const BlockWork& work) {
  if (work.Has(BlockWork::kDwell)) Dwell(work);
  // Its axis words were values of the frame, or named the axes of a mirror. The end of a rotation or scale takes none.
  if (work.Has(BlockWork::kFrame) || (work.axes != 0 && work.Has(BlockWork::kMirrorEnd))) return false;
  if (work.Has(BlockWork::kPole)) {
    SetPole(work);
    return false;
  }
  if (work.Has(BlockWork::kPreset)) {
    Preset(work);
    return false;
  }
  const bool polar = work.Has(BlockWork::kPolarRadius | BlockWork::kPolarAngle);
  const bool round = work.centers != 0 || work.Has(BlockWork::kRadius | BlockWork::kOpening);
  const Motion motion = work.Has(BlockWork::kOneShotMotion) ? work.one_shot : channel_.modal.motion;
  const bool circle = motion >= Motion::kArcCw && motion <= Motion::kArcTangent && (round || work.vias != 0);
  const bool in_cycle = channel_.cycle.cycle != ir::Cycle::kNone && (round || work.cycle_fields != 0);
  if (work.axes == 0 && work.cycle_fields == 0 && !in_cycle && !polar && !circle &&
      !work.Has(BlockWork::kContourAngle | BlockWork::kReference))
    return false;

  std::memcpy(from_, channel_.base, sizeof from_);
  from_known_ = channel_.base_known;
  if (channel_.cycle.cycle != ir::Cycle::kNone && !work.Has(BlockWork::kMachineCoords)) {
    const bool reference = work.Has(BlockWork::kReference);
    if (reference && IsHole(channel_.cycle.cycle)) {
      session_.Alarm(ir::AlarmClass::kOther, "reference move while a drilling cycle is active");  // PS0044
      return false;
    }
    if (!reference) return CycleMove(work);  // beside one the words are its own, also under a single cut of a lathe
  }
  if (channel_.cycle.rigid && channel_.cycle.cycle == ir::Cycle::kNone && work.axes != 0) {
    session_.Refuse(diag::Code::kCannotRun, "a move between the word for rigid tapping and its cycle");
    return false;
  }
  if (work.cycle_fields != 0) {
    session_.Refuse(diag::Code::kCannotRun, "a word of a cycle while no cycle is in force");
    return false;
  }
  if (work.Has(BlockWork::kReference)) {
    ReferenceMove(work);
    return false;
  }
  const ir::PathMode path = channel_.modal.path;
  if (work.Has(BlockWork::kExactOnce)) SetPath(ir::PathMode::kExact, true);
  const bool moved = MoveByMode(work);
  if (work.Has(BlockWork::kExactOnce)) SetPath(path, true);
  return moved && !session_.halted;
}

bool Kinematics::MoveByMode(const BlockWork& work) {
  const Motion motion = work.Has(BlockWork::kOneShotMotion) ? work.one_shot : channel_.modal.motion;
  if (work.Has(BlockWork::kMachineCoords)) return MachineMove(work);
  if (open_.active) return CloseAngle(work);
  const bool takes_center = (motion >= Motion::kArcCw && motion <= Motion::kTapOut) || motion == Motion::kUnknown;
  if (!takes_center &&
      (work.centers != 0 || work.vias != 0 || work.Has(BlockWork::kRadius | BlockWork::kOpening | BlockWork::kTurns))) {
    session_.Refuse(diag::Code::kCannotRun, "words of an arc while no arc is in force");
    return false;
  }
  if (!ResolveTargets(work)) return false;
  switch (motion) {
    case Motion::kUnknown:
      return !Unknown(true, "the kind of motion");
    case Motion::kNone:
      session_.Refuse(diag::Code::kCannotRun, "axis words while no kind of motion is in force");
      return false;
    case Motion::kRapid:
      if (!NoCircleWords(work)) return false;
      Line(work, EventKind::kRapid);
      return true;
    case Motion::kLinear:
    case Motion::kTapFloating:
      if (!NoCircleWords(work)) return false;
      if (work.Has(BlockWork::kContourAngle) && !ResolveAngle(work)) return open_.active;
      Line(work, EventKind::kLine);
      return true;
    case Motion::kProbe:
      Line(work, EventKind::kProbe);
      return true;
    case Motion::kArcCw:
    case Motion::kArcCcw:
      ArcMove(work, motion == Motion::kArcCw);
      return true;
    case Motion::kArcVia:
      ArcVia(work);
      return true;
    case Motion::kArcTangent:
      ArcTangent(work);
      return true;
    case Motion::kThread:
    case Motion::kThreadIncreasing:
    case Motion::kThreadDecreasing:
    case Motion::kTapIn:
    case Motion::kTapOut:
      return Thread(work, motion);
  }
  return false;
}

/// Centre and radius words beside a straight line mean something else on some controls (chamfers of lathes): never
/// dropped.
bool Kinematics::NoCircleWords(const BlockWork& work) {
  if (work.centers == 0 && !work.Has(BlockWork::kRadius)) return true;
  session_.Refuse(diag::Code::kCannotRun, "centre or radius words beside a straight move");
  return false;
}

/// Whether a word of the transverse axis is a diameter (sinumerik-8.5). `incremental`: how the word is meant.
bool Kinematics::TransverseInDiameter(ValueMode mode, bool incremental) const {
  switch (mode) {
    case ValueMode::kAbsoluteDiameter:
    case ValueMode::kIncrementalDiameter:
      return true;
    case ValueMode::kAbsoluteRadius:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      return false;
    default:
      break;
  }
  const ir::Diameter diameter = channel_.modal.diameter;
  return diameter == ir::Diameter::kDiameter || (diameter == ir::Diameter::kDiameterAbsolute && !incremental);
}

bool Kinematics::Known(std::uint8_t axis, std::string_view why) {
  const std::uint16_t bit = AxisBit(axis);
  if ((channel_.work_known & bit) != 0 && (channel_.uncertain & channel_.frame.Reach(bit)) == 0) return true;
  if (why == "increment") {
    session_.Refuse(diag::Code::kUnknownPosition, NameOf(axis));
  } else {
    session_.Refuse(diag::Code::kCannotRun,
                    fmt::format("{} needs the position of {}, which is not known", why, NameOf(axis)));
  }
  return false;
}

/// One axis word to workpiece coordinates in mm or degrees, the transverse axis as radius.
bool Kinematics::Target(const BlockWork& work, std::uint8_t axis) {
  const ValueMode mode = work.axis_mode[axis];
  const ir::ModalState& modal = channel_.modal;
  if (mode == ValueMode::kModal && Unknown(modal.distance == ir::Distance::kUnknown, "absolute or incremental"))
    return false;
  const bool incremental =
      mode == ValueMode::kModal ? modal.distance == ir::Distance::kIncremental : IsIncremental(mode);
  const bool rotary = ir::IsRotary(axis);
  if (!rotary && Unknown(modal.units == ir::Units::kUnknown, "the unit of lengths")) return false;
  const double factor = rotary ? 1 : LengthFactor();

  double value = WordOf(work, axis, rotary);
  if (rotary && (mode == ValueMode::kPositive || mode == ValueMode::kNegative) && !(value >= 0 && value < 360)) {
    session_.Alarm(ir::AlarmClass::kRange, "rotary position outside 0 to 359.999");
    return false;
  }
  value *= factor;
  if (axis == session_.machine.transverse_axis) {
    if (Unknown(modal.diameter == ir::Diameter::kUnknown, "diameter or radius")) return false;
    if (TransverseInDiameter(mode, incremental)) value /= 2;
  } else if (mode == ValueMode::kAbsoluteDiameter || mode == ValueMode::kIncrementalDiameter) {
    session_.Alarm(ir::AlarmClass::kNoTransverseAxis, "diameter word of an axis that is not transverse");
    return false;
  }
  if (incremental) {
    if (!Known(axis, "increment")) return false;
    value += session_.machine.incremental_traverses_frame ? channel_.step_from[axis] : channel_.work[axis];
  }
  target_[axis] = value;
  return true;
}

bool Kinematics::ResolveTargets(const BlockWork& work) {
  moved_ = work.axes;
  for (std::uint16_t rest = work.axes; rest != 0; rest &= static_cast<std::uint16_t>(rest - 1)) {
    if (!Target(work, static_cast<std::uint8_t>(__builtin_ctz(rest)))) return false;
  }
  if (channel_.polar_words) return ResolvePolarWords(work);
  return !work.Has(BlockWork::kPolarRadius | BlockWork::kPolarAngle) || ResolvePolar(work);
}

/// AP and RP around the pole (sinumerik-8.6): both stay until changed, the radius is always absolute.
bool Kinematics::ResolvePolar(const BlockWork& work) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return false;
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return false;
  const PlaneAxes axes = AxesOf(channel_.modal.plane);
  const auto plane_bits = static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
  if ((work.axes & plane_bits) != 0) {
    session_.Alarm(ir::AlarmClass::kGeometry, "polar words and axis words of the plane in one block");
    return false;
  }
  if (work.Has(BlockWork::kPolarRadius)) {
    if (work.polar_radius < 0) {
      session_.Alarm(ir::AlarmClass::kGeometry, "negative polar radius");
      return false;
    }
    channel_.polar_radius = work.polar_radius * LengthFactor();
    channel_.polar_radius_known = true;
  }
  if (work.Has(BlockWork::kPolarAngle)) {
    const ValueMode mode = work.polar_angle_mode;
    const bool adds = mode == ValueMode::kIncremental ||
                      (mode == ValueMode::kModal && channel_.modal.distance == ir::Distance::kIncremental);
    if (adds && !channel_.polar_angle_known) {
      session_.Refuse(diag::Code::kCannotRun, "an increment of the polar angle before an angle");
      return false;
    }
    channel_.polar_angle = work.polar_angle + (adds ? channel_.polar_angle : 0);
    channel_.polar_angle_known = true;
  }
  if (!channel_.polar_radius_known || !channel_.polar_angle_known) {
    session_.Alarm(ir::AlarmClass::kGeometry, "polar radius or angle is missing");
    return false;
  }
  target_[axes.first] = channel_.pole.u + channel_.polar_radius * ir::ops::Cos(channel_.polar_angle);
  target_[axes.second] = channel_.pole.v + channel_.polar_radius * ir::ops::Sin(channel_.polar_angle);
  moved_ |= plane_bits;
  return true;
}

/// Words of the plane as radius and angle while that mode is on (fanuc-8.5): the pole is the zero of the work system;
/// an incremental radius has its pole at the present position. What is missing stays as seen from the zero.
bool Kinematics::ResolvePolarWords(const BlockWork& work) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return false;
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return false;
  const PlaneAxes axes = AxesOf(channel_.modal.plane);
  const auto has = [&](std::uint8_t axis) { return (work.axes & AxisBit(axis)) != 0; };
  if (!has(axes.first) && !has(axes.second)) return true;
  const auto incremental = [&](std::uint8_t axis) {
    const ValueMode mode = work.axis_mode[axis];
    return mode == ValueMode::kModal ? channel_.modal.distance == ir::Distance::kIncremental : IsIncremental(mode);
  };
  const auto value = [&](std::uint8_t axis, bool angle) {
    const double written = WordOf(work, axis, angle);
    return angle ? written : written * LengthFactor();
  };
  const bool from_here = has(axes.first) && incremental(axes.first);
  const bool needs_position = from_here || !has(axes.first) || !has(axes.second) || incremental(axes.second);
  if (needs_position && (!Known(axes.first, "polar words") || !Known(axes.second, "polar words"))) return false;
  const Point here = needs_position ? Point{channel_.work[axes.first], channel_.work[axes.second]} : Point{};
  const double radius = has(axes.first) ? value(axes.first, false) : std::hypot(here.u, here.v);
  double angle = 0;
  if (!has(axes.second) || incremental(axes.second)) angle = ir::ops::Atan2(here.v, here.u);
  if (has(axes.second)) angle += value(axes.second, true);
  const Point pole = from_here ? here : Point{};
  target_[axes.first] = pole.u + radius * ir::ops::Cos(angle);
  target_[axes.second] = pole.v + radius * ir::ops::Sin(angle);
  moved_ |= static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
  return true;
}

/// The targets become the programmed position.
void Kinematics::Adopt() {
  const Frame& frame = channel_.frame;
  if (frame.IsIdentity()) {
    for (std::uint16_t rest = moved_; rest != 0; rest &= static_cast<std::uint16_t>(rest - 1)) {
      const auto axis = static_cast<std::uint8_t>(__builtin_ctz(rest));
      channel_.work[axis] = target_[axis];
      channel_.step_from[axis] = target_[axis];
      channel_.base[axis] = target_[axis];
    }
    reached_ = moved_;
  } else {
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      if ((moved_ & AxisBit(axis)) == 0) continue;
      channel_.work[axis] = target_[axis];
      channel_.step_from[axis] = target_[axis];
    }
    reached_ = frame.Reach(moved_);
    double base[ir::kMaxAxes];
    const std::uint16_t known = frame.ToBase(channel_.work, channel_.work_known | moved_, base);
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      if ((reached_ & AxisBit(axis)) == 0) continue;
      if ((known & AxisBit(axis)) == 0) {
        session_.Refuse(
            diag::Code::kCannotRun,
            fmt::format("under this frame {} depends on an axis whose position is not known", NameOf(axis)));
        return;
      }
      channel_.base[axis] = base[axis];
    }
  }
  channel_.work_known |= moved_;
  channel_.base_known |= reached_;
  channel_.programmed |= reached_;
  channel_.uncertain &= static_cast<std::uint16_t>(~reached_);
}

bool Kinematics::FeedReady(const BlockWork& work) {
  if (work.Has(BlockWork::kFeedOnce)) return true;
  if (Unknown(channel_.modal.feed_mode == ir::FeedMode::kUnknown, "the feed mode")) return false;
  if (channel_.feed_known && channel_.feed > 0) return true;
  if (!session_.machine.feed_needed && !channel_.feed_known) return true;
  session_.Alarm(ir::AlarmClass::kMissingFeed, channel_.feed_known ? "feed is not above 0" : "no feed programmed");
  return false;
}

Event& Kinematics::MotionEvent(EventKind kind) {
  Event& event = emitter_.BeginMotion(kind, from_);
  event.moved_axes = reached_;
  event.feed_mode = channel_.modal.feed_mode;
  event.feed = channel_.feed_known ? channel_.feed : 0;
  return event;
}

void Kinematics::NoteDirection(const Event& event) {
  const std::uint16_t geometry = event.moved_axes & 7U;
  if (geometry == 0) return;
  channel_.direction_known = (geometry & ~from_known_) == 0;
  if (!channel_.direction_known) return;
  double way[3];
  bool any = false;
  for (int axis = 0; axis < 3; ++axis) {
    way[axis] = (geometry >> axis & 1U) != 0 ? event.position[axis] - event.from[axis] : 0;
    any = any || way[axis] != 0;
  }
  if (any) std::memcpy(channel_.direction, way, sizeof way);
}

Contour::Wish Kinematics::WishOf(const BlockWork& work) {
  Contour::Wish wish;
  if (work.Has(BlockWork::kChamfer)) {
    wish.kind = work.chamfer_kind;
    wish.size = work.chamfer * LengthFactor();
    if (wish.size < 0) session_.Alarm(ir::AlarmClass::kGeometry, "negative chamfer or rounding");
  } else if (channel_.modal_rounding > 0) {
    wish.kind = ir::ChamferKind::kRoundModal;
    wish.size = channel_.modal_rounding;
  }
  wish.active = wish.size > 0;
  if (!wish.active) return wish;
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return wish;
  const PlaneMap map = MapPlane(channel_.frame, channel_.modal.plane);
  if (!map.parallel || !map.similar) {
    session_.Refuse(diag::Code::kCannotRun, "a chamfer or rounding in a plane that is tilted or scaled unevenly");
    return wish;
  }
  wish.plane = map.plane;
  wish.size *= map.scale;
  const PlaneAxes axes = AxesOf(map.plane);
  const auto bits = static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
  if ((from_known_ & bits) != bits || (channel_.base_known & bits) != bits) {
    session_.Refuse(diag::Code::kCannotRun, "a chamfer or rounding from a position that is not known");
  }
  return wish;
}

void Kinematics::Line(const BlockWork& work, EventKind kind) {
  if (NeedsFeed(kind) && !FeedReady(work)) return;
  Adopt();
  if (session_.halted) return;
  Event& event = MotionEvent(kind);
  if (work.Has(BlockWork::kFeedOnce)) event.feed = work.feed_once * FeedFactor();
  NoteDirection(event);
  if (kind == EventKind::kLine) {
    const Contour::Wish wish = WishOf(work);
    if (!session_.halted) contour_.Element(event, wish);
    return;
  }
  if (work.Has(BlockWork::kChamfer)) {
    return session_.Refuse(diag::Code::kCannotRun, "a chamfer or rounding behind a motion that is no feed move");
  }
  contour_.OtherMotion();
  if (session_.halted) return;
  emitter_.Send(event);
  if (kind == EventKind::kProbe) channel_.uncertain |= reached_;  // it stands where the probe triggered
}

}  // namespace ncport::exec
