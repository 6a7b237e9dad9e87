// The actions of Fanuc recipes. Expressions work on a stack of values: operands are made before what uses them. Words
// with a letter wait until the block is complete, because codes decide what letters mean.
#pragma once

#include <cstdint>

namespace ncport::frontend::fanuc {

enum class Step : std::uint8_t {
  // Values: push one.
  kNumber,    // first
  kCell,      // first; arg = 1: a place that is written
  kIndex,     // an index begins: ROUND in it gives whole numbers
  kCellAt,    // first .. last; pops the index
  kGroup,     // first .. last; pops one
  kUnary,     // arg = ExprOp, first = sign; pops one
  kBinary,    // arg = ExprOp; pops two
  kFunction,  // first .. last; pops `count` arguments; arg = 1: the second one behind a slash
  // Head of the block.
  kSkip,
  kBlockNumber,
  kProgramNumber,
  kProgramName,  // first
  // Words with a letter.
  kEnterWord,  // first: letter of the word that the next value belongs to
  kWord,       // first .. last; pops the value; arg = 1: expression without brackets
  kConstant,   // first
  kName,       // first
  kSkipRest,   // first
  // Statements.
  kAssign,  // first .. last; pops the value and the place
  kJump,    // first .. last; arg = JumpForm; count = 1: only if the value on the stack is true
  kOpen,
  kClose,       // first
  kPrintText,   // first
  kPrintValue,  // first .. last = format; pops the value
  kPrint,       // first .. last; pops `count` parts
  kWhen,        // first .. last; pops the condition; arg bits: kWhen*
  kMark,        // first .. last; arg = WordOp; count = token of the DO number or 0; pops a condition of If and While
};

enum class JumpForm : std::uint8_t {
  kNumber,  // last token is the number
  kValue,   // pops the target before the condition
};

inline constexpr std::uint8_t kWhenThen = 1;    // THEN was written
inline constexpr std::uint8_t kWhenBare = 2;    // no IF: [condition] M99 P10 (fanuc-13)
inline constexpr std::uint8_t kWhenClosed = 4;  // ENDIF in the same block

}  // namespace ncport::frontend::fanuc
