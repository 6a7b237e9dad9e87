// Modal words of motion, feed, and what follows from their change.
#include <cmath>

#include "exec/evaluator.h"
#include "exec/kinematics.h"
#include "ir/length_units.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::WordOp;

Kinematics::Kinematics(Session& session, Channel& channel, Emitter& emitter, const Evaluator& names)
    : session_(session), channel_(channel), emitter_(emitter), names_(names), contour_(session, emitter) {}

std::string_view Kinematics::NameOf(std::uint8_t axis) const { return names_.AxisName(axis); }

void Kinematics::RefuseUnknown(std::string_view what) {
  session_.Refuse(diag::Code::kUnknownModalState, what, "nothing in the run has set it");
}

double Kinematics::LengthFactor() const {
  const ir::Units units = channel_.modal.units;
  return ir::MmPerLengthUnit(units);
}

double Kinematics::FeedFactor() const { return channel_.modal.units == ir::Units::kInch ? ir::kMmPerInch : 1; }

void Kinematics::Set(const ir::Word& word, double extension, BlockWork& work) {
  ir::ModalState& modal = channel_.modal;
  switch (word.op) {
    case WordOp::kMotion: {
      const auto motion = static_cast<ir::Motion>(word.index);
      if (motion == ir::Motion::kTapFloating || motion == ir::Motion::kProbe) {
        work.has |= BlockWork::kOneShotMotion;  // holds for its block, then the mode before is back
        work.one_shot = motion;
      } else {
        modal.motion = motion;
        // A word of motion ends a cycle and what is stored for it (fanuc-8.7). Without a cycle nothing is stored.
        if (channel_.cycle.cycle != ir::Cycle::kNone) channel_.cycle = {};
      }
      work.has |= BlockWork::kMotionWord;
      break;
    }
    case WordOp::kPlane: {
      const auto plane = static_cast<ir::Plane>(word.index);
      if (plane != modal.plane) {  // the pole belongs to the plane (sinumerik-8.6)
        channel_.pole = {};
        channel_.last_pole = {};
        channel_.polar_angle_known = false;
      }
      modal.plane = plane;
      ShowComp();
      break;
    }
    case WordOp::kDistance:
      modal.distance = static_cast<ir::Distance>(word.index);
      break;
    case WordOp::kUnits:
      modal.units = static_cast<ir::Units>(word.index);
      break;
    case WordOp::kFeedMode:
      SetFeedMode(static_cast<ir::FeedMode>(word.index));
      break;
    case WordOp::kSpeedMode:
      SetSpeedMode(word, work);
      break;
    case WordOp::kCutterComp:
      modal.comp = static_cast<ir::CutterComp>(word.index);
      break;
    case WordOp::kDiameter:
      modal.diameter = static_cast<ir::Diameter>(word.index);
      if (modal.diameter != ir::Diameter::kRadius && session_.machine.transverse_axis >= ir::kMaxAxes)
        session_.Alarm(ir::AlarmClass::kNoTransverseAxis, "diameter word without a transverse axis");
      break;
    case WordOp::kPathMode:
      SetPath(static_cast<ir::PathMode>(word.index));
      break;
    case WordOp::kPolarMode:
      channel_.polar_words = word.index != 0;
      break;
    case WordOp::kCycle:
      if (word.extra != Id<void>::kNone) {
        work.has |= BlockWork::kRigid;
        break;
      }
      work.cycle = static_cast<ir::Cycle>(word.index);
      work.has |= BlockWork::kCycleWord;
      break;
    case WordOp::kReturnLevel:
      modal.return_level = static_cast<ir::ReturnLevel>(word.index);
      break;
    case WordOp::kWorkOffset: {
      const bool extended = extension >= 0;
      if (extension > 0xFFFF) {
        session_.Alarm(ir::AlarmClass::kRange, "number of a work offset");
        break;
      }
      SetWorkOffset({true, static_cast<std::uint16_t>(word.extra == Id<void>::kNone ? 0 : word.extra),
                     static_cast<std::uint16_t>(extended ? extension : 0)});
      break;
    }
    default:
      break;
  }
}

void Kinematics::SetFeedMode(ir::FeedMode mode) {
  if (mode == channel_.modal.feed_mode) return;
  channel_.modal.feed_mode = mode;
  if (session_.machine.feed_type_change_drops_feed) channel_.feed_known = false;
}

/// Without S the last surface speed is in force again (sinumerik-8.8, fanuc-8.1).
void Kinematics::TakeSurfaceSpeed(const BlockWork& work) {
  Channel::Spindle& spindle = channel_.spindles[0];
  spindle.speed_known = false;
  if (!spindle.surface_known || work.Has(BlockWork::kSpeed)) return;
  spindle.speed_known = true;
  spindle.speed = spindle.surface;
  Event& event = emitter_.Begin(EventKind::kSpindleSurface);
  event.value = spindle.speed;
  emitter_.Send(event);
}

