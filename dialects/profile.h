// One machine: the typed and checked content of a profile file (contracts section 8). All keys with their values and
// meaning stand in profile_keys.cc, from which docs/profiles.md is made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"
#include "dialects/language.h"
#include "ir/machine.h"
#include "ir/modes.h"
#include "ir/nodes.h"

namespace ncport::dialects {

/// A value, or the question for it: the file says `ask`, or neither it nor those it inherits from have the key.
template <class T>
class Setting {
 public:
  Setting() = default;
  Setting(T value)
      : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor): `profile.point = PointRule::kIncrement`

  [[nodiscard]] bool Known() const { return value_.has_value(); }
  /// The value; using an open setting is a bug (see Need).
  [[nodiscard]] const T& operator*() const {
    NCPORT_CHECK(value_.has_value(), "profile key '{}' was used without a value", key_);
    return *value_;
  }
  [[nodiscard]] const T* operator->() const { return &**this; }
  [[nodiscard]] T Or(T fallback) const { return value_.has_value() ? *value_ : std::move(fallback); }
  /// True when known and equal to `value`.
  [[nodiscard]] bool Is(const T& value) const { return value_.has_value() && *value_ == value; }
  /// Path of the key in the file: "fanuc.atan-range".
  [[nodiscard]] std::string_view Key() const { return key_; }

  void Set(T value) { value_ = std::move(value); }
  void Ask() { value_.reset(); }
  void SetKey(std::string_view key) { key_ = key; }

 private:
  std::optional<T> value_;
  std::string_view key_;  // static text of the key table
};

enum class MachineKind : std::uint8_t { kMill, kLathe };
/// G-code system: Fanuc lathes A, B, C; Mazak M, T. kNone: the language has one only.
enum class Series : std::uint8_t { kNone, kA, kB, kC, kM, kT };
/// Machine family where the same words differ (mazak-lathe card, section 5.1).
enum class MachineClass : std::uint8_t { kNone, kQuickTurn, kIntegrexOld, kIntegrexNew };
/// What words of the transverse axis are. kModal: the program says (DIAMON).
enum class DiameterRule : std::uint8_t { kNo, kYes, kModal };
enum class LengthUnit : std::uint8_t { kMm, kInch };
/// A length without decimal point: kIncrement = least input increments, kCalculator = mm, inch, degrees.
enum class PointRule : std::uint8_t { kIncrement, kCalculator };
/// First characters of a name. kTwoLetters: two letters or underscores.
enum class NameStart : std::uint8_t { kLetter, kTwoLetters };
/// How a program is called: by name, O number, % number, or the name of its file (Mazak).
enum class ProgramNaming : std::uint8_t { kName, kONumber, kPercentNumber, kFileName, kNone };
enum class LabelForm : std::uint8_t { kNames, kNumbers, kNamesAndNumbers, kNone };

/// Cells or numbers `first` to `last`, both included.
struct NumberRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  [[nodiscard]] constexpr bool Contains(std::uint32_t number) const { return number >= first && number <= last; }
  constexpr bool operator==(const NumberRange&) const = default;
};

/// One numbered variable space; spaces of one name with other ranges stand beside each other (#1-#33, #100-#199).
struct VariableSpace {
  std::string name;  // "R", "#", "L"
  NumberRange range;
  ir::Type type = ir::Type::kReal;  // kNumber: may be vacant
  ir::Lifetime lifetime = ir::Lifetime::kKept;
  ir::Visibility visibility = ir::Visibility::kAll;
  ir::StartValue start = ir::StartValue::kUnknown;
  std::vector<NumberRange> reserved;  // cells that translated programs must not use
};

/// Cells of one space where a translator may put temporaries: "#100-#149".
struct ScratchRange {
  std::string space;
  NumberRange range;
};

/// Rules for names. Lengths in characters.
struct NameRules {
  Setting<std::int64_t> max_length;  // of variables; 0 = no named variables
  Setting<NameStart> first;
  Setting<std::int64_t> labels;    // longest label; 0 = no label names
  Setting<LabelForm> label_form;   // what a jump may name
  Setting<std::int64_t> programs;  // longest program name; digits where programs are numbers
  Setting<ProgramNaming> program_form;
  Setting<NumberRange> program_numbers;  // numbers of user programs
  Setting<NumberRange> block_numbers;    // N words
  Setting<NumberRange> macro_numbers;    // numbers that a translator gives to programs it makes
  Setting<bool> ignore_case;
};

