// The modal groups of a machine tool by meaning, and the axes. Nothing here names a control.
#pragma once

#include <array>
#include <cstdint>

namespace ncport::ir {

/// Axis letters in the order in which traces write them. Axes with other names (X1, SP3 ...) follow
/// from kFirstNamedAxis on; their names are in Module::axes.
enum class Axis : std::uint8_t { kX, kY, kZ, kA, kB, kC, kU, kV, kW };
inline constexpr std::uint8_t kLetterAxes = 9;
inline constexpr std::uint8_t kFirstNamedAxis = 9;
inline constexpr std::uint8_t kMaxAxes = 16;

constexpr bool IsRotary(std::uint8_t axis) { return axis >= 3 && axis <= 5; }

/// How the tool gets to the end point of a block (G group 1).
enum class Motion : std::uint8_t {
  kUnknown,
  kNone,              // no motion mode in force (G80 without another word)
  kRapid,             // G0
  kLinear,            // G1
  kArcCw,             // G2
  kArcCcw,            // G3
  kArcVia,            // circle through an intermediate point, any orientation (CIP)
  kArcTangent,        // circle tangential to the path before (CT)
  kThread,            // constant lead (G33, lathe G32)
  kThreadIncreasing,  // lead grows by F mm/rev per revolution (G34)
  kThreadDecreasing,  // lead shrinks by F mm/rev per revolution (G35)
  kTapIn,             // rigid tapping in (G331)
  kTapOut,            // rigid tapping out (G332)
  kTapFloating,       // tapping with compensating chuck, one block (G63)
  kProbe,             // move until the probe triggers (G31, MEAS)
};

enum class Plane : std::uint8_t { kUnknown, kXY, kZX, kYZ };
enum class Distance : std::uint8_t { kUnknown, kAbsolute, kIncremental };
/// kGeometry*: only lengths of the geometry follow, the feed stays in the basic system.
enum class Units : std::uint8_t { kUnknown, kMm, kInch, kMmGeometry, kInchGeometry };
enum class FeedMode : std::uint8_t { kUnknown, kPerMinute, kPerRevolution, kInverseTime };
enum class SpeedMode : std::uint8_t { kUnknown, kRpm, kConstantSurface };
enum class CutterComp : std::uint8_t { kUnknown, kOff, kLeft, kRight };
/// Meaning of words of the transverse axis. kDiameterAbsolute: absolute words are diameters, incremental ones radii.
enum class Diameter : std::uint8_t { kUnknown, kRadius, kDiameter, kDiameterAbsolute };
enum class PathMode : std::uint8_t { kUnknown, kExact, kContinuous };
enum class ReturnLevel : std::uint8_t { kUnknown, kInitial, kRPlane };  // of drilling cycles
enum class SpindleState : std::uint8_t { kUnknown, kStop, kCw, kCcw, kPositioned };

/// Canned cycles: what a block with positions does besides moving there.
enum class Cycle : std::uint8_t {
  kUnknown,
  kNone,
  // Holes along the axis normal to the plane.
  kDrill,
  kDrillDwell,
  kPeck,
  kPeckChip,
  kTap,
  kTapLeft,
  kRigidTap,
  kRigidTapLeft,
  kBoreFeed,   // feed out
  kBoreStop,   // spindle stands on the way out
  kBoreDwell,  // dwell, feed out
  kFineBore,   // oriented, shifted away from the wall
  kBackBore,
  kBoreManual,  // the operator lifts
  // Holes of lathes, along Z and along X.
  kFacePeck,
  kFaceTap,
  kFaceRigidTap,
  kFaceBore,
  kCrossPeck,
  kCrossTap,
  kCrossRigidTap,
  kCrossBore,
  // Turning: one cut out and back.
  kTurn,
  kTurnThread,
  kTurnFace,
  // Turning: a contour or a groove at once.
  kFinish,
  kRoughTurn,
  kRoughFace,
  kPattern,
  kFaceGroove,
  kGroove,
  kMultiThread,
};
/// What a word of a cycle means, in lengths (mm) unless said otherwise.
enum class CycleField : std::uint8_t {
  kLevel,    // R: level where the feed begins; incremental under incremental distance
  kStep,     // Q: peck, or shift of boring
  kDwell,    // P: seconds
  kRepeats,  // K, L: count
  kShiftX,
  kShiftY,
  kShiftZ,  // I J K
  kTaper,   // radius difference start - end
  kFirstBlock,
  kLastBlock,  // block numbers of the contour
  kDepth,      // of one cut, radius
  kRetract,    // radius
  kAllowanceX,
  kAllowanceZ,  // finishing allowance; X as the axis is programmed
  kReliefX,
  kReliefZ,  // stock of the pattern cycle; X as radius
  kPasses,   // count
  kStepX,
  kStepZ,       // of grooving; X as radius
  kHeight,      // of the thread, radius
  kFirstDepth,  // of the thread's first cut, radius
  kLeastDepth,
  kFinishDepth,
  kForm,    // six digits: finishing passes, run-out, angle
  kMethod,  // infeed
  kAngle,   // degrees
};

/// Settable work offset: `number` as the source programs it (54, 505, 0 = none), `extension` for G54.1 P.
struct WorkOffset {
  bool known = false;
  std::uint16_t number = 0;
  std::uint16_t extension = 0;
  constexpr bool operator==(const WorkOffset&) const = default;
};

/// Modal state that decides what a bare word means. Every group may be unknown (entry of a subprogram).
struct ModalState {
  Motion motion = Motion::kUnknown;
  Plane plane = Plane::kUnknown;
  Distance distance = Distance::kUnknown;
  Units units = Units::kUnknown;
  FeedMode feed_mode = FeedMode::kUnknown;
  SpeedMode speed_mode = SpeedMode::kUnknown;
  CutterComp comp = CutterComp::kUnknown;
  Diameter diameter = Diameter::kUnknown;
  PathMode path = PathMode::kUnknown;
  ReturnLevel return_level = ReturnLevel::kUnknown;
  WorkOffset work_offset;
  constexpr bool operator==(const ModalState&) const = default;
};

}  // namespace ncport::ir
