// What the words of Fanuc Custom Macro B, Mazak EIA/ISO and Haas mean, as data: codes by G-code system, addresses with
// their number formats, functions, operators, keywords, arguments of macro calls. Cards: docs/languages/fanuc.md,
// mazak-lathe.md; `rule` names the section. System variables: system_variables.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "dialects/code_table.h"
#include "dialects/profile.h"
#include "ir/nodes.h"

namespace ncport::dialects::fanuc {

/// G-code systems (fanuc-8.1, mazak-lathe-2.2). Machining centres of all three makers share kMill.
enum class System : std::uint8_t { kMill, kLatheA, kLatheB, kLatheC, kMazakT, kMazakM };
inline constexpr std::size_t kSystems = 6;

/// None: the profile leaves the series of a lathe open.
std::optional<System> SystemOf(const Profile& profile);

/// G and M words whose meaning is one word of the IR. What needs other words of its block stands in SpecialCodes and
/// Cycles. Spindle words M3 M4 M5 are missing for kMazakM: the class of the machine decides (Profile::spindle).
const CodeTable& Codes(System system);

/// M functions without a row of their own belong to the machine builder (fanuc-8.11): Word::value is the number.
const CodeRow& AuxiliaryCode();

/// Codes that mean something only together with words of their block, or that change how following words are read.
enum class Special : std::uint8_t {
  kDwell,  // X U P: fanuc-8.1, mazak-lathe-2.6
  kData,   // G10 with L and P, until kDataEnd
  kDataEnd,
  kStrokeCheck,     // G22: axis words and I J K beside it are limits of the machine, no move
  kLocalShift,      // G52: zero of all work systems, replaces the last one (fanuc-8.4)
  kPreset,          // axis words: the present position gets these values; S: largest speed (fanuc-8.4)
  kPresetReset,     // back to the work system without preset
  kExtendedOffset,  // G54.1 P
  kPolarOn,         // fanuc-8.5
  kPolarOff,
  kRotationOn,  // plane words = centre, R = angle (fanuc-8.5)
  kRotationOff,
  kScalingOn,  // fanuc-8.6
  kScalingOff,
  kMirrorOn,  // fanuc-8.6
  kMirrorOff,
  kCylinder,        // G7.1
  kPolarMillingOn,  // G12.1
  kPolarMillingOff,
  kDiameterSwitch,  // Mazak G10.9 X0, X1
  kRadiusOn,        // Mazak G122.1
  kRadiusOff,
  kMacroCall,            // G65 (fanuc-7.3)
  kModalMacro,           // G66: after each block with motion (fanuc-7.4)
  kModalMacroEachBlock,  // G66.1
  kModalMacroEnd,        // G67
  kSubprogram,           // M98 (fanuc-7.2)
  kExternalSubprogram,   // M198
  kLocalSubprogram,      // Haas M97 P: block number of the same program
  kReturn,               // M99, M99 P
  kCycleEnd,             // G80
  kMazatrolOn,           // G53.5: MAZATROL coordinate system
  kMazatrolOff,          // G52.5
  kRigidTaps,            // M29: G84 and G74 that follow tap rigidly (fanuc-8.7)
  kQuiet,                // no effect on a trace; takes words of its block (P Q R) with it
  kQuietAlone,           // the same; axis words beside it are data, so they are refused
  kRefused,              // known, and not to be run: tilted planes, polygon turning, measuring, other system ...
  kRefusedByHaas,        // the same for codes that Haas controls alone have
};
struct SpecialRow {
  std::string_view text;  // "G52"
  Special special;
  std::uint16_t systems;   // bit per System
  std::uint8_t group[3];   // of a mill, a lathe, a Mazak lathe; 0 = one-shot
  std::string_view title;  // for messages: "local coordinate shift"
  std::string_view rule;
};
/// Rule of the words that only Haas controls have.
inline constexpr std::string_view kHaasRule = "fanuc-13";
/// Row of this code in the system, or null.
const SpecialRow* FindSpecial(System system, std::string_view text);
std::span<const SpecialRow> SpecialCodes();
/// Code to print for this meaning in the system; empty = the system has none.
std::string_view TextOf(System system, Special special);

/// Canned cycles. Drill cycles run at each block that names a position until G80 or a group-01 code (fanuc-8.7); single
/// lathe cycles likewise; repetitive ones at once (fanuc-8.8).
enum class CycleKind : std::uint8_t { kDrill, kTurningSingle, kRepetitive };
struct CycleRow {
  std::string_view text;
  ir::Cycle cycle;
  CycleKind kind;
  std::uint16_t systems;
  std::string_view words;  // letters that belong to the cycle besides axis words
  std::string_view title;
  std::string_view rule;
};
const CycleRow* FindCycle(System system, std::string_view text);
std::span<const CycleRow> Cycles();

/// How the digits of a word are read (fanuc-2.2).
enum class NumberForm : std::uint8_t {
  kLength,   // mm or inch; without point: profile `point`
  kAngle,    // degrees
  kFeed,     // by feed mode, see FormOf
  kInteger,  // a point is PS0007
  kCode,     // G: one decimal where the code has one
};
/// An address letter outside of macro calls, as it stands in most blocks. P and Q have no meaning of their own.
struct AddressRow {
  char letter;
  ir::WordOp op;       // kInert: the code of the block decides
  std::uint8_t index;  // axis, centre
  ir::ValueMode mode;  // kIncremental: U V W H of a lathe in system A or T
  NumberForm form;
  ir::Phase phase;
  std::string_view rule;
};
std::span<const AddressRow> Addresses(System system);
const AddressRow* FindAddress(System system, char letter);

/// Words whose number without point has a unit of its own: which word in which block (fanuc-2.2).
enum class WordContext : std::uint8_t {
  kFeedPerMinute,
  kFeedPerRevolution,
  kThreadLead,
  kDwellSeconds,       // X, U of G04
  kDwellMilliseconds,  // P of G04 and of drill cycles
  kCycleStep,          // P, Q of G74, G75, G76 on lathes
  kScaleFactor,        // P I J K of G51
  kStartAngle,         // Q of G32, G33
};
struct NumberUnit {
  double metric = 0;          // value of 1 without point: mm, seconds, degrees, factor
  double inch = 0;            // the same under G20, in inch
  bool point_allowed = true;  // false: PS0007
};
NumberUnit UnitOf(WordContext context, System system);

/// Arguments of G65 and G66 (fanuc-7.3): cell of a letter in list I, 0 = the letter is none (G L N O P).
std::uint32_t ArgumentCell(char letter);
/// Cell of I, J, K (0 1 2) of set 1 .. 10 in list II.
constexpr std::uint32_t ArgumentCell(std::uint32_t set, std::uint32_t position) { return 3 * set + 1 + position; }
inline constexpr std::uint32_t kArgumentSets = 10;
/// Letter of a cell in list I; 0 = no letter reaches it.
char ArgumentLetter(std::uint32_t cell);
/// Locals that no argument of list I reaches: free for temporaries inside macros (fanuc-14.1).
std::span<const NumberRange> FreeLocals();

/// How a function is written: FUNC[x], FUNC[x]/[y] (read also FUNC[x,y]), FUNC[x,y].
enum class FunctionForm : std::uint8_t { kOne, kQuotient, kList };
struct FunctionRow {
  std::string_view text;      // "ATAN"
  std::string_view shortest;  // "AT"
  ir::Function function;
  FunctionForm form;
  bool angle_range;  // result depends on fanuc.atan-range (6004#0)
  std::string_view rule;
};
/// ROUND stands twice: kRound in statements, kRoundToIncrement inside the value of a word (fanuc-4.4).
std::span<const FunctionRow> Functions();
/// Function written by `word` (its shortest form or more of it, upper case) with one bracket or more, or null.
const FunctionRow* FindFunction(std::string_view word, bool one_bracket);
/// Row to print, or null. ASIN, and ATAN with two brackets, print for both of their ranges.
const FunctionRow* FindFunction(ir::Function function);

struct OperatorRow {
  std::string_view text;
  std::string_view shortest;
  ir::ExprOp op;         // between numbers
  ir::ExprOp condition;  // between conditions; kLiteral: not allowed there
  std::uint8_t level;    // fanuc-4.1; the smallest binds tightest
  std::string_view rule;
};
std::span<const OperatorRow> Operators();
const OperatorRow* FindOperator(std::string_view word);
/// Row to print for an operation (`op` of the row, or its `condition`), or null.
const OperatorRow* FindOperator(ir::ExprOp op);

enum class Keyword : std::uint8_t {
  kIf,
  kGoto,
  kThen,
  kElse,
  kEndIf,
  kWhile,
  kDo,
  kEnd,
  kOpen,
  kClose,
  kPrintBinary,
  kPrint,
  kSetName,
};
struct KeywordRow {
  std::string_view text;
  std::string_view shortest;
  Keyword keyword;
  std::string_view rule;
};
std::span<const KeywordRow> Keywords();
/// Keyword written by `word`. POPEN and not POW: keywords are looked up at the start of a statement only (fanuc-2.4).
const KeywordRow* FindKeyword(std::string_view word);

}  // namespace ncport::dialects::fanuc
