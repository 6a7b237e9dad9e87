// Canned cycles: holes, and single cuts of lathes (fanuc-8.7, 8.8).
#include <algorithm>
#include <cmath>
#include <cstring>

#include "exec/kinematics.h"

namespace ncport::exec {

using ir::Cycle;
using ir::CycleField;
using ir::Motion;

namespace {

constexpr bool IsLatheHole(Cycle cycle) { return cycle >= Cycle::kFacePeck && cycle <= Cycle::kCrossBore; }
constexpr bool IsTap(Cycle cycle) {
  return cycle == Cycle::kTap || cycle == Cycle::kTapLeft || cycle == Cycle::kFaceTap || cycle == Cycle::kCrossTap;
}
constexpr bool IsTurning(Cycle cycle) { return cycle >= Cycle::kTurn && cycle <= Cycle::kTurnFace; }

}  // namespace

/// What is stored for a hole holds for the next kind of hole too, until the cycles end (fanuc-8.7).
void Kinematics::BeginCycle(const BlockWork& work) {
  CycleState& state = channel_.cycle;
  const bool keeps = IsHole(state.cycle) && IsHole(work.cycle) && IsLatheHole(state.cycle) == IsLatheHole(work.cycle);
  const bool rigid = (state.rigid || work.Has(BlockWork::kRigid)) && work.cycle != Cycle::kNone;
  if (!keeps) state = {};
  state.cycle = work.cycle;
  state.rigid = rigid;
}

/// The spindle stops: from here on it turns as the cycle feeds (fanuc-8.7).
void Kinematics::ArmRigidTaps() {
  channel_.cycle.rigid = true;
  const ir::SpindleState now = channel_.spindles[0].state;
  if (now == ir::SpindleState::kCw || now == ir::SpindleState::kCcw) Turn(ir::SpindleState::kStop);
}

/// In and out with the lead that feed and speed give; below 0 for a left-hand tap.
void Kinematics::RigidTap(std::uint8_t axis, bool left) {
  if (session_.halted) return;
  const CycleState state = channel_.cycle;
  if (state.step_known && state.step != 0) return session_.Refuse(diag::Code::kCannotRun, "tapping with pecks");
  const Channel::Spindle& spindle = channel_.spindles[0];
  const bool per_minute = channel_.feed_mode == ir::FeedMode::kPerMinute;
  const bool turns = spindle.speed_known && spindle.speed > 0 && channel_.modal.speed_mode == ir::SpeedMode::kRpm;
  if (!channel_.feed_known || channel_.feed <= 0 || channel_.feed_mode == ir::FeedMode::kInverseTime ||
      (per_minute && !turns)) {
    return session_.Refuse(diag::Code::kCannotRun, "rigid tapping whose lead no feed and speed give");
  }
  const double lead = per_minute ? channel_.feed / spindle.speed : channel_.feed;
  const auto tap = [&](double target) {
    if (session_.halted) return;
    std::memcpy(from_, channel_.base, sizeof from_);
    from_known_ = channel_.base_known;
    target_[axis] = target;
    moved_ = AxisBit(axis);
    contour_.OtherMotion();
    if (session_.halted) return;
    Adopt();
    if (session_.halted) return;
    Event& event = MotionEvent(EventKind::kTap);
    event.value = left ? -lead : lead;
    NoteDirection(event);
    emitter_.Send(event);
  };
  tap(state.depth);
  Pause(state.dwell);
  tap(state.level);
}

void Kinematics::Go(std::uint16_t axes, const double* targets, EventKind kind) {
  if (session_.halted) return;
  static constexpr BlockWork kNoWork{};
  std::memcpy(from_, channel_.base, sizeof from_);
  from_known_ = channel_.base_known;
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((axes & AxisBit(axis)) != 0) target_[axis] = targets[axis];
  }
  moved_ = axes;
  Line(kNoWork, kind);
}

void Kinematics::GoTo(std::uint8_t axis, double target, EventKind kind) {
  double targets[ir::kMaxAxes] = {};
  targets[axis] = target;
  Go(AxisBit(axis), targets, kind);
}

void Kinematics::Pause(double seconds) {
  if (session_.halted || seconds <= 0) return;
  contour_.OtherMotion();
  Event& event = emitter_.Begin(EventKind::kDwell);
  event.value = seconds;
  emitter_.Send(event);
}

void Kinematics::Turn(ir::SpindleState state) {
  if (session_.halted) return;
  channel_.spindles[0].state = state;
  Event& event = emitter_.Begin(EventKind::kSpindle);
  event.spindle_state = state;
  emitter_.Send(event);
}

