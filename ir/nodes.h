// The records of the IR. All are flat: typed ids and ranges into the arenas of ir::Module, no pointers, no strings.
//
// The unit is the block (one line of source). A program is a flat run of blocks; IF, WHILE, loops are pairs of mark
// blocks joined by Block::link, so that jumps, repeated parts and comments keep their places and exec needs no stack
// for structure. `ir/verify.h` checks that marks nest.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/ids.h"
#include "base/source_range.h"
#include "base/string_pool.h"
#include "ir/modes.h"

namespace ncport::ir {

using ProgramId = Id<struct ProgramTag>;
using BlockId = Id<struct BlockTag>;
using WordId = Id<struct WordTag>;
using ExprId = Id<struct ExprTag>;
using ExprItemId = Id<struct ExprItemTag>;  // entry of Module::expr_items
using VariableId = Id<struct VariableTag>;
using SpaceId = Id<struct SpaceTag>;
using SystemId = Id<struct SystemTag>;
using JumpId = Id<struct JumpTag>;
using SwitchId = Id<struct SwitchTag>;
using CallId = Id<struct CallTag>;
using ArgId = Id<struct ArgTag>;
using PartId = Id<struct PartTag>;
using ForId = Id<struct ForTag>;
using ExternId = Id<struct ExternTag>;
using AssignListId = Id<struct AssignListTag>;
using OriginId = Id<struct OriginTag>;
using CommentId = Id<struct CommentTag>;

/// Static type. kNumber: a REAL that may be vacant. kAny: not known before the run.
enum class Type : std::uint8_t { kNone, kInt, kReal, kBool, kChar, kString, kAxis, kFrame, kNumber, kAny };

enum class WordOp : std::uint8_t {
#define NCPORT_WORD(Name, text, value, phase) k##Name,
#include "ir/nodes.def"
};

enum class ExprOp : std::uint8_t {
#define NCPORT_EXPR(Name, text, operands) k##Name,
#include "ir/nodes.def"
};

enum class Function : std::uint8_t {
#define NCPORT_FUNCTION(Name, text, min_args, max_args) k##Name,
#include "ir/nodes.def"
};

/// When a word takes effect inside its block. Values of all words are evaluated first, in source order, and
/// kImmediate words act while that happens (assignments from left to right).
enum class Phase : std::uint8_t { kImmediate, kSetting, kBefore, kMotion, kAfter, kFlow, kLast };

enum class ValueUse : std::uint8_t { kNever, kMay, kMust };
enum class Operands : std::uint8_t { kLeaf, kUnary, kBinary, kList };

/// How the value of a dimension word is meant. kModal: by the distance and diameter mode in force.
enum class ValueMode : std::uint8_t {
  kModal,
  kAbsolute,             // AC()
  kIncremental,          // IC(), U and W of a lathe in system A
  kShortest,             // DC(): rotary, shortest way
  kPositive,             // ACP()
  kNegative,             // ACN()
  kAbsoluteDiameter,     // DAC()
  kIncrementalDiameter,  // DIC()
  kAbsoluteRadius,       // RAC()
  kIncrementalRadius,    // RIC()
  kQuick,                // QU(): output of the function does not wait; no effect on a trace
  kStep,  // incremental from the last position, not converted by the diameter mode: I J K from the start point
};

enum class ChamferKind : std::uint8_t { kLength, kLeg, kRound, kRoundModal };
enum class ReferenceKind : std::uint8_t { kReference, kSecondReference, kFixedPoint, kFromReference };
enum class PoleBase : std::uint8_t { kLastPosition, kWorkpieceZero, kLastPole };
enum class FrameOp : std::uint8_t {
  kTranslate,
  kRotate,
  kScale,
  kMirror,  // absolute: replace the whole programmable frame
  kAddTranslate,
  kAddRotate,
  kAddScale,
  kAddMirror,
  kReset,
  // Layers that stand beside each other, in this order from the outside: shift, rotation, scale, mirror. Each word
  // replaces its own layer. Axis words are the shift, or the centre; a missing centre is the present position.
  kLocalShift,  // named axes only; 0 takes it back
  kRotateAbout,
  kRotateEnd,  // in the plane
  kScaleAbout,
  kScaleEnd,  // factors: FrameFactor words
  kMirrorAbout,
  kMirrorEnd,  // named axes
};
/// kByNumber: Machine::shown_alarms decides when the number is known.
enum class AlarmKind : std::uint8_t { kStops, kShows, kByNumber };
/// kEnd: M17, RET, M99. kToCaller: RET("label"), M99 P: value is the block number or label in the caller.
enum class ReturnKind : std::uint8_t { kAuxiliary /* M17 */, kPlain /* RET, M99 */, kToCaller };

/// Digits of a literal as written, so that it can be printed again unchanged.
struct NumberFormat {
  std::uint8_t int_digits = 0;  // digits before the point; 0 for `.5`
  std::uint8_t decimals = 0;    // digits behind the point
  std::uint8_t flags = 0;       // NumberFormat::k*

