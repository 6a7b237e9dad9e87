// Words that change the programmable frame, the pole, or the zero point.
#include "exec/kinematics.h"
#include "ir/ops/trigonometry.h"

namespace ncport::exec {

using ir::FrameOp;

/// TRANS ROT SCALE MIRROR replace the whole frame, their A-forms add to it (sinumerik-8.7). Several angles of one block
/// act in a fixed order whatever was written: about Z, then the new Y, then the new X; else Z, X, Z is the order of the
/// machine.
void Kinematics::ApplyFrame(const BlockWork& work) {
  Frame& frame = channel_.frame;
  const bool additive = work.frame >= FrameOp::kAddTranslate && work.frame <= FrameOp::kAddMirror;
  if (!additive) frame.Reset();
  const bool has = work.axes != 0 || work.Has(BlockWork::kFrameAngle);
  if (!has) {
    if (!additive) FrameChanged();
    return;  // an additive word alone adds nothing
  }
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((work.axes & AxisBit(axis)) == 0) continue;
    double value = work.axis[axis];
    switch (work.frame) {
      case FrameOp::kTranslate:
      case FrameOp::kAddTranslate:
        if (!ir::IsRotary(axis)) {
          if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
          value *= LengthFactor();
        }
        if (axis == session_.machine.transverse_axis && session_.machine.frame_shift_in_diameter &&
            TransverseInDiameter(ir::ValueMode::kAbsolute, false)) {
          value /= 2;
        }
        frame.AddShift(axis, value);
        break;
      case FrameOp::kScale:
      case FrameOp::kAddScale:
        if (value == 0) return session_.Alarm(ir::AlarmClass::kRange, "scale factor 0");
        frame.AddScale(axis, value);
        break;
      case FrameOp::kMirror:
      case FrameOp::kAddMirror:
        frame.AddMirror(axis);
        break;
      default:
        break;
    }
  }
  if (work.frame == FrameOp::kRotate || work.frame == FrameOp::kAddRotate) {
    if ((work.axes & ~7U) != 0)
      return session_.Refuse(diag::Code::kCannotRun, "a rotation about an axis that is not X, Y or Z");
    const auto angle = [&](std::uint8_t axis) { return (work.axes & AxisBit(axis)) != 0 ? work.axis[axis] : 0.0; };
    const int count = (angle(0) != 0 ? 1 : 0) + (angle(1) != 0 ? 1 : 0) + (angle(2) != 0 ? 1 : 0);
    if (!session_.machine.rotation_order_rpy && count > 1) {
      // Z, X', Z'' has two angles about Z, and a block names it once.
      return session_.Refuse(diag::Code::kCannotRun, "several angles in one rotation in the order Z, X, Z");
    }
    if (angle(2) != 0) frame.AddRotation(2, angle(2));
    if (angle(1) != 0) frame.AddRotation(1, angle(1));
    if (angle(0) != 0) frame.AddRotation(0, angle(0));
    if (work.Has(BlockWork::kFrameAngle)) {
      if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return;
      frame.AddRotation(AxesOf(channel_.modal.plane).normal, work.frame_angle);
    }
  }
  FrameChanged();
}

/// No axis moves when the frame changes: the same point gets new workpiece coordinates.
void Kinematics::FrameChanged() {
  if (!channel_.frame.Invertible()) return session_.Alarm(ir::AlarmClass::kRange, "scale factor 0");
  channel_.work_known = channel_.frame.ToWork(channel_.base, channel_.base_known, channel_.work);
  ShowComp();
}

/// G110 from the last position, G111 from the workpiece zero, G112 from the last pole (sinumerik-8.6). The distance
/// mode does not change the coordinates of a pole.
void Kinematics::SetPole(const BlockWork& work) {
  if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return;
  const PlaneAxes axes = AxesOf(channel_.modal.plane);
  Point base;
  if (work.pole == ir::PoleBase::kLastPole) base = channel_.last_pole;
  if (work.pole == ir::PoleBase::kLastPosition) {
    if (!Known(axes.first, "pole") || !Known(axes.second, "pole")) return;
    base = {channel_.work[axes.first], channel_.work[axes.second]};
  }
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
  const double factor = LengthFactor();
  if (work.Has(BlockWork::kPolarRadius) || work.Has(BlockWork::kPolarAngle)) {
    const double angle = work.Has(BlockWork::kPolarAngle) ? work.polar_angle : 0;
    const double radius = work.Has(BlockWork::kPolarRadius) ? work.polar_radius * factor : 0;
    base.u += radius * ir::ops::Cos(angle);
    base.v += radius * ir::ops::Sin(angle);
  } else {
    const std::uint8_t transverse = session_.machine.transverse_axis;
    if (transverse < ir::kMaxAxes && (work.axes & AxisBit(transverse)) != 0 &&
        TransverseInDiameter(ir::ValueMode::kAbsolute, false)) {
      return session_.Refuse(diag::Code::kCannotRun, "a pole in an axis that is programmed as diameter");
    }
    const auto coordinate = [&](std::uint8_t axis) {
      return (work.axes & AxisBit(axis)) != 0 ? work.axis[axis] * factor : 0.0;
    };
    base.u += coordinate(axes.first);
    base.v += coordinate(axes.second);
  }
  channel_.pole = base;
  channel_.last_pole = base;
  channel_.polar_angle_known = false;  // the angle is kept until a new pole, the radius until a new value
}

/// The present position gets new values: the zero point moves. Where the position is unknown the values are taken as
/// they are.
void Kinematics::Preset(const BlockWork& work) {
  if (!channel_.frame.IsDiagonal()) return session_.Refuse(diag::Code::kCannotRun, "new axis values under a rotation");
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    const std::uint16_t bit = AxisBit(axis);
    if ((work.axes & bit) == 0) continue;
    double value = work.axis[axis];
    if (!ir::IsRotary(axis)) {
      if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
      value *= LengthFactor();
    }
    if (axis == session_.machine.transverse_axis && TransverseInDiameter(ir::ValueMode::kAbsolute, false)) value /= 2;
    if ((channel_.base_known & bit) == 0) {
      channel_.base[axis] = channel_.frame.Factor(axis) * value + channel_.frame.Shift(axis);
      channel_.base_known |= bit;
    }
    channel_.frame.Preset(axis, value, channel_.base[axis]);
  }
  FrameChanged();
}

}  // namespace ncport::exec