bool Kinematics::Drills(const BlockWork& work) const {
  const Cycle cycle = channel_.cycle.cycle;
  if (!IsHole(cycle) || work.Has(BlockWork::kMachineCoords | BlockWork::kReference)) return false;
  return (work.axes & (IsLatheHole(cycle) ? 0xFFFFU : 7U)) != 0 || work.HasField(CycleField::kLevel) ||
         work.Has(BlockWork::kRadius);
}

bool Kinematics::CycleMove(const BlockWork& work) {
  const Cycle cycle = channel_.cycle.cycle;
  if (IsHole(cycle)) return Drill(work);
  if (IsTurning(cycle)) return TurningCycle(work);
  session_.Refuse(diag::Code::kCannotRun, "a turning cycle over a contour");
  return false;
}

// --- holes

/// Data of the block for holes: level and depth become coordinates. Under increments the level counts from the initial
/// level, the depth from the level.
bool Kinematics::StoreHole(const BlockWork& work, std::uint8_t axis, bool lathe) {
  CycleState& state = channel_.cycle;
  if (!state.initial_known && (channel_.work_known & ~channel_.uncertain & AxisBit(axis)) != 0) {
    state.initial_known = true;
    state.initial = channel_.work[axis];
  }
  if (Unknown(channel_.modal.distance == ir::Distance::kUnknown, "absolute or incremental")) return false;
  const bool incremental = channel_.modal.distance == ir::Distance::kIncremental;
  const bool has_level = work.HasField(CycleField::kLevel) || work.Has(BlockWork::kRadius);
  if (has_level) {
    double level = (work.HasField(CycleField::kLevel) ? work.Field(CycleField::kLevel) : work.radius) * LengthFactor();
    if (incremental || (lathe && session_.machine.cycle_level_from_initial)) {
      if (!state.initial_known) {
        session_.Refuse(diag::Code::kUnknownPosition, NameOf(axis));
        return false;
      }
      level += state.initial;
    }
    state.level = level;
    state.level_known = true;
  }
  if ((work.axes & AxisBit(axis)) != 0) {
    const ir::ValueMode mode = work.axis_mode[axis];
    const bool step = mode == ir::ValueMode::kModal ? incremental : mode == ir::ValueMode::kIncremental;
    double depth = WordOf(work, axis, false) * LengthFactor();
    if (axis == session_.machine.transverse_axis && TransverseInDiameter(mode, step)) depth /= 2;
    if (step) {
      if (!state.level_known) {
        session_.Refuse(diag::Code::kCannotRun, "an incremental depth without a level");
        return false;
      }
      depth += state.level;
    }
    state.depth = depth;
    state.depth_known = true;
  }
  if (work.HasField(CycleField::kStep)) {
    state.step = std::fabs(work.Field(CycleField::kStep)) * LengthFactor();
    state.step_known = true;
  }
  if (work.HasField(CycleField::kDwell)) {
    state.dwell = work.Field(CycleField::kDwell);
    state.dwell_known = true;
  }
  const std::uint32_t shifts = work.cycle_fields & (1U << static_cast<unsigned>(CycleField::kShiftX) |
                                                    1U << static_cast<unsigned>(CycleField::kShiftY) |
                                                    1U << static_cast<unsigned>(CycleField::kShiftZ));
  if (shifts != 0) {
    session_.Refuse(diag::Code::kCannotRun, "pecks that shrink from one to the next");
    return false;
  }
  return true;
}