/// Constant surface speed may bring the feed per revolution with it; a word that freezes the speed turns the surface
/// speed of this moment into 1/min (sinumerik-8.8).
void Kinematics::SetSpeedMode(const ir::Word& word, const BlockWork& work) {
  const auto mode = static_cast<ir::SpeedMode>(word.index);
  const bool was_surface = channel_.modal.speed_mode == ir::SpeedMode::kConstantSurface;
  channel_.modal.speed_mode = mode;
  if (mode == ir::SpeedMode::kConstantSurface) {
    if (!was_surface) TakeSurfaceSpeed(work);
    if (session_.machine.surface_speed_per_revolution && !work.Has(BlockWork::kFeedMode))
      SetFeedMode(ir::FeedMode::kPerRevolution);
    return;
  }
  Channel::Spindle& spindle = channel_.spindles[0];
  if (!was_surface || !spindle.speed_known) return;
  if ((word.flags & ir::Word::kFreezes) == 0 || work.Has(BlockWork::kSpeed)) {
    spindle.speed_known = false;  // a new speed must come
    return;
  }
  const std::uint8_t transverse = session_.machine.transverse_axis;
  const bool known = transverse < ir::kMaxAxes &&
                     (channel_.base_known & ~channel_.uncertain & AxisBit(transverse)) != 0 &&
                     channel_.base[transverse] != 0;
  if (!known) {
    session_.Refuse(diag::Code::kCannotRun, "the surface speed is frozen where the diameter is not known");
    return;
  }
  constexpr double kPi = 3.14159265358979323846;
  double speed = 1000 * spindle.speed / (2 * kPi * std::fabs(channel_.base[transverse]));
  if (spindle.limit_known) speed = std::fmin(speed, spindle.limit);
  spindle.speed = speed;
  Event& event = emitter_.Begin(EventKind::kSpindleSpeed);
  event.value = speed;
  emitter_.Send(event);
}

void Kinematics::SetWorkOffset(const ir::WorkOffset& offset) {
  const ir::WorkOffset old = channel_.modal.work_offset;
  if (old == offset) return;
  channel_.modal.work_offset = offset;
  // Where the axes stand in the new system depends on the difference of two offsets that only the machine knows.
  if (old.known) channel_.uncertain |= channel_.base_known;
  Event& event = emitter_.Begin(EventKind::kWorkOffset);
  event.number = offset.number;
  event.extension = offset.extension;
  emitter_.Send(event);
}

void Kinematics::SetPath(ir::PathMode mode, bool one_block) {
  if (mode == channel_.modal.path) return;
  channel_.modal.path = mode;  // unknown again behind an exact stop of one block, where it was unknown before
  Event& event = emitter_.Begin(EventKind::kPath);
  event.path = mode;
  event.one_block = one_block;
  emitter_.Send(event);
}

/// The side of the compensation in trace coordinates: a mirror in the plane exchanges left and right.
void Kinematics::ShowComp() {
  ir::CutterComp shown = channel_.modal.comp;
  const bool sided = shown == ir::CutterComp::kLeft || shown == ir::CutterComp::kRight;
  if (sided && !channel_.frame.IsIdentity() && MapPlane(channel_.frame, channel_.modal.plane).mirrored) {
    shown = shown == ir::CutterComp::kLeft ? ir::CutterComp::kRight : ir::CutterComp::kLeft;
  }
  if (shown == channel_.shown_comp) return;
  channel_.shown_comp = shown;
  if (shown == ir::CutterComp::kUnknown) return;
  Event& event = emitter_.Begin(EventKind::kComp);
  event.comp = shown;
  emitter_.Send(event);
}

/// F after all mode words of the block, whatever their order: `F10 G700` is inch per minute.
void Kinematics::SetFeed(const BlockWork& work) {
  const ir::Motion motion = channel_.modal.motion;
  const bool variable_thread = motion == ir::Motion::kThreadIncreasing || motion == ir::Motion::kThreadDecreasing;
  if (variable_thread && !session_.machine.thread_lead_from_feed) {
    channel_.thread_change = work.feed * FeedFactor();  // there F is the change of the lead (sinumerik-8.4)
    return;
  }
  if (Unknown(channel_.modal.feed_mode == ir::FeedMode::kUnknown, "the feed mode")) return;
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
  channel_.feed_mode = channel_.modal.feed_mode;
  // A lead stays a length where other moves have their F as 1/min (fanuc-5, F lead of a thread).
  const bool lead = session_.machine.thread_lead_from_feed && (motion == ir::Motion::kThread || variable_thread);
  const bool time = channel_.feed_mode == ir::FeedMode::kInverseTime && !lead;
  channel_.feed = time ? work.feed : work.feed * FeedFactor();
  channel_.feed_known = true;
}

double Kinematics::Increment(bool rotary) const {
  // 0.001 mm and degrees, 0.0001 inch: the unit of the words themselves.
  return rotary || LengthFactor() == 1 ? session_.machine.increment : session_.machine.increment / 10;
}

double Kinematics::Rounded(double value, double increment) const {
  switch (session_.machine.word_error) {
    case ir::WordError::kNone:
      return value;
    case ir::WordError::kRound:
      return ir::ops::RoundToIncrement(value, increment);
    case ir::WordError::kTruncate:
      return ir::ops::TruncateToIncrement(value, increment);
  }
  return value;
}

