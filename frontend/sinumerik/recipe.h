// The actions of SINUMERIK recipes. Expressions work on a stack of values: operands are made before what uses them.
#pragma once

#include <cstdint>

namespace ncport::frontend::sinumerik {

enum class Step : std::uint8_t {
  // Values: push one.
  kNumber,    // first
  kText,      // first
  kBoolean,   // first
  kAxisName,  // first
  kCell,      // first
  kCellAt,    // first .. last; pops the index
  kName,      // first .. last; pops `count` indices
  kSystem,    // first .. last; pops `count` indices
  kGroup,     // first .. last; pops one
  kUnary,     // arg = ExprOp or kToText, first = operator; pops one
  kBinary,    // arg = ExprOp; pops two
  kFunction,  // first .. last; pops `count` arguments
  kMissing,   // an empty place of a list
  // Start of the block.
  kSkip,
  kBlockNumber,
  kMainNumber,
  kLabel,  // first
  // Words.
  kCode,            // first
  kConstant,        // first: axis or address with its value
  kMode,            // first: mode of the value of the next word
  kAxis,            // first .. last; pops the value
  kAxisAt,          // first .. last; pops the value and the axis
  kAddress,         // first .. last, arg = 1 with an index; pops the value and the index
  kComputedG,       // first .. last; pops the value
  kComputedM,       // first .. last, arg = 1 with an index; pops the value and the index
  kAssign,          // first .. last; pops the value and the place
  kAssignList,      // first .. last; pops `count` values and the place
  kAssignRepeated,  // first .. last; pops the count if `count` is 2, the value, the place
  // Jumps: a target waits for its jump.
  kTargetName,
  kTargetNumber,
  kTargetMainNumber,  // first
  kTargetValue,       // pops the value
  kTargetStart,       // program start
  kJump,     // first .. last, arg = 1 with a condition that it pops; arg bit 1 = GOTOS; count = token of the GOTO word
  kCaseArm,  // arg = 1: default; count = token of the GOTO word; pops the constant
  kCase,     // first .. last; pops the selector
  // Procedures.
  kMessage,         // first .. last; pops `count` arguments
  kAlarm,           // first .. last; pops `count` arguments
  kPreprocessStop,  // first .. last
  kWorkpiece,       // first .. last; pops `count` arguments
  kInertText,       // first .. last: kept as text
  kInertCall,       // first .. last: kept as text; pops `count` arguments
  kReturn,          // first .. last; pops `count` arguments
  // Structure marks.
  kMark,  // first .. last, arg = WordOp; pops `count` values
  kFor,   // first .. last; pops end, start, place
  // Calls. arg bits: kCall*.
  kCall,          // first = name, last; pops passes, `count` arguments
  kModalCall,     // first = name or MCALL, last; pops `count` arguments
  kTextCall,      // first .. last; pops passes, `count` arguments, the name
  kPathCall,      // first = path, last; pops passes, `count` arguments
  kExternalCall,  // first .. last; pops the name
  kRepeatPart,    // first .. last; pops passes
  // Definitions.
  kDef,          // first: DEF
  kDefScope,     // first
  kDefText,      // first .. last: attribute kept as text
  kDefTextDrop,  // as kDefText; pops the value
  kLowerLimit,
  kUpperLimit,       // pops the value
  kType,             // first
  kStringType,       // first, arg = 1: pops the length
  kDimension,        // pops one (maybe missing)
  kDeclare,          // first .. last; arg = Initializer; pops what it says
  kProgram,          // first = name
  kParameter,        // first .. last, arg bit 0 = VAR, bit 1 = default that it pops
  kProgramText,      // first: attribute
  kProgramEnd,       // first .. last
  kExtern,           // first = name
  kExternParameter,  // arg = 1: VAR
  kExternEnd,        // first .. last
  kMacro,            // first = name, last = first token of its text
};

/// ExprOp values end before it; `<<x` makes a text of one value.
inline constexpr std::uint8_t kToText = 0xFF;

inline constexpr std::uint8_t kCallBrackets = 1;
inline constexpr std::uint8_t kCallPasses = 2;  // passes on the stack
inline constexpr std::uint8_t kCallRange = 4;   // two targets wait
inline constexpr std::uint8_t kCallNamed =
    8;  // kTextCall: `first` is a name with arguments; kModalCall: not the cancelling form
inline constexpr std::uint8_t kCallWithName = 16;  // kTextCall: the name is on the stack
inline constexpr std::uint8_t kCallSubName = 32;   // kTextCall: `first` is an L name
inline constexpr std::uint8_t kPartSingle = 1;     // REPEATB
inline constexpr std::uint8_t kPartLast = 4;       // two targets wait

enum class Initializer : std::uint8_t {
  kNone,
  kValue,     // one value
  kList,      // `count` values
  kRepeated,  // value, and a count if `count` is 2
};

}  // namespace ncport::frontend::sinumerik