  static constexpr std::uint8_t kPoint = 1;     // a decimal point was written
  static constexpr std::uint8_t kPlusSign = 2;  // `+` was written
  static constexpr std::uint8_t kAsText = 4;    // exponent, hex, many digits: Expr::b of a Text twin holds the spelling
  static constexpr std::uint8_t kComputed = 8;  // not from a source: decimals are chosen by the printer
  constexpr bool operator==(const NumberFormat&) const = default;
};

/// One expression node, 16 bytes. Children stand before their parents in the store.
struct Expr {
  ExprOp op = ExprOp::kLiteral;
  Type type = Type::kNone;
  std::uint8_t flags = 0;   // Expr::k*
  NumberFormat format;      // kLiteral
  std::uint16_t count = 0;  // kList: number of entries; kLiteral with kAsText: see Module::literal_texts
  union {
    double number;          // kLiteral; BOOL as 0 and 1, CHAR as its code
    __extension__ struct {  // anonymous structs are no ISO C++; g++ and clang have them
      std::uint32_t a, b;   // see the comments in nodes.def; kList: b = first entry in Module::expr_items
    };
  };

  // Flags.
  static constexpr std::uint8_t kTolerance = 1;       // comparison with the Machine's relative tolerance
  static constexpr std::uint8_t kImplicit = 2;        // made by the compiler, not printed
  static constexpr std::uint8_t kOperandsToInt = 4;   // Modulo, DivideInteger: round operands first
  static constexpr std::uint8_t kVacantAsZero = 8;    // arithmetic on a vacant value takes 0
  static constexpr std::uint8_t kRoundCut = 16;       // Convert to INT cuts instead of rounding
  static constexpr std::uint8_t kNumericModel = 32;   // result passes through the Machine's numeric model
  static constexpr std::uint8_t kVacantDiffers = 64;  // eq, ne: a vacant value differs from 0

  Expr() : number(0) {}
};
static_assert(sizeof(Expr) == 16);

/// One word of a block, 24 bytes.
struct Word {
  WordOp op = WordOp::kVerbatim;
  std::uint8_t index = 0;              // axis, spindle, mode, kind: see nodes.def
  ValueMode mode = ValueMode::kModal;  // dimension words
  Phase phase = Phase::kImmediate;
  std::uint8_t flags = 0;      // Word::k*
  std::uint8_t digits = 0;     // digits of a code as written (G01 = 2), 0 = as the table spells it
  std::uint16_t spelling = 0;  // Module::spellings: text of the table row and its card rule; 0 = none
  ExprId value;
  std::uint32_t extra = Id<void>::kNone;  // see nodes.def
  std::uint32_t begin = 0;                // byte offset in the source line
  std::uint32_t length = 0;

  // Flags.
  static constexpr std::uint8_t kEqualSign = 1;       // written with `=`
  static constexpr std::uint8_t kVanishesVacant = 2;  // a vacant value means that the word is not there
  static constexpr std::uint8_t kRoundsValue = 4;     // the value passes to the address through Machine::word_error
  static constexpr std::uint8_t kAdded = 8;           // made by a pass, stands in the report
  static constexpr std::uint8_t kFreezes = 16;        // SpeedMode: the present speed stays in force (G97)
  static constexpr std::uint8_t kIncrements = 32;  // the value counts units that the machine's increment and the modes
                                                   // in force decide (a number without decimal point, milliseconds)
  static constexpr std::uint8_t kKeepsTool = 64;   // a tool word for its offset only: the tool that is in stays in

  /// Typed view of `extra`.
  template <class IdType>
  [[nodiscard]] IdType Extra() const {
    IdType id;
    id.value = extra;
    return id;
  }
};

/// One line of a program. Blank lines and comment lines are blocks without words.
struct Block {
  static constexpr std::uint32_t kNoNumber = 0xFFFFFFFFU;
  static constexpr std::uint8_t kNoSkip = 0xFF;