double Kinematics::WordOf(const BlockWork& work, std::uint8_t axis, bool angle) const {
  double value = work.axis[axis];
  if ((work.scaled_axes & AxisBit(axis)) != 0) value *= Increment(angle);
  if ((work.rounded & AxisBit(axis)) != 0) value = Rounded(value, Increment(angle));
  return value;
}

/// Numbers without decimal point count what the modes in force say; computed values are rounded on their way to the
/// address.
void Kinematics::Scale(BlockWork& work) {
  const ir::Machine& machine = session_.machine;
  const double length = Increment(false);
  const bool inch = LengthFactor() != 1;
  const auto round = [&](double& value) { value = Rounded(value, length); };
  if ((work.rounded_words & BlockWork::kRadius) != 0) round(work.radius);
  for (int i = 0; i < 3; ++i) {
    if ((work.rounded_centers >> i & 1U) != 0) round(work.center[i]);
    if ((work.scaled_centers >> i & 1U) != 0) work.center[i] *= length;
  }
  if ((work.scaled & BlockWork::kRadius) != 0) work.radius *= length;
  if ((work.scaled & BlockWork::kChamfer) != 0) work.chamfer *= length;
  if ((work.scaled & BlockWork::kContourAngle) != 0) work.contour_angle *= machine.increment;
  if ((work.scaled & BlockWork::kFrameAngle) != 0) work.frame_angle *= machine.increment;
  if ((work.scaled & BlockWork::kStartAngle) != 0) {
    if ((work.rounded_words & BlockWork::kStartAngle) != 0) work.start_angle = ir::ops::Round(work.start_angle);
    work.start_angle *= 0.001;
  }
  if ((work.scaled & BlockWork::kDwell) != 0) work.dwell *= 0.001;
  if ((work.scaled & BlockWork::kFeed) != 0) {
    const ir::Motion motion = channel_.modal.motion;
    const bool thread = motion == ir::Motion::kThread || motion == ir::Motion::kThreadIncreasing;
    const bool revolution = thread || channel_.modal.feed_mode == ir::FeedMode::kPerRevolution;
    const ir::NumberUnits& units = machine.units;
    if (revolution) {
      work.feed *= inch ? units.feed_per_revolution_inch : units.feed_per_revolution;
    } else if (channel_.modal.feed_mode == ir::FeedMode::kPerMinute) {
      work.feed *= inch ? units.feed_per_minute_inch : units.feed_per_minute;
    }
  }
  for (int i = 0; i < 4; ++i) {
    if ((work.scaled_factors >> i & 1U) != 0) work.factor[i] *= 0.001;
  }
  for (std::uint32_t rest = work.cycle_rounded; rest != 0; rest &= rest - 1) {
    round(work.cycle_value[static_cast<std::size_t>(__builtin_ctz(rest))]);
  }
  for (std::uint32_t rest = work.cycle_scaled; rest != 0; rest &= rest - 1) {
    const auto field = static_cast<std::size_t>(__builtin_ctz(rest));
    work.cycle_value[field] *= static_cast<ir::CycleField>(field) == ir::CycleField::kDwell ? 0.001 : length;
  }
}

void Kinematics::FinishSettings(BlockWork& work) {
  const bool written = work.scaled != 0 || work.rounded_words != 0 || work.scaled_centers != 0 ||
                       work.rounded_centers != 0 || work.cycle_scaled != 0 || work.cycle_rounded != 0 ||
                       work.scaled_factors != 0;
  if (written) Scale(work);
  if (work.Has(BlockWork::kRigid)) ArmRigidTaps();
  if (work.Has(BlockWork::kCycleWord)) BeginCycle(work);
  if (work.Has(BlockWork::kFeed)) SetFeed(work);
  if (work.Has(BlockWork::kFrame | BlockWork::kFrameEnds)) ApplyFrame(work);
  if (work.Has(BlockWork::kRoundModal)) channel_.modal_rounding = work.round_modal * LengthFactor();
  if (channel_.modal.comp != channel_.shown_comp) ShowComp();
}

void Kinematics::Restore(const ir::ModalState& modal, const Frame& frame) {
  channel_.frame = frame;
  FrameChanged();
  const ir::ModalState now = channel_.modal;
  if (now.feed_mode != modal.feed_mode)
    channel_.feed_known = channel_.feed_known && channel_.feed_mode == modal.feed_mode;
  if (modal.work_offset.known) SetWorkOffset(modal.work_offset);
  if (modal.path != now.path) {
    // Also back to the mode that no word of the program selected.
    Event& event = emitter_.Begin(EventKind::kPath);
    event.path = modal.path;
    emitter_.Send(event);
  }
  channel_.modal = modal;
  ShowComp();
}

void Kinematics::Finish() {
  if (open_.active) session_.Alarm(ir::AlarmClass::kGeometry, "no motion behind the line with an angle");
  contour_.Finish();
}

}  // namespace ncport::exec
