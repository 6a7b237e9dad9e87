// Words that change the programmable frame, the pole, or the zero point.
#include <cmath>

#include "exec/kinematics.h"
#include "ir/ops/trigonometry.h"

namespace ncport::exec {

using ir::FrameOp;

/// TRANS ROT SCALE MIRROR replace the whole frame, their A-forms add to it (sinumerik-8.7). Several angles of one block
/// act in a fixed order whatever was written: about Z, then the new Y, then the new X; else Z, X, Z is the order of the
/// machine.
void Kinematics::ApplyFrame(const BlockWork& work) {
  if (work.Has(BlockWork::kFrameEnds)) {
    EndLayers(work);
    if (session_.halted || !work.Has(BlockWork::kFrame)) return;
  }
  if (work.frame >= FrameOp::kLocalShift) return ApplyLayer(work);
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

/// Centre of a layer along one axis: the word, always absolute, or the present position. Seen from inside of the shift.
bool Kinematics::LayerCenter(const BlockWork& work, std::uint8_t axis, double& center) {
  const FrameLayers& layers = channel_.layers;
  if ((work.axes & AxisBit(axis)) == 0) {
    if ((channel_.base_known & ~channel_.uncertain & AxisBit(axis)) == 0) {
      session_.Refuse(diag::Code::kCannotRun,
                      fmt::format("the centre needs the position of {}, which is not known", NameOf(axis)));
      return false;
    }
    center = channel_.base[axis] - layers.shift[axis] - layers.preset[axis];
    return true;
  }
  if (Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return false;
  center = work.axis[axis] * LengthFactor();
  if ((work.scaled_axes & AxisBit(axis)) != 0) center *= Increment(false);
  // The words are coordinates of the program: what acts inside of this layer moves them too.
  if ((layers.mirrored & AxisBit(axis)) != 0) center = 2 * layers.mirror_at[axis] - center;
  if (work.frame == FrameOp::kRotateAbout && layers.scales && axis < 3) {
    center = layers.scale_center[axis] + layers.factor[axis] * (center - layers.scale_center[axis]);
  }
  return true;
}

/// fanuc-8.5: mirrors are switched on before scale and rotation, and off behind them. What another order does is
/// written nowhere, nor what the end of a mirror does that names no axis.
bool Kinematics::MirrorMaySwitch(const BlockWork& work, bool on) {
  const FrameLayers& layers = channel_.layers;
  if (layers.rotates || layers.scales) {
    session_.Refuse(diag::Code::kCannotRun, "a mirror switched while a rotation or scale is on");
  } else if (work.axes == 0 && (on || layers.mirrored != 0)) {
    session_.Refuse(diag::Code::kCannotRun, "a mirror word that names no axis");
  }
  return !session_.halted;
}

/// Layers end in the order of fanuc-8.5, before the words of the block that set one or move.
void Kinematics::EndLayers(const BlockWork& work) {
  FrameLayers& layers = channel_.layers;
  const bool sets = work.Has(BlockWork::kFrame);
  const bool turns = sets && work.frame == FrameOp::kRotateAbout;
  // The manuals tell of no order between two words of one group.
  if ((work.Has(BlockWork::kRotateEnd) && turns) ||
      (work.Has(BlockWork::kScaleEnd) && sets && work.frame == FrameOp::kScaleAbout) ||
      (work.Has(BlockWork::kMirrorEnd) && sets && work.frame == FrameOp::kMirrorAbout))
    return session_.Refuse(diag::Code::kCannotRun, "a frame word beside the word that ends it");
  // A scale acts on the centre of a later rotation (fanuc-8.5): whether this one is later is not said.
  if (work.Has(BlockWork::kScaleEnd) && layers.scales && turns)
    return session_.Refuse(diag::Code::kCannotRun, "a rotation beside the end of a scale");
  if (work.Has(BlockWork::kRotateEnd)) layers.rotates = false;
  if (work.Has(BlockWork::kScaleEnd)) layers.scales = false;
  if (work.Has(BlockWork::kMirrorEnd)) {
    constexpr std::uint32_t kMoves = BlockWork::kMotionWord | BlockWork::kOneShotMotion | BlockWork::kReference |
                                     BlockWork::kMachineCoords | BlockWork::kPreset | BlockWork::kPole |
                                     BlockWork::kCycleWord;
    // Which axis words name axes of the mirror and which are the other word's is written nowhere.
    if (work.axes != 0 && (sets || work.centers != 0 || work.cycle_fields != 0 || work.Has(kMoves)))
      return session_.Refuse(diag::Code::kCannotRun, "the end of a mirror beside another word that takes axis words");
    if (!MirrorMaySwitch(work, false)) return;
    layers.mirrored &= static_cast<std::uint16_t>(~work.axes);
  }
  MakeFrame();
  if (!sets || work.frame < FrameOp::kLocalShift) FrameChanged();  // else once, with the new layer
}

/// Shift, rotation, scale and mirror as layers: each word replaces its own one, the order between them is fixed
/// (fanuc-8.4 to 8.6).
void Kinematics::ApplyLayer(const BlockWork& work) {
  FrameLayers& layers = channel_.layers;
  const ir::Machine& machine = session_.machine;
  if (work.frame == FrameOp::kMirrorAbout && !MirrorMaySwitch(work, true)) return;
  switch (work.frame) {
    case FrameOp::kLocalShift:
      for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
        if ((work.axes & AxisBit(axis)) == 0) continue;
        const bool rotary = ir::IsRotary(axis);
        if (!rotary && Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
        // Not rounded: beside the rounding of the words behind it, a shift would have the error of two words.
        double value = work.axis[axis] * (rotary ? 1 : LengthFactor());
        if ((work.scaled_axes & AxisBit(axis)) != 0) value *= Increment(rotary);
        if (axis == machine.transverse_axis && machine.frame_shift_in_diameter &&
            TransverseInDiameter(ir::ValueMode::kAbsolute, false))
          value /= 2;
        layers.shift[axis] = value;
      }
      break;
    case FrameOp::kRotateAbout: {
      if (Unknown(channel_.modal.plane == ir::Plane::kUnknown, "the plane")) return;
      const PlaneAxes axes = AxesOf(channel_.modal.plane);
      double center[2] = {};
      if (!LayerCenter(work, axes.first, center[0]) || !LayerCenter(work, axes.second, center[1])) return;
      double angle = work.Has(BlockWork::kFrameAngle) ? work.frame_angle : machine.rotation_default_angle;
      const bool adds = machine.rotation_angle_by_distance && channel_.modal.distance == ir::Distance::kIncremental;
      const auto plane = static_cast<std::uint16_t>(AxisBit(axes.first) | AxisBit(axes.second));
      const std::uint16_t mirrors = layers.mirrored & plane;
      if (mirrors != 0 && mirrors != plane) angle = -angle;  // one mirrored axis exchanges the sense
      if (adds && layers.rotates) angle += layers.angle;
      layers.rotates = true;
      layers.rotation_axis = axes.normal;
      layers.rotation_center[axes.first] = center[0];
      layers.rotation_center[axes.second] = center[1];
      layers.rotation_center[axes.normal] = 0;
      layers.angle = angle;
      break;
    }
    case FrameOp::kScaleAbout:
      for (std::uint8_t axis = 0; axis < 3; ++axis) {
        double factor = (work.factors & 1U) != 0 ? work.factor[0] : 1;
        if ((work.factors >> (axis + 1U) & 1U) != 0) factor = work.factor[axis + 1];
        if (factor == 0 || std::fabs(factor) >= 10000) return session_.Alarm(ir::AlarmClass::kRange, "scale factor");
        layers.factor[axis] = factor;
        // An axis that keeps its size needs no centre.
        layers.scale_center[axis] = 0;
        if (factor != 1 && (machine.axes & AxisBit(axis)) != 0 && !LayerCenter(work, axis, layers.scale_center[axis]))
          return;
      }
      layers.scales = true;
      break;
    case FrameOp::kMirrorAbout:
      for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
        if ((work.axes & AxisBit(axis)) == 0) continue;
        layers.mirrored &= static_cast<std::uint16_t>(~AxisBit(axis));
        double at = 0;
        if (!LayerCenter(work, axis, at)) return;
        layers.mirrored |= AxisBit(axis);
        layers.mirror_at[axis] = at;
      }
      break;
    default:
      break;
  }
  MakeFrame();
  FrameChanged();
}

void Kinematics::MakeFrame() {
  const FrameLayers& layers = channel_.layers;
  Frame& frame = channel_.frame;
  frame.Reset();
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    const double shift = layers.shift[axis] + layers.preset[axis];
    if (shift != 0) frame.AddShift(axis, shift);
  }
  if (layers.rotates) {
    for (std::uint8_t axis = 0; axis < 3; ++axis) frame.AddShift(axis, layers.rotation_center[axis]);
    frame.AddRotation(layers.rotation_axis, layers.angle);
    for (std::uint8_t axis = 0; axis < 3; ++axis) frame.AddShift(axis, -layers.rotation_center[axis]);
  }
  if (layers.scales) {
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      frame.AddShift(axis, layers.scale_center[axis]);
      frame.AddScale(axis, layers.factor[axis]);
      frame.AddShift(axis, -layers.scale_center[axis]);
    }
  }
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((layers.mirrored & AxisBit(axis)) == 0) continue;
    frame.AddShift(axis, layers.mirror_at[axis]);
    frame.AddMirror(axis);
    frame.AddShift(axis, -layers.mirror_at[axis]);
  }
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
  if (!channel_.frame.IsDiagonal() || channel_.layers.scales || channel_.layers.mirrored != 0) {
    return session_.Refuse(diag::Code::kCannotRun, "new axis values under a rotation, scale or mirror");
  }
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    const std::uint16_t bit = AxisBit(axis);
    if ((work.axes & bit) == 0) continue;
    const bool rotary = ir::IsRotary(axis);
    if (!rotary && Unknown(channel_.modal.units == ir::Units::kUnknown, "the unit of lengths")) return;
    double value = WordOf(work, axis, rotary) * (rotary ? 1 : LengthFactor());
    const bool shifts = work.axis_mode[axis] == ir::ValueMode::kIncremental;  // U W: by an amount (fanuc-8.4)
    if (axis == session_.machine.transverse_axis && TransverseInDiameter(ir::ValueMode::kAbsolute, shifts)) value /= 2;
    if (shifts) {
      if (!Known(axis, "increment")) return;
      value += channel_.work[axis];
    }
    if ((channel_.base_known & bit) == 0) {
      channel_.base[axis] = channel_.frame.Factor(axis) * value + channel_.frame.Shift(axis);
      channel_.base_known |= bit;
    }
    channel_.frame.Preset(axis, value, channel_.base[axis]);
    channel_.layers.preset[axis] = channel_.frame.Shift(axis) - channel_.layers.shift[axis];
  }
  FrameChanged();
}

}  // namespace ncport::exec
