// What a run needs to know of one control and machine. Filled from dialect data and a profile; exec has no other source.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ir/modes.h"
#include "ir/nodes.h"

namespace ncport::ir {

enum class NumericModel : std::uint8_t {
  kBinary64,   // each result as IEEE double
  kDecimal8,   // each result rounded to 8 significant digits
  kNum8,       // decimal, eight digits kept, rule of the NUM card
};
enum class WordError : std::uint8_t { kNone, kRound, kTruncate };
enum class Rapid : std::uint8_t { kUnknown, kStraight, kDogleg };
enum class ModalCallTrigger : std::uint8_t { kMotionBlocks, kAxisWords };

/// Classes of alarms that a run can end in; the control's own number and text come from Machine::alarms.
enum class AlarmClass : std::uint8_t {
  kUser,             // the program asked for it
  kArithmetic,       // division by zero, domain, overflow
  kConversion,       // value outside the target type
  kIndex,            // array or cell index
  kMissingTarget,    // jump target
  kMissingProgram,
  kNesting,          // calls too deep
  kRange,            // value outside its limits (passes, codes)
  kCircle,           // end point, radius, centre
  kMissingFeed,
  kUnknownPosition,  // incremental word without a position
  kUnknownCode,
  kGeometry,         // other contour trouble
  kSyntax,           // a refused block was reached
  kProgramEnd,       // file ends without an end word
  kOther,
};
inline constexpr std::size_t kAlarmClasses = 16;

/// One G or M code that a program may compute at run time.
struct CodeMeaning {
  std::uint32_t tenths = 0;      // code times ten (G54.1 = 541)
  WordOp op = WordOp::kInert;
  std::uint8_t index = 0;
  std::uint32_t extra = Id<void>::kNone;
  Phase phase = Phase::kSetting;
};

struct Machine {
  // Axes.
  std::uint16_t axes = 0x1FF;                // bit per axis that exists
  std::uint8_t transverse_axis = 0xFF;       // axis that diameter words hold for; 0xFF = none
  bool lathe = false;

  // State at program start as the profile promises it.
  ModalState start;
  bool position_known = false;
  double start_position[kMaxAxes] = {};      // mm, degrees; transverse axis as radius

  // Arithmetic.
  NumericModel numeric_model = NumericModel::kBinary64;
  double compare_tolerance = 0;              // relative; used by comparisons flagged kTolerance
  WordError word_error = WordError::kNone;   // of computed words on their way to an axis
  double increment = 0.001;                  // least input increment, mm or degrees
  std::int64_t int_min = -2147483648LL;
  std::int64_t int_max = 2147483647LL;
  double cell_max = 0;                       // largest magnitude a cell of a space may hold; 0 = no limit
  std::uint32_t string_max = 200;            // characters

  // Limits of the control.
  std::uint32_t call_depth = 17;             // levels besides the main program
  std::uint32_t passes_max = 9999;
  bool program_variables_visible = false;    // variables of the main program are visible in subprograms

  // Rules of motion.
  Rapid rapid = Rapid::kStraight;
  bool incremental_traverses_frame = false;  // an incremental word after a frame change also moves the shift
  bool centers_are_diameter_when_absolute = true;
  double circle_tolerance = 0.01;            // mm, largest difference of start and end radius ...
  double circle_tolerance_factor = 0.001;    // ... or this times the radius
  bool feed_needed = true;                   // feed move without a feed is an alarm
  bool feed_type_change_drops_feed = true;   // after a change of feed mode F must be written again
  bool end_in_called_program_returns = true; // M30/M2 in a called program acts as return
  bool rotation_order_rpy = true;            // several angles in one rotation: Z, Y', X''; else Z, X', Z''
  bool chamfer_feed_from_next = true;        // feed of an inserted chamfer or rounding is that of the block behind
  bool surface_speed_per_revolution = true;  // constant surface speed switches the feed to per revolution
  ModalCallTrigger modal_call_trigger = ModalCallTrigger::kMotionBlocks;
  bool tool_activates_edge = false;          // a tool call without edge selects edge 1

  // Words that exist only at run time.
  std::vector<CodeMeaning> g_codes;          // sorted by tenths
  std::vector<CodeMeaning> m_codes;

  // Alarm number (or word) and text per AlarmClass; empty code: the class name is printed.
  struct Alarm {
    std::string code;
    std::string text;
  };
  Alarm alarms[kAlarmClasses];
};

}  // namespace ncport::ir
