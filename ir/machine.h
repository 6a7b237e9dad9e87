// What a run needs to know of one control and machine. Filled from dialect data and a profile; exec has no other
// source.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ir/modes.h"
#include "ir/nodes.h"

namespace ncport::ir {

enum class NumericModel : std::uint8_t {
  kBinary64,  // each result as IEEE double
  kDecimal8,  // each result rounded to 8 significant digits
  kNum8,      // decimal, eight digits kept, rule of the NUM card
};
enum class WordError : std::uint8_t { kNone, kRound, kTruncate };
enum class Rapid : std::uint8_t { kUnknown, kStraight, kDogleg };
enum class ModalCallTrigger : std::uint8_t { kMotionBlocks, kAxisWords };

/// Classes of alarms that a run can end in; the control's own number and text come from Machine::alarms.
enum class AlarmClass : std::uint8_t {
  kUser,           // the program asked for it
  kArithmetic,     // division by zero, domain, overflow
  kConversion,     // value outside the target type
  kIndex,          // array or cell index
  kMissingTarget,  // jump target
  kMissingProgram,
  kNesting,  // calls too deep
  kRange,    // value outside its limits (passes, codes)
  kCircle,   // end point, radius, centre
  kMissingFeed,
  kUnknownPosition,  // incremental word without a position
  kUnknownCode,
  kGeometry,          // other contour trouble
  kSyntax,            // a refused block was reached
  kProgramEnd,        // file ends without an end word
  kNoTransverseAxis,  // a diameter word on a machine without a transverse axis
  kOther,
};
inline constexpr std::size_t kAlarmClasses = 17;

/// One G or M code that a program may compute at run time.
struct CodeMeaning {
  std::uint32_t tenths = 0;  // code times ten (G54.1 = 541)
  WordOp op = WordOp::kInert;
  std::uint8_t index = 0;
  std::uint32_t extra = Id<void>::kNone;
  Phase phase = Phase::kSetting;
};

/// Code of a modal group while a mode is in force: what a program reads back ($P_GG[1], #4001). The first row of the
/// group that agrees with the state is the answer.
struct GroupCode {
  std::uint16_t group = 0;
  WordOp op = WordOp::kInert;  // Motion, Plane, Distance, Units, FeedMode, SpeedMode, CutterComp, Diameter, PathMode,
                               // ReturnLevel, WorkOffset; Inert: no state behind it, always agrees
  std::uint8_t index = 0;      // enumerator of ir/modes.h
  std::uint32_t extra = Id<void>::kNone;  // WorkOffset: number
  double code = 0;
};

/// What numbers of the program's own alarms the control shows: `first` to `last` as `shown` and up, or all of them as
/// `shown`.
struct AlarmNumbers {
  std::uint32_t first = 0, last = 0;
  std::uint32_t shown = 0;
  bool one = false;
};

/// What happens when a program writes a numbered variable.
enum class WriteEffect : std::uint8_t { kNone, kAlarm /* ends the run */, kMessageStop };

/// Numbered variables that stand for something of the machine, for numbers that are known only at run time.
struct NumberedSystem {
  std::uint32_t first = 0, last = 0;
  std::uint32_t base = 0;  // index in its kind = number - base
  SystemKind kind = SystemKind::kEnvironment;
  bool readable = true;
  bool writable = false;
  WriteEffect effect = WriteEffect::kNone;
};

/// What a dwell counts while the feed is per revolution.
enum class DwellUnit : std::uint8_t { kSeconds, kRevolutions, kUnknown };

/// Values of numbers without decimal point (Word::kIncrements), in the unit that the program uses.
struct NumberUnits {
  double feed_per_minute = 1, feed_per_minute_inch = 1;
  double feed_per_revolution = 1, feed_per_revolution_inch = 1;
};

/// Alarm numbers that only show a message; AlarmKind::kByNumber asks for them at run time.
struct AlarmRange {
  std::uint32_t first = 0, last = 0;
};

struct Machine {
  // Axes.
  std::uint16_t axes = 0x1FF;           // bit per axis that exists
  std::uint8_t transverse_axis = 0xFF;  // axis that diameter words hold for; 0xFF = none
  bool lathe = false;

  // State at program start as the profile promises it.
  ModalState start;
  bool position_known = false;
  double start_position[kMaxAxes] = {};  // mm, degrees; transverse axis as radius

  // Arithmetic.
  NumericModel numeric_model = NumericModel::kBinary64;
  double compare_tolerance = 0;             // relative; used by comparisons flagged kTolerance
  WordError word_error = WordError::kNone;  // of computed words on their way to an axis
  double increment = 0.001;                 // least input increment, mm or degrees
  std::int64_t int_min = -2147483648LL;
  std::int64_t int_max = 2147483647LL;
  double cell_max = 0;             // largest magnitude a cell of a space may hold; 0 = no limit
  std::uint32_t string_max = 200;  // characters