/// Deepest nesting that the control takes.
struct NestingLimits {
  Setting<std::int64_t> call;      // called programs besides the main program
  Setting<std::int64_t> macro;     // of these, levels with own local variables
  Setting<std::int64_t> loop;      // loops inside each other; 0 = no structured loops
  Setting<std::int64_t> brackets;  // in expressions; 0 = no brackets
  Setting<std::int64_t> branch;    // key "if": structured branches inside each other; 0 = no structured branch
};

struct BlockLimits {
  Setting<std::int64_t> max_length;  // characters with line end
  Setting<std::int64_t> max_m;       // M functions
  Setting<std::int64_t> max_passes;  // largest repeat count of a call
};

/// Words of one spindle; empty: it has none.
struct SpindleWords {
  Setting<std::string> cw, ccw, stop;
  Setting<std::string> css;     // template {speed}: constant surface speed, m/min or ft/min
  Setting<std::string> rpm;     // template {speed}: 1/min
  Setting<std::string> limit;   // template {speed}: largest 1/min under constant surface speed
  Setting<std::string> r_word;  // added to limit, css, rpm ("R1"); empty: none
};

/// Word templates of the writer. Holes: see TemplateHoles in profile_keys.cc ({number}, {speed}, {seconds} ...).
struct WriterWords {
  Setting<std::string> feed_per_minute, feed_per_revolution, feed_inverse_time;
  Setting<std::string> absolute, incremental;  // "G90", "G91"; empty: no such word
  Setting<std::string> incremental_axes;       // letters of the increments of X, Y, Z, C: "UVWH"; empty: none
  Setting<std::string> work_offset, work_offset_extended, work_offset_none;
  Setting<std::string> length_offset, length_offset_off, radius_offset, edge;
  Setting<std::string> tool;  // tool call: "T{tool} M6", "T{tool:02}{offset:02}"
  Setting<std::string> mm, inch;
  Setting<std::string> diameter_on, diameter_off;
  Setting<std::string> dwell, dwell_revolutions;
  Setting<std::string> thread;
  Setting<std::string> end;                          // end of the main program
  Setting<std::string> sub_end;                      // end of a called program
  Setting<std::vector<std::string>> home;            // blocks that leave the work before a tool change
  Setting<std::vector<std::string>> safe_position;   // blocks of a position where tools may be changed
  Setting<std::vector<std::string>> header, footer;  // blocks that frame a main program
};

struct MCodeRule {
  std::string source;  // "M41"
  std::string target;  // words of the target; "drop": left out and listed
};

/// Settings of the Fanuc family (fanuc card, "Parameters"; mazak-lathe card, 10.5).
struct FanucSettings {
  enum class Variant : std::uint8_t { kFanuc, kMazak, kHaas };
  enum class Dwell : std::uint8_t { kTime, kRevolutions };        // under feed per revolution
  enum class CornerWords : std::uint8_t { kComma, kPlain };       // `,C ,R ,A` or `C R A`
  enum class AtanRange : std::uint8_t { kPositive, kSigned };     // 0..360, -180..180
  enum class Logic : std::uint8_t { kBits, kConditions };         // AND OR XOR between conditions
  enum class Calls : std::uint8_t { kPacked, kRepeatWord };       // M98 P51234, M98 P1234 L5
  enum class LengthWord : std::uint8_t { kNone, kG43H, kG43P1 };  // tool length of a multi-tasking machine
  enum class RetractOrder : std::uint8_t { kXThenZ, kZThenX };
  enum class WorkZero : std::uint8_t { kOffset, kMazatrol };     // G54, G53.5
  enum class FeedSpindle : std::uint8_t { kTurning, kMilling };  // that feed per revolution refers to