/// Rapid to the place, then the hole; each repetition again, so that increments make a row (fanuc-8.7).
bool Kinematics::Drill(const BlockWork& work) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return false;
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return false;
  CycleState& state = channel_.cycle;
  const bool lathe = IsLatheHole(state.cycle);
  const std::uint8_t axis = !lathe ? AxesOf(channel_.modal.plane).normal : state.cycle >= Cycle::kCrossPeck ? 0 : 2;
  const bool has_level = work.HasField(CycleField::kLevel) || work.Has(BlockWork::kRadius);
  const std::uint16_t geometry = work.axes & static_cast<std::uint16_t>(lathe ? 0xFFFFU : 7U);
  if (geometry == 0 && !has_level) {
    // Other axes move without drilling; P and Q of such a block are not stored.
    if (work.axes == 0) return false;
    if (!ResolveTargets(work)) return false;
    Line(work, EventKind::kRapid);
    return true;
  }
  if ((work.centers & 3U) != 0) {
    session_.Refuse(diag::Code::kCannotRun, "centre words in a cycle");
    return false;
  }
  if (!StoreHole(work, axis, lathe)) return false;
  double repeats = 1;
  if (work.HasField(CycleField::kRepeats)) repeats = work.Field(CycleField::kRepeats);
  if ((work.centers & 4U) != 0) repeats = work.center_written[2];  // K of a block that names no cycle
  repeats = std::round(repeats);
  if (!(repeats >= 0 && repeats <= session_.machine.passes_max)) {
    session_.Alarm(ir::AlarmClass::kRange, "repetitions of a cycle");
    return false;
  }
  BlockWork place = work;
  place.axes &= static_cast<std::uint16_t>(~AxisBit(axis));
  place.centers = 0;
  place.has &= ~static_cast<std::uint32_t>(BlockWork::kRadius);
  for (int i = 0; i < static_cast<int>(repeats) && !session_.halted; ++i) {
    if (place.axes != 0) {
      std::memcpy(from_, channel_.base, sizeof from_);
      from_known_ = channel_.base_known;
      if (!ResolveTargets(place)) return false;
      Line(place, EventKind::kRapid);
    }
    DrillHole(axis, lathe);
  }
  return repeats > 0;
}

void Kinematics::DrillHole(std::uint8_t axis, bool lathe) {
  if (session_.halted) return;
  const CycleState state = channel_.cycle;
  const ir::Machine& machine = session_.machine;
  if (!state.level_known || !state.depth_known) {
    return session_.Alarm(ir::AlarmClass::kOther, "a cycle without level or depth");
  }
  const ir::ReturnLevel return_level = channel_.modal.return_level;
  if (Unknown(return_level == ir::ReturnLevel::kUnknown, "the return level of cycles")) return;
  const bool initial = return_level == ir::ReturnLevel::kInitial;
  if (initial && !state.initial_known) return session_.Refuse(diag::Code::kUnknownPosition, NameOf(axis));
  const double down = state.depth < state.level ? -1 : 1;
  const ir::SpindleState turning = channel_.spindles[0].state;
  const auto rapid = [&](double target) { GoTo(axis, target, EventKind::kRapid); };
  const auto feed = [&](double target) { GoTo(axis, target, EventKind::kLine); };
  const auto back = [&] { rapid(initial ? state.initial : state.level); };

  rapid(state.level);
  Cycle cycle = state.cycle;
  const bool peck =
      cycle == Cycle::kPeck || cycle == Cycle::kPeckChip || cycle == Cycle::kFacePeck || cycle == Cycle::kCrossPeck;
  if (peck && (!state.step_known || state.step == 0)) {
    if (!lathe) return session_.Alarm(ir::AlarmClass::kOther, "peck drilling without a depth of cut");  // PS0045
    cycle = Cycle::kDrillDwell;  // without Q in one stroke
  }
  if (state.rigid && IsTap(cycle)) {
    RigidTap(axis, cycle == Cycle::kTapLeft);
    return back();
  }
  switch (cycle) {
    case Cycle::kDrill:
      feed(state.depth);
      break;
    case Cycle::kDrillDwell:
      feed(state.depth);
      Pause(state.dwell);
      break;
    case Cycle::kPeck:
    case Cycle::kFacePeck:
    case Cycle::kCrossPeck:
    case Cycle::kPeckChip: {
      const bool full = cycle != Cycle::kPeckChip;
      if (std::fabs(state.depth - state.level) / state.step > 1e6) {
        return session_.Refuse(diag::Code::kCannotRun, "more than a million pecks");
      }
      double reached = state.level;
      for (int turn = 1; !session_.halted; ++turn) {
        double next = state.level + down * state.step * turn;
        const bool last = (next - state.depth) * down >= -1e-9;
        if (last) next = state.depth;
        if (turn > 1 && full) {
          rapid(state.level);
          rapid(reached - down * machine.peck_clearance);
        } else if (turn > 1) {
          rapid(reached - down * machine.chip_back_off);
        }
        feed(next);
        reached = next;
        if (last) break;
      }
      if (lathe) Pause(state.dwell);
      break;
    }
    case Cycle::kTap:
    case Cycle::kTapLeft:
    case Cycle::kFaceTap:
    case Cycle::kCrossTap: {
      if (state.step_known && state.step != 0) return session_.Refuse(diag::Code::kCannotRun, "tapping with pecks");
      const bool left = cycle == Cycle::kTapLeft;
      feed(state.depth);
      Pause(state.dwell);
      Turn(left ? ir::SpindleState::kCw : ir::SpindleState::kCcw);
      feed(state.level);
      Turn(left ? ir::SpindleState::kCcw : ir::SpindleState::kCw);
      break;
    }
    case Cycle::kBoreFeed:
    case Cycle::kFaceBore:
    case Cycle::kCrossBore:
      feed(state.depth);
      if (lathe) Pause(state.dwell);
      feed(state.level);
      break;
    case Cycle::kBoreDwell:
      feed(state.depth);
      Pause(state.dwell);
      feed(state.level);
      break;
    case Cycle::kBoreStop:
      feed(state.depth);
      Turn(ir::SpindleState::kStop);
      back();
      if (turning == ir::SpindleState::kCw || turning == ir::SpindleState::kCcw) Turn(turning);
      return;
    default:
      return session_.Refuse(diag::Code::kCannotRun, "a cycle whose way depends on parameters or on the operator");
  }
  back();
}