  // Limits of the control.
  std::uint32_t call_depth = 17;  // levels besides the main program
  std::uint32_t passes_max = 9999;
  bool program_variables_visible = false;  // variables of the main program are visible in subprograms

  // Rules of flow.
  bool file_end_is_end = false;          // a program may end without an end word; else that is an alarm
  bool return_in_main_restarts = false;  // a return word in the main program starts it again; else it ends it
  bool for_end_once = true;              // the end value of FOR is computed once, not before each pass
  bool for_counter_rounds = true;        // a REAL counter is rounded to a whole number when the loop starts
  bool passes_keep_locals = false;       // later passes of one call see the locals as the pass before left them
  std::uint32_t modal_call_levels = 1;   // modal calls that may be active at once; the last one runs first
  bool modal_call_keeps_locals = true;   // locals of a modal subprogram keep their values between its runs

  // Rules of motion.
  Rapid rapid = Rapid::kStraight;
  bool incremental_traverses_frame = false;  // an incremental word after a frame change also moves the shift
  bool centers_are_diameter_when_absolute = true;
  double circle_tolerance = 0.01;             // mm, largest difference of start and end radius ...
  double circle_tolerance_factor = 0.001;     // ... or this times the radius
  bool feed_needed = true;                    // feed move without a feed is an alarm
  bool feed_type_change_drops_feed = true;    // after a change of feed mode F must be written again
  bool end_in_called_program_returns = true;  // M30/M2 in a called program acts as return
  bool rotation_order_rpy = true;             // several angles in one rotation: Z, Y', X''; else Z, X', Z''
  bool arc_center_corrected = true;           // a centre that does not fit both ends is moved between them
  double arc_correction_angle =
      1.8;  // degrees that the centre may turn seen from the start, when corrected; 0 = no test
  bool arc_radius_beats_center = false;       // radius and centre in one block: the radius holds; else that is an alarm
  bool arc_radius_without_end_stays = false;  // radius without another end point: no motion; else that is an alarm
  bool thread_lead_from_feed = false;    // the lead of a thread is F, the centre word its change; else the centre word
  bool frame_shift_in_diameter = false;  // shifts of the transverse axis follow the diameter mode
  bool reference_via_point = false;      // axis words of a reference move are a point on the way
  bool position_reads_diameter = false;  // position variables of the transverse axis follow the diameter mode
  bool chamfer_feed_from_next = true;    // feed of an inserted chamfer or rounding is that of the block behind
  bool surface_speed_per_revolution = true;  // constant surface speed switches the feed to per revolution
  ModalCallTrigger modal_call_trigger = ModalCallTrigger::kMotionBlocks;
  bool tool_activates_edge = false;  // a tool call without edge selects edge 1
  bool tool_suffix = false;          // T1.02: the decimals say which of the tools with this number is meant
  bool tool_word_changes = false;    // the tool word changes the tool; else it waits for a change word

  NumberUnits units;
  DwellUnit dwell_per_revolution = DwellUnit::kSeconds;  // G4 while the feed is per revolution

  // Canned cycles.
  double chip_back_off = 1;                 // mm; peck drilling with chip breaking
  double peck_clearance = 1;                // mm above the last depth where the feed begins again
  bool cycle_level_from_initial = false;    // the level of hole cycles is a distance from the initial level (lathes)
  double rotation_default_angle = 0;        // of a rotation about a centre without angle, degrees
  bool rotation_angle_by_distance = false;  // its angle adds under incremental distance
  double thread_run_out = 0;                // of threading cycles, in leads

  // Programs and variables by number.
  std::string program_prefix;  // name of program 1234: prefix + 1234
  std::vector<NumberedSystem> numbered_systems;
  std::vector<std::uint8_t> position_axes;  // axis of position variable 1, 2 ...
  std::vector<AlarmNumbers> alarm_numbers;
  bool fixed_text_pads = false;  // FixedText: blanks for leading zeros and for the missing sign

  // Words that exist only at run time.
  std::vector<CodeMeaning> g_codes;  // sorted by tenths
  std::vector<CodeMeaning> m_codes;

  std::vector<GroupCode> groups;
  std::vector<AlarmRange> shown_alarms;

  // Alarm number (or word) and text per AlarmClass; empty code: the class name is printed.
  struct Alarm {
    std::string code;
    std::string text;
  };
  Alarm alarms[kAlarmClasses];
};

}  // namespace ncport::ir