  Setting<Variant> variant;
  Setting<std::string> control;                         // model as the maker names it, for the sheet
  Setting<Dwell> dwell;                                 // 3405#1 DWL, Mazak F92.2
  Setting<CornerWords> corner_words;                    // 3405#4 CCR
  Setting<bool> supplementary_angle;                    // 3405#5 DDP
  Setting<double> circle_tolerance;                     // 3410, mm
  Setting<bool> feed_along_helix;                       // 1403#5 HTG
  Setting<bool> series15_format;                        // 0001#1 FCV
  Setting<double> g73_back_off;                         // 5114, mm
  Setting<double> g83_clearance;                        // 5115, mm
  Setting<double> thread_run_out;                       // 5130, in leads
  Setting<bool> rotation_r_by_distance;                 // 5400#0 RIN
  Setting<double> rotation_default_angle;               // 5410, degrees
  Setting<bool> offset_memory_15;                       // 6000#3 V15
  Setting<bool> print_leading_blanks;                   // 6001#1 PRT = 0
  Setting<bool> tool_calls_macro;                       // 6001#5 TCS
  Setting<bool> reset_clears_common;                    // 6001#6 CCV = 0, Mazak F87.7
  Setting<bool> reset_clears_local;                     // 6001#7 CLV = 1, Mazak F87.6
  Setting<AtanRange> atan_range;                        // 6004#0 NAT
  Setting<bool> call_from_block;                        // 6005#0 SQC: M98 P Q
  Setting<Logic> logic;                                 // 6006#0 MLG
  Setting<bool> arguments_to_real;                      // 6007#4 CVA
  Setting<bool> alarm_number_as_written;                // 6008#1 MCA
  Setting<bool> arguments_always_first_list;            // 6008#7 IJK
  Setting<Calls> calls;                                 // form of repeats that the writer uses
  Setting<bool> structured_if;                          // IF .. THEN .. ELSE .. ENDIF over blocks
  Setting<bool> truth_values;                           // Haas: every expression is a condition
  Setting<bool> expression_without_brackets;            // Mazak: X#1+10
  Setting<bool> local_call;                             // Haas: M97
  Setting<std::int64_t> do_numbers;                     // largest number behind DO
  Setting<std::int64_t> digits;                         // most digits of a number in a word
  Setting<std::vector<std::string>> missing_functions;  // functions that the control lacks
  Setting<NumberRange> alarms;                          // values of #3000 that a translator uses
  // Mazak turning machines.
  Setting<LengthWord> length_word;  // key "ix-offset"
  Setting<RetractOrder> retract_order;
  Setting<WorkZero> work_zero;  // key "wcs"
  Setting<FeedSpindle> feed_spindle;
  Setting<std::string> leave_mazatrol;  // block that leaves the MAZATROL coordinate system; empty: none
  Setting<std::string> b_position;      // angle of B for turning, as written ("90."); empty: programs do not turn B
  Setting<std::vector<std::string>> b_blocks;  // that turn B to {b}
  Setting<std::string> safe_z;                 // safe Z in machine coordinates, mm
  Setting<bool> c_axis;                        // M202 before turning
  Setting<bool> o_word;                        // programs begin with an O word
};

/// Settings of SINUMERIK controls (sinumerik card; machine data MD, setting data SD).
struct SinumerikSettings {
  enum class Family : std::uint8_t { k840D, k802D, k802S };
  enum class RotationOrder : std::uint8_t { kRpy, kEuler };
  enum class CornerFeed : std::uint8_t { kNext, kOwn };
  enum class ToolChange : std::uint8_t { kAtT, kAtM6 };

  Setting<Family> family;
  Setting<bool> main_variables_visible;       // MD11120
  Setting<bool> mod_div_round_operands;       // card 4.2
  Setting<double> compare_tolerance;          // relative; equality
  Setting<bool> compare_exact_order;          // MD10280 bit 0: < and > are exact
  Setting<double> circle_tolerance;           // MD21000, mm
  Setting<double> circle_tolerance_factor;    // MD21010
  Setting<RotationOrder> rotation_order;      // MD10600
  Setting<CornerFeed> corner_feed;            // MD20201 bit 0
  Setting<bool> incremental_traverses_frame;  // SD42440
  Setting<ToolChange> tool_change;            // MD22550
  Setting<bool> change_selects_edge;          // MD20270: D1 after a change
  Setting<bool> frames_as_diameter;           // MD20360 bit 3
  Setting<double> start_feed;                 // SD42110, mm/min; 0 = none
  Setting<bool> definitions;                  // DEF, PROC parameters
  Setting<bool> computed_index;               // R[expression]
  Setting<bool> logic_words;                  // AND OR NOT XOR
  Setting<bool> jumps_both_ways;              // GOTO, GOTOC, GOTOS, block numbers and texts as targets
  Setting<bool> assignments_beside_motion;    // axis assignments with other words in one block
  Setting<bool> modal_call_without_axis;      // blocks without axis word run a modal call (card 7.1)
  Setting<bool> for_end_each_pass;            // the end of FOR is evaluated in each pass (card 6.3)
  Setting<bool> drill_cycles_keep_codes;      // CYCLE81, 82 put the caller's G words back (card 8.12)
};

