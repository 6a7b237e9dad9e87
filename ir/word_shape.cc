#include "ir/word_shape.h"

namespace ncport::ir {

WordShape ShapeOf(WordOp op) {
  switch (op) {
    case WordOp::kMotion:
      return {IndexKind::kMotion};
    case WordOp::kPlane:
      return {IndexKind::kPlane};
    case WordOp::kDistance:
      return {IndexKind::kDistance};
    case WordOp::kUnits:
      return {IndexKind::kUnits};
    case WordOp::kFeedMode:
      return {IndexKind::kFeedMode};
    case WordOp::kSpeedMode:
      return {IndexKind::kSpeedMode};
    case WordOp::kCutterComp:
      return {IndexKind::kCutterComp};
    case WordOp::kDiameter:
      return {IndexKind::kDiameter};
    case WordOp::kPathMode:
      return {IndexKind::kPathMode};
    case WordOp::kReturnLevel:
      return {IndexKind::kReturnLevel};
    case WordOp::kWorkOffset:
      return {IndexKind::kNone, ExtraKind::kNumber};
    // Rows of a table may tell words without effect apart by a number.
    case WordOp::kInert:
    case WordOp::kAux:
      return {IndexKind::kNumber, ExtraKind::kNumber, true};
    case WordOp::kAxis:
      return {IndexKind::kAxis};
    case WordOp::kAxisComputed:
      return {IndexKind::kNone, ExtraKind::kExpr};
    case WordOp::kCenter:
    case WordOp::kVia:
      return {IndexKind::kCoordinate};
    case WordOp::kChamfer:
      return {IndexKind::kChamfer};
    case WordOp::kReference:
      return {IndexKind::kReference};
    case WordOp::kPole:
      return {IndexKind::kPole};
    case WordOp::kFrame:
      return {IndexKind::kFrame};
    case WordOp::kCycle:
      return {IndexKind::kCycle, ExtraKind::kNumber, true};
    case WordOp::kCycleValue:
      return {IndexKind::kCycleField};
    case WordOp::kDataSetting:
      return {IndexKind::kNone, ExtraKind::kCall};
    case WordOp::kSpindle:
      return {IndexKind::kNumber, ExtraKind::kSpindleState};
    case WordOp::kAlarm:
      return {IndexKind::kAlarm, ExtraKind::kExpr, true};
    case WordOp::kMessage:
      return {IndexKind::kNone, ExtraKind::kExpr, true};
    case WordOp::kReturn:
      return {IndexKind::kReturn};
    case WordOp::kProgramEnd:
      return {IndexKind::kNone, ExtraKind::kNumber, true};
    case WordOp::kWorkpiece:
      return {IndexKind::kNone, ExtraKind::kCall, true};
    case WordOp::kAssign:
      return {IndexKind::kNone, ExtraKind::kExpr};
    case WordOp::kAssignList:
      return {IndexKind::kNone, ExtraKind::kAssignList};
    case WordOp::kDefine:
      return {IndexKind::kNone, ExtraKind::kVariable};
    case WordOp::kHeader:
      return {IndexKind::kNone, ExtraKind::kProgram};
    case WordOp::kExtern:
      return {IndexKind::kNone, ExtraKind::kExtern};
    case WordOp::kJump:
      return {IndexKind::kNone, ExtraKind::kJump};
    case WordOp::kSwitch:
      return {IndexKind::kNone, ExtraKind::kSwitch};
    case WordOp::kCall:
      return {IndexKind::kNone, ExtraKind::kCall};
    case WordOp::kModalCall:
      return {IndexKind::kNone, ExtraKind::kCall, true};
    case WordOp::kRepeatPart:
      return {IndexKind::kNone, ExtraKind::kPart};
    case WordOp::kFor:
      return {IndexKind::kNone, ExtraKind::kFor};
    case WordOp::kVerbatim:
      return {IndexKind::kMark, ExtraKind::kString};

    case WordOp::kPolarMode:
    case WordOp::kFrameFactor:
    case WordOp::kComputedM:
    case WordOp::kSpeed:
    case WordOp::kSpeedLimit:
    case WordOp::kSpindlePosition:
    case WordOp::kTool:
    case WordOp::kToolChange:
    case WordOp::kLengthOffset:
    case WordOp::kAuxH:
    case WordOp::kDwellRevolutions:
    case WordOp::kSkipRest:
    case WordOp::kWhile:
    case WordOp::kEndWhile:
    case WordOp::kLoop:
    case WordOp::kEndLoop:
      return {IndexKind::kNumber};

    case WordOp::kExactOnce:
    case WordOp::kMachineCoords:
    case WordOp::kComputedG:
    case WordOp::kRadius:
    case WordOp::kOpeningAngle:
    case WordOp::kTurns:
    case WordOp::kPolarRadius:
    case WordOp::kPolarAngle:
    case WordOp::kContourAngle:
    case WordOp::kStartAngle:
    case WordOp::kFeed:
    case WordOp::kFeedOnce:
    case WordOp::kEdge:
    case WordOp::kToolOffset:
    case WordOp::kRadiusOffset:
    case WordOp::kDwellSeconds:
    case WordOp::kFrameAngle:
    case WordOp::kPresetPosition:
    case WordOp::kStop:
    case WordOp::kOptionalStop:
    case WordOp::kPrint:
    case WordOp::kPreprocessStop:
    case WordOp::kFileMark:
    case WordOp::kWhen:
    case WordOp::kRestart:
    case WordOp::kIf:
    case WordOp::kElse:
    case WordOp::kEndIf:
    case WordOp::kRepeat:
    case WordOp::kUntil:
    case WordOp::kEndFor:
      break;
  }
  return {};
}

}  // namespace ncport::ir