  OriginId origin;
  IdRange<WordId> words;
  IdRange<CommentId> comments;
  std::uint32_t number = kNoNumber;   // N word
  StringId label;                     // as written; invalid = none
  BlockId link;                       // structure marks: the partner that control goes to (see structure.h)
  std::uint16_t indent = 0;           // leading blanks as written
  std::uint8_t number_digits = 0;     // digits of the N word as written
  std::uint8_t skip_level = kNoSkip;  // leading `/`
  std::uint8_t flags = 0;             // Block::k*

  static constexpr std::uint8_t kMainBlock = 1;  // `:10` instead of `N10`
  static constexpr std::uint8_t kSkipDigit = 2;  // the level was written (`/0`)
  static constexpr std::uint8_t kAdded = 4;      // made by a pass (guard, safety line, frame of a tool change)
  static constexpr std::uint8_t kRefused = 8;    // holds a finding: never executed
};

/// Where a block came from. `via` leads to the call or the pass that made this copy.
struct Origin {
  FileId file;
  std::uint32_t line = 0;  // 1-based; 0 = made by the compiler
  OriginId via;
  std::uint32_t turn = 0;  // turn of the loop that made this copy
  StringId pass;           // pass that made it; invalid = the frontend
};

enum class CommentPlace : std::uint8_t { kOwnLine, kBeforeWord, kEndOfBlock };
/// Text without the language's marks. `word`: index inside the block for kBeforeWord. `gap`: blanks before it as
/// written.
struct Comment {
  StringId text;
  CommentPlace place = CommentPlace::kOwnLine;
  std::uint16_t word = 0;
  std::uint16_t gap = 0;
};

enum class Scope : std::uint8_t { kLocal, kParameter, kProgram /* main program, see Machine */, kChannel, kGlobal };

/// A named variable. Arrays have 1 to 3 dimensions; a STRING has its length besides.
struct Variable {
  StringId name;  // as written in its definition
  Type type = Type::kReal;
  Scope scope = Scope::kLocal;
  bool by_reference = false;
  std::uint8_t dimension_count = 0;
  std::uint8_t definition = 0;  // 0: first name of its DEF block, else it follows one
  std::uint32_t dimensions[3] = {0, 0, 0};
  std::uint32_t string_length = 0;
  ProgramId owner;                  // kLocal, kParameter, kProgram
  ExprId initial;                   // scalar start value or default argument; none = the type's zero
  AssignListId initial_list;        // SET(...) or (..) of an array
  ExprId lower_limit, upper_limit;  // LLI, ULI
  std::uint32_t line = 0;
  std::uint32_t begin = 0, length = 0;  // place of the name in that line
  FileId file;
};

enum class Lifetime : std::uint8_t { kCall, kProgram, kKept };
enum class Visibility : std::uint8_t { kLevel, kProgram, kAll };
enum class StartValue : std::uint8_t { kZero, kVacant, kKept, kUnknown };

/// A numbered variable space (R0.., #1.., L0..): cells `first` to `last`.
struct Space {
  StringId name;  // "R", "#", "L"
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  Type type = Type::kReal;
  Lifetime lifetime = Lifetime::kKept;
  Visibility visibility = Visibility::kAll;
  StartValue start = StartValue::kZero;
};

/// A system variable by its name or number, with what is known of it.
enum class SystemKind : std::uint8_t {
  kEnvironment,  // only the machine knows: Environment
  kPi,
  kProgrammedPosition,  // $P_EP[axis], #5001..: end point of the last block in workpiece coordinates
  kMachinePosition,     // #5021..
  kActiveFeed,
  kActiveSpeed,
  kActiveTool,      // in the spindle
  kProgrammedTool,  // of the last tool word, which may only stand ready
  kActiveEdge,
  kModalGroup,       // $P_GG[n], #4001..: code of the group, by Machine::groups
  kModalCallActive,  // $P_MC
  kPlaneAxis,        // $P_AXN1..3: abscissa, ordinate, applicate of the active plane
  kWasProgrammed,    // $P_SUBPAR[n]
  kProgramLevel,     // $P_STACK
  kUserMemory,       // $AC_MARKER[n], $AC_PARAM[n]: cells that programs write and read
};
struct System {
  StringId name;
  SystemKind kind = SystemKind::kEnvironment;
  Type type = Type::kReal;
  bool writable = false;
  std::uint32_t number = 0;  // first number for languages that number them
};

/// How a jump looks for its target inside its program.
enum class Search : std::uint8_t {
  kForward,               // from the next block to the end
  kBackward,              // from the jump block to the start
  kForwardThenBackward,   // to the end, then from the jump block toward the start
  kForwardThenFromStart,  // to the end, then from the start downward
  kBackwardThenForward,   // repeated parts
};
enum class TargetKind : std::uint8_t { kLabel, kNumber, kMainNumber, kExpression, kProgramStart };
struct Target {
  TargetKind kind = TargetKind::kLabel;
  StringId label;
  std::uint32_t number = 0;
  ExprId expr;  // kExpression: number or text
};
struct Jump {
  Target target;
  Search search = Search::kForward;
  bool quiet = false;  // no alarm when nothing is found (GOTOC)
};
/// One arm of a Switch; an arm without value is the default and stands last.
struct SwitchArm {
  ExprId value;
  JumpId jump;
};
struct Switch {
  std::uint32_t first_arm = 0;  // Module::switch_arms
  std::uint32_t arm_count = 0;
};

enum class CallForm : std::uint8_t {
  kName,        // SUB1(..), M98 P, G65 P: the program by its name
  kText,        // CALL "name", CALL var: name by expression
  kBlockRange,  // CALL .. BLOCK a TO b
  kPath,        // PCALL path
  kExternal,    // EXTCALL: from external memory
};
/// One argument. Positional ones count from 0; letters keep their letter. A missing one has no value.
struct Arg {
  ExprId value;
  std::uint16_t position = 0;
  char letter = 0;
  bool increments = false;  // as Word::kIncrements
};
struct Call {
  CallForm form = CallForm::kName;
  bool has_brackets = false;  // `SUB()` and `SUB` differ in print
  bool new_level = true;      // false: the callee shares the locals of the caller (M98)
  StringId name;              // as written
  ProgramId program;          // after name resolution; invalid = not found
  ExprId name_expr;           // kText
  IdRange<ArgId> args;
  ExprId passes;            // none = 1
  Target from, to;          // kBlockRange; kName with `from_block`: runs from `from` on
  bool from_block = false;  // no name: a block of the same program
};
/// `single`: only the block of `first`. `has_last`: up to `last`. Else up to the block before the RepeatPart word, or
/// up to the first block labelled `last.label` (an end label of the language) if one stands before that.
struct Part {
  Target first, last;
  bool single = false;  // REPEATB
  bool has_last = false;
};
struct For {
  ExprId variable;  // place that counts
  ExprId end;       // inclusive
  ExprId step;      // none = 1
};
struct Extern {
  StringId name;
  std::uint32_t first_param = 0;  // Module::extern_params
  std::uint32_t param_count = 0;
};
struct ExternParam {
  Type type = Type::kReal;
  bool by_reference = false;
  std::uint8_t dimension_count = 0;
  std::uint32_t dimensions[3] = {0, 0, 0};
  std::uint32_t string_length = 0;
};
/// Values for consecutive elements (SET, REP, bracket list). An invalid entry leaves its element unchanged.
struct AssignList {
  ExprId place;  // first element; invalid = the whole array from its start
  IdRange<ExprItemId> values;
  bool repeat = false;  // REP: one value for `count` elements (none = to the end)
  ExprId count;
};

enum class ProgramKind : std::uint8_t { kMain, kSub };
struct Program {
  StringId name;  // as the language calls it, without file marks
  ProgramKind kind = ProgramKind::kSub;
  FileId file;
  IdRange<BlockId> blocks;
  IdRange<VariableId> parameters;  // in order
  bool saves_modal_state = false;  // SAVE
  bool has_header = false;         // PROC or O line
  bool library = false;            // a standard cycle that ncport brings along
  std::uint32_t header_line = 0;
};

/// What a table row of a language calls a word, and the card row it stands in.
struct Spelling {
  StringId text;  // "G1", "DIAMON"
  StringId rule;  // "sinumerik-8.2"
};

// --- names of the closed lists, for dumps and messages
std::string_view NameOf(WordOp op);
std::string_view NameOf(ExprOp op);
std::string_view NameOf(Function function);
std::string_view NameOf(Type type);
ValueUse ValueUseOf(WordOp op);
Phase DefaultPhaseOf(WordOp op);
Operands OperandsOf(ExprOp op);
/// Smallest and largest number of arguments.
struct Arity {
  std::uint8_t least = 0, most = 0;
};
Arity ArityOf(Function function);
/// True for If .. EndFor: words that stand alone in their block and nest.
bool IsStructureMark(WordOp op);

}  // namespace ncport::ir