/// Settings of NUM controls (num card).
struct NumSettings {
  Setting<double> internal_linear;              // mm
  Setting<double> internal_rotary;              // degrees
  Setting<bool> leading_zero_counts;            // NUM-10: the 0 of 0.333 is one of the eight digits
  Setting<std::int64_t> guard_digits;           // NUM-10: digits to which a result is rounded before it is cut
  Setting<double> circle_tolerance;             // NUM-62, mm
  Setting<bool> structured;                     // IF, WHILE, FOR, REPEAT, VAR are fitted
  Setting<bool> end_in_called_ends_all;         // NUM-50: M02 in a subprogram
  Setting<bool> incremental_center_from_start;  // NUM-61: I J K in G91
};

/// Settings of flat output (iso card).
struct IsoSettings {
  enum class Arcs : std::uint8_t { kCenter, kRadius };
  Setting<Arcs> arcs;
  Setting<std::int64_t> block_number_step;  // 0 = no N words
};

/// See the page docs/profiles.md for every key.
/// How programs name the geometry of a tool: edges of the tool in the spindle (D1), registers of their own for length
/// and radius (H5, D25), or the turret's offset in the tool word (T0101).
enum class ToolAddressing : std::uint8_t { kEdges, kRegisters, kTurret };

struct Profile {
  std::string name;  // of a built-in profile, else the path as given
  Language language = Language::kIso;
  MachineKind machine = MachineKind::kMill;
  Setting<Series> series;
  Setting<MachineClass> machine_class;  // key "class"
  std::vector<std::string> axes;        // upper case, in the machine's order: first = number 1 of position variables
  Setting<DiameterRule> diameter;
  Setting<LengthUnit> units;  // of numbers at program start and of output
  Setting<double> increment;  // least input increment, mm or degrees
  Setting<PointRule> point;
  Setting<std::int64_t> decimals;  // of computed lengths in output
  Setting<ir::WordError> word_error;
  Setting<ir::NumericModel> numeric_model;
  ir::ModalState start;        // groups that the file leaves open are unknown
  Setting<ir::Rapid> rapid;    // always known: `unknown` is one of its values
  Setting<std::int64_t> skip;  // level of `/` without a number, 0..9
  std::vector<VariableSpace> variables;
  NameRules names;
  NestingLimits nesting;
  BlockLimits block;
  SpindleWords spindle;         // of the work on a lathe, of the tool on a mill
  SpindleWords second_spindle;  // key "spindle.second"
  SpindleWords live_spindle;    // key "spindle.live": driven tools of a lathe
  WriterWords words;
  std::vector<MCodeRule> mcodes;
  std::vector<ScratchRange> scratch;
  FanucSettings fanuc;
  SinumerikSettings sinumerik;
  NumSettings num;
  IsoSettings iso;

  [[nodiscard]] ToolAddressing Tools() const;
  /// Digits of the offset in the T word of a turret: T0101 has two unless the key `tool` says otherwise.
  [[nodiscard]] std::uint32_t OffsetDigits() const;
  [[nodiscard]] bool IsLathe() const { return machine == MachineKind::kLathe; }
  /// The lathes of docs/languages/mazak-lathe.md.
  [[nodiscard]] bool IsMazakLathe() const { return IsLathe() && fanuc.variant.Is(FanucSettings::Variant::kMazak); }
};

/// A built-in profile by its name, or the file at a path (it has a `/` or ends in `.toml`). The text of a file is added
/// to `files`, so that findings can show their place. Fails after errors.
Result<Profile> LoadProfile(std::string_view name_or_path, SourceFiles& files, diag::Sink& sink);

/// Reports at `at` that `profile` leaves `key` open, with the line to add.
void ReportOpenKey(const Profile& profile, std::string_view key, const SourceRange& at, diag::Sink& sink);

/// True if the setting has a value; else reports that the profile leaves it open, with the line to add.
template <class T>
[[nodiscard]] bool Need(const Profile& profile, const Setting<T>& setting, const SourceRange& at, diag::Sink& sink) {
  if (setting.Known()) return true;
  ReportOpenKey(profile, setting.Key(), at, sink);
  return false;
}

}  // namespace ncport::dialects
