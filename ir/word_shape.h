// What Word::index and Word::extra of each word mean, as one table for dump, parser of dumps and verifier.
#pragma once

#include <cstdint>

#include "ir/nodes.h"

namespace ncport::ir {

enum class IndexKind : std::uint8_t {
  kNone,  // always 0
  kMotion,
  kPlane,
  kDistance,
  kUnits,
  kFeedMode,
  kSpeedMode,
  kCutterComp,
  kDiameter,
  kPathMode,
  kReturnLevel,
  kAxis,        // 0 to kMaxAxes - 1
  kCoordinate,  // I J K: 0 to 2
  kChamfer,
  kReference,
  kPole,
  kFrame,
  kAlarm,
  kReturn,
  kCycle,
  kCycleField,
  kMark,    // WordOp of a structure mark; 0 = none
  kNumber,  // spindle, extension, skip level, DO number; 0 = none
};

enum class ExtraKind : std::uint8_t {
  kNone,  // always Id::kNone
  kNumber,
  kSpindleState,
  kExpr,
  kVariable,
  kProgram,
  kExtern,
  kAssignList,
  kJump,
  kSwitch,
  kCall,
  kPart,
  kFor,
  kString,
};

struct WordShape {
  IndexKind index = IndexKind::kNone;
  ExtraKind extra = ExtraKind::kNone;
  bool extra_may_be_missing = false;
};

WordShape ShapeOf(WordOp op);

/// True if dumps write Word::mode behind the index; the extra of other words starts with a name that could be a mode's.
inline bool HasInlineMode(WordOp op) {
  const ExtraKind extra = ShapeOf(op).extra;
  return extra == ExtraKind::kNone || extra == ExtraKind::kExpr;
}

}  // namespace ncport::ir
