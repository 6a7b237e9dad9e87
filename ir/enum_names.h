// Names of the small closed lists of the IR, as dumps write and read them. A new enumerator without a name breaks the
// build here. A value outside its list has the empty name.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ir/modes.h"
#include "ir/nodes.h"

namespace ncport::ir {

constexpr std::string_view NameOf(Phase value) {
  switch (value) {
    case Phase::kImmediate:
      return "immediate";
    case Phase::kSetting:
      return "setting";
    case Phase::kBefore:
      return "before";
    case Phase::kMotion:
      return "motion";
    case Phase::kAfter:
      return "after";
    case Phase::kFlow:
      return "flow";
    case Phase::kLast:
      return "last";
  }
  return {};
}
constexpr std::string_view NameOf(ValueMode value) {
  switch (value) {
    case ValueMode::kModal:
      return "modal";
    case ValueMode::kAbsolute:
      return "absolute";
    case ValueMode::kIncremental:
      return "incremental";
    case ValueMode::kShortest:
      return "shortest";
    case ValueMode::kPositive:
      return "positive";
    case ValueMode::kNegative:
      return "negative";
    case ValueMode::kAbsoluteDiameter:
      return "absolute-diameter";
    case ValueMode::kIncrementalDiameter:
      return "incremental-diameter";
    case ValueMode::kAbsoluteRadius:
      return "absolute-radius";
    case ValueMode::kIncrementalRadius:
      return "incremental-radius";
    case ValueMode::kQuick:
      return "quick";
    case ValueMode::kStep:
      return "step";
  }
  return {};
}
constexpr std::string_view NameOf(ChamferKind value) {
  switch (value) {
    case ChamferKind::kLength:
      return "length";
    case ChamferKind::kLeg:
      return "leg";
    case ChamferKind::kRound:
      return "round";
    case ChamferKind::kRoundModal:
      return "round-modal";
  }
  return {};
}
constexpr std::string_view NameOf(ReferenceKind value) {
  switch (value) {
    case ReferenceKind::kReference:
      return "reference";
    case ReferenceKind::kSecondReference:
      return "second-reference";
    case ReferenceKind::kFixedPoint:
      return "fixed-point";
    case ReferenceKind::kFromReference:
      return "from-reference";
  }
  return {};
}
constexpr std::string_view NameOf(PoleBase value) {
  switch (value) {
    case PoleBase::kLastPosition:
      return "last-position";
    case PoleBase::kWorkpieceZero:
      return "workpiece-zero";
    case PoleBase::kLastPole:
      return "last-pole";
  }
  return {};
}
constexpr std::string_view NameOf(FrameOp value) {
  switch (value) {
    case FrameOp::kTranslate:
      return "translate";
    case FrameOp::kRotate:
      return "rotate";
    case FrameOp::kScale:
      return "scale";
    case FrameOp::kMirror:
      return "mirror";
    case FrameOp::kAddTranslate:
      return "add-translate";
    case FrameOp::kAddRotate:
      return "add-rotate";
    case FrameOp::kAddScale:
      return "add-scale";
    case FrameOp::kAddMirror:
      return "add-mirror";
    case FrameOp::kLocalShift:
      return "local-shift";
    case FrameOp::kRotateAbout:
      return "rotate-about";
    case FrameOp::kRotateEnd:
      return "rotate-end";
    case FrameOp::kScaleAbout:
      return "scale-about";
    case FrameOp::kScaleEnd:
      return "scale-end";
    case FrameOp::kMirrorAbout:
      return "mirror-about";
    case FrameOp::kMirrorEnd:
      return "mirror-end";
    case FrameOp::kReset:
      return "reset";
  }
  return {};
}
constexpr std::string_view NameOf(AlarmKind value) {
  switch (value) {
    case AlarmKind::kStops:
      return "stops";
    case AlarmKind::kShows:
      return "shows";
    case AlarmKind::kByNumber:
      return "by-number";
  }
  return {};
}
constexpr std::string_view NameOf(ReturnKind value) {
  switch (value) {
    case ReturnKind::kAuxiliary:
      return "auxiliary";
    case ReturnKind::kPlain:
      return "plain";
    case ReturnKind::kToCaller:
      return "to-caller";
  }
  return {};
}
constexpr std::string_view NameOf(CommentPlace value) {
  switch (value) {
    case CommentPlace::kOwnLine:
      return "own-line";
    case CommentPlace::kBeforeWord:
      return "before-word";
    case CommentPlace::kEndOfBlock:
      return "end-of-block";
  }
  return {};
}
constexpr std::string_view NameOf(Scope value) {
  switch (value) {
    case Scope::kLocal:
      return "local";
    case Scope::kParameter:
      return "parameter";
    case Scope::kProgram:
      return "program";
    case Scope::kChannel:
      return "channel";
    case Scope::kGlobal:
      return "global";
  }
  return {};
}
constexpr std::string_view NameOf(Lifetime value) {
  switch (value) {
    case Lifetime::kCall:
      return "call";
    case Lifetime::kProgram:
      return "program";
    case Lifetime::kKept:
      return "kept";
  }
  return {};
}
constexpr std::string_view NameOf(Visibility value) {
  switch (value) {
    case Visibility::kLevel:
      return "level";
    case Visibility::kProgram:
      return "program";
    case Visibility::kAll:
      return "all";
  }
  return {};
}
constexpr std::string_view NameOf(StartValue value) {
  switch (value) {
    case StartValue::kZero:
      return "zero";
    case StartValue::kVacant:
      return "vacant";
    case StartValue::kKept:
      return "kept";
    case StartValue::kUnknown:
      return "unknown";
  }
  return {};
}
constexpr std::string_view NameOf(SystemKind value) {
  switch (value) {
    case SystemKind::kEnvironment:
      return "environment";
    case SystemKind::kPi:
      return "pi";
    case SystemKind::kProgrammedPosition:
      return "programmed-position";
    case SystemKind::kMachinePosition:
      return "machine-position";
    case SystemKind::kActiveFeed:
      return "active-feed";
    case SystemKind::kActiveSpeed:
      return "active-speed";
    case SystemKind::kActiveTool:
      return "active-tool";
    case SystemKind::kProgrammedTool:
      return "programmed-tool";
    case SystemKind::kActiveEdge:
      return "active-edge";
    case SystemKind::kModalGroup:
      return "modal-group";
    case SystemKind::kModalCallActive:
      return "modal-call-active";
    case SystemKind::kPlaneAxis:
      return "plane-axis";
    case SystemKind::kWasProgrammed:
      return "was-programmed";
    case SystemKind::kProgramLevel:
      return "program-level";
    case SystemKind::kUserMemory:
      return "user-memory";
  }
  return {};
}
constexpr std::string_view NameOf(Search value) {
  switch (value) {
    case Search::kForward:
      return "forward";
    case Search::kBackward:
      return "backward";
    case Search::kForwardThenBackward:
      return "forward-then-backward";
    case Search::kForwardThenFromStart:
      return "forward-then-from-start";
    case Search::kBackwardThenForward:
      return "backward-then-forward";
  }
  return {};
}
constexpr std::string_view NameOf(TargetKind value) {
  switch (value) {
    case TargetKind::kLabel:
      return "label";
    case TargetKind::kNumber:
      return "number";
    case TargetKind::kMainNumber:
      return "main-number";
    case TargetKind::kExpression:
      return "expression";
    case TargetKind::kProgramStart:
      return "program-start";
  }
  return {};
}
constexpr std::string_view NameOf(CallForm value) {
  switch (value) {
    case CallForm::kName:
      return "name";
    case CallForm::kText:
      return "text";
    case CallForm::kBlockRange:
      return "block-range";
    case CallForm::kPath:
      return "path";
    case CallForm::kExternal:
      return "external";
  }
  return {};
}
constexpr std::string_view NameOf(ProgramKind value) {
  switch (value) {
    case ProgramKind::kMain:
      return "main";
    case ProgramKind::kSub:
      return "sub";
  }
  return {};
}
constexpr std::string_view NameOf(Motion value) {
  switch (value) {
    case Motion::kUnknown:
      return "unknown";
    case Motion::kNone:
      return "none";
    case Motion::kRapid:
      return "rapid";
    case Motion::kLinear:
      return "linear";
    case Motion::kArcCw:
      return "arc-cw";
    case Motion::kArcCcw:
      return "arc-ccw";
    case Motion::kArcVia:
      return "arc-via";
    case Motion::kArcTangent:
      return "arc-tangent";
    case Motion::kThread:
      return "thread";
    case Motion::kThreadIncreasing:
      return "thread-increasing";
    case Motion::kThreadDecreasing:
      return "thread-decreasing";
    case Motion::kTapIn:
      return "tap-in";
    case Motion::kTapOut:
      return "tap-out";
    case Motion::kTapFloating:
      return "tap-floating";
    case Motion::kProbe:
      return "probe";
  }
  return {};
}
constexpr std::string_view NameOf(Plane value) {
  switch (value) {
    case Plane::kUnknown:
      return "unknown";
    case Plane::kXY:
      return "xy";
    case Plane::kZX:
      return "zx";
    case Plane::kYZ:
      return "yz";
  }
  return {};
}
constexpr std::string_view NameOf(Distance value) {
  switch (value) {
    case Distance::kUnknown:
      return "unknown";
    case Distance::kAbsolute:
      return "absolute";
    case Distance::kIncremental:
      return "incremental";
  }
  return {};
}
constexpr std::string_view NameOf(Units value) {
  switch (value) {
    case Units::kUnknown:
      return "unknown";
    case Units::kMm:
      return "mm";
    case Units::kInch:
      return "inch";
    case Units::kMmGeometry:
      return "mm-geometry";
    case Units::kInchGeometry:
      return "inch-geometry";
  }
  return {};
}
constexpr std::string_view NameOf(FeedMode value) {
  switch (value) {
    case FeedMode::kUnknown:
      return "unknown";
    case FeedMode::kPerMinute:
      return "per-minute";
    case FeedMode::kPerRevolution:
      return "per-revolution";
    case FeedMode::kInverseTime:
      return "inverse-time";
  }
  return {};
}
constexpr std::string_view NameOf(SpeedMode value) {
  switch (value) {
    case SpeedMode::kUnknown:
      return "unknown";
    case SpeedMode::kRpm:
      return "rpm";
    case SpeedMode::kConstantSurface:
      return "constant-surface";
  }
  return {};
}
constexpr std::string_view NameOf(CutterComp value) {
  switch (value) {
    case CutterComp::kUnknown:
      return "unknown";
    case CutterComp::kOff:
      return "off";
    case CutterComp::kLeft:
      return "left";
    case CutterComp::kRight:
      return "right";
  }
  return {};
}
constexpr std::string_view NameOf(Diameter value) {
  switch (value) {
    case Diameter::kUnknown:
      return "unknown";
    case Diameter::kRadius:
      return "radius";
    case Diameter::kDiameter:
      return "diameter";
    case Diameter::kDiameterAbsolute:
      return "diameter-absolute";
  }
  return {};
}
constexpr std::string_view NameOf(PathMode value) {
  switch (value) {
    case PathMode::kUnknown:
      return "unknown";
    case PathMode::kExact:
      return "exact";
    case PathMode::kContinuous:
      return "continuous";
  }
  return {};
}
constexpr std::string_view NameOf(ReturnLevel value) {
  switch (value) {
    case ReturnLevel::kUnknown:
      return "unknown";
    case ReturnLevel::kInitial:
      return "initial";
    case ReturnLevel::kRPlane:
      return "r-plane";
  }
  return {};
}
constexpr std::string_view NameOf(Cycle value) {
  switch (value) {
    case Cycle::kUnknown:
      return "unknown";
    case Cycle::kNone:
      return "none";
    case Cycle::kDrill:
      return "drill";
    case Cycle::kDrillDwell:
      return "drill-dwell";
    case Cycle::kPeck:
      return "peck";
    case Cycle::kPeckChip:
      return "peck-chip";
    case Cycle::kTap:
      return "tap";
    case Cycle::kTapLeft:
      return "tap-left";
    case Cycle::kRigidTap:
      return "rigid-tap";
    case Cycle::kRigidTapLeft:
      return "rigid-tap-left";
    case Cycle::kBoreFeed:
      return "bore-feed";
    case Cycle::kBoreStop:
      return "bore-stop";
    case Cycle::kBoreDwell:
      return "bore-dwell";
    case Cycle::kFineBore:
      return "fine-bore";
    case Cycle::kBackBore:
      return "back-bore";
    case Cycle::kBoreManual:
      return "bore-manual";
    case Cycle::kFacePeck:
      return "face-peck";
    case Cycle::kFaceTap:
      return "face-tap";
    case Cycle::kFaceRigidTap:
      return "face-rigid-tap";
    case Cycle::kFaceBore:
      return "face-bore";
    case Cycle::kCrossPeck:
      return "cross-peck";
    case Cycle::kCrossTap:
      return "cross-tap";
    case Cycle::kCrossRigidTap:
      return "cross-rigid-tap";
    case Cycle::kCrossBore:
      return "cross-bore";
    case Cycle::kTurn:
      return "turn";
    case Cycle::kTurnThread:
      return "turn-thread";
    case Cycle::kTurnFace:
      return "turn-face";
    case Cycle::kFinish:
      return "finish";
    case Cycle::kRoughTurn:
      return "rough-turn";
    case Cycle::kRoughFace:
      return "rough-face";
    case Cycle::kPattern:
      return "pattern";
    case Cycle::kFaceGroove:
      return "face-groove";
    case Cycle::kGroove:
      return "groove";
    case Cycle::kMultiThread:
      return "multi-thread";
  }
  return {};
}
constexpr std::string_view NameOf(CycleField value) {
  switch (value) {
    case CycleField::kLevel:
      return "level";
    case CycleField::kStep:
      return "step";
    case CycleField::kDwell:
      return "dwell";
    case CycleField::kRepeats:
      return "repeats";
    case CycleField::kShiftX:
      return "shift-x";
    case CycleField::kShiftY:
      return "shift-y";
    case CycleField::kShiftZ:
      return "shift-z";
    case CycleField::kTaper:
      return "taper";
    case CycleField::kFirstBlock:
      return "first-block";
    case CycleField::kLastBlock:
      return "last-block";
    case CycleField::kDepth:
      return "depth";
    case CycleField::kRetract:
      return "retract";
    case CycleField::kAllowanceX:
      return "allowance-x";
    case CycleField::kAllowanceZ:
      return "allowance-z";
    case CycleField::kReliefX:
      return "relief-x";
    case CycleField::kReliefZ:
      return "relief-z";
    case CycleField::kPasses:
      return "passes";
    case CycleField::kStepX:
      return "step-x";
    case CycleField::kStepZ:
      return "step-z";
    case CycleField::kHeight:
      return "height";
    case CycleField::kFirstDepth:
      return "first-depth";
    case CycleField::kLeastDepth:
      return "least-depth";
    case CycleField::kFinishDepth:
      return "finish-depth";
    case CycleField::kForm:
      return "form";
    case CycleField::kMethod:
      return "method";
    case CycleField::kAngle:
      return "angle";
  }
  return {};
}
constexpr std::string_view NameOf(SpindleState value) {
  switch (value) {
    case SpindleState::kUnknown:
      return "unknown";
    case SpindleState::kStop:
      return "stop";
    case SpindleState::kCw:
      return "cw";
    case SpindleState::kCcw:
      return "ccw";
    case SpindleState::kPositioned:
      return "positioned";
  }
  return {};
}

template <class Enum>
constexpr bool IsKnown(Enum value) {
  return !NameOf(value).empty();
}

/// The value with this name, if there is one. For lists that count from 0 without holes.
template <class Enum>
constexpr std::optional<Enum> FromName(std::string_view name) {
  for (unsigned index = 0; index < 256; ++index) {
    const Enum value = static_cast<Enum>(index);
    const std::string_view candidate = NameOf(value);
    if (candidate.empty()) break;
    if (candidate == name) return value;
  }
  return std::nullopt;
}

}  // namespace ncport::ir