// --- single cuts of lathes

/// In, along, out and back to where it began; only a new end coordinate in the next block cuts again (fanuc-8.8).
bool Kinematics::TurningCycle(const BlockWork& work) {
  CycleState& state = channel_.cycle;
  constexpr std::uint8_t kX = 0;
  constexpr std::uint8_t kZ = 2;
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return false;
  constexpr auto kPlane = static_cast<std::uint16_t>(AxisBit(kX) | AxisBit(kZ));
  if ((work.axes & ~kPlane) != 0) {
    session_.Alarm(ir::AlarmClass::kGeometry, "an axis outside the plane in a turning cycle");  // PS0330
    return false;
  }
  if ((work.axes & kPlane) == 0) return false;
  if (!Known(kX, "a turning cycle") || !Known(kZ, "a turning cycle")) return false;
  if (work.centers != 0) {
    session_.Refuse(diag::Code::kCannotRun, "centre words in a cycle");
    return false;
  }
  if (!ResolveTargets(work)) return false;
  for (const std::uint8_t axis : {kX, kZ}) {
    if ((moved_ & AxisBit(axis)) == 0) continue;
    state.end[axis] = target_[axis];
    state.ends_known |= AxisBit(axis);
  }
  if (work.HasField(CycleField::kTaper)) state.taper = work.Field(CycleField::kTaper) * LengthFactor();
  if (work.Has(BlockWork::kRadius)) state.taper = work.radius * LengthFactor();
  if (state.ends_known != kPlane) {
    session_.Alarm(ir::AlarmClass::kOther, "a turning cycle without both end coordinates");
    return false;
  }
  const double start_x = channel_.work[kX];
  const double start_z = channel_.work[kZ];
  const double end_x = state.end[kX];
  const double end_z = state.end[kZ];
  double ends[ir::kMaxAxes] = {};
  ends[kX] = end_x;
  ends[kZ] = end_z;
  if (state.cycle == Cycle::kTurnFace) {
    GoTo(kZ, end_z + state.taper, EventKind::kRapid);
    Go(state.taper != 0 ? kPlane : AxisBit(kX), ends, EventKind::kLine);
    GoTo(kZ, start_z, EventKind::kLine);
    GoTo(kX, start_x, EventKind::kRapid);
    return true;
  }
  const bool thread = state.cycle == Cycle::kTurnThread;
  if (thread && session_.machine.thread_run_out != 0) {
    session_.Refuse(diag::Code::kCannotRun, "a thread with a run-out");
    return false;
  }
  GoTo(kX, end_x + state.taper, EventKind::kRapid);
  if (thread) {
    if (session_.halted) return false;
    BlockWork cut;
    cut.Clear();
    // There Q was read as the size of a peck, in lengths: an angle counts otherwise in inches.
    if (work.HasField(CycleField::kStep)) {
      session_.Refuse(diag::Code::kCannotRun, "Q of a thread in a block without the code of the cycle");
      return false;
    }
    if (work.Has(BlockWork::kStartAngle)) {
      cut.has |= BlockWork::kStartAngle;
      cut.start_angle = work.start_angle;
    }
    std::memcpy(from_, channel_.base, sizeof from_);
    from_known_ = channel_.base_known;
    target_[kX] = end_x;
    target_[kZ] = end_z;
    moved_ = state.taper != 0 ? kPlane : AxisBit(kZ);
    Thread(cut, Motion::kThread);
  } else {
    Go(state.taper != 0 ? kPlane : AxisBit(kZ), ends, EventKind::kLine);
  }
  GoTo(kX, start_x, thread ? EventKind::kRapid : EventKind::kLine);
  GoTo(kZ, start_z, EventKind::kRapid);
  return true;
}

}  // namespace ncport::exec
