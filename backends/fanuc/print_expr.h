// Expressions of Fanuc Custom Macro B as text. Brackets are written where the order of operations needs them
// (fanuc-4.1) and round AND, OR, XOR always; brackets of the source that say nothing are left out, since five levels
// are all there is.
#pragma once

#include "base/text_buffer.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::backends::fanuc {

/// Where a number without point means a plain real, and where it would count increments (fanuc-2.2).
enum class NumberPlace : std::uint8_t {
  kMacro,    // statements and conditions: 5 is five
  kWord,     // value of a length, angle or feed word: always with a point
  kInteger,  // M S T H D P L N: never with a point
};

class ExprPrinter {
 public:
  ExprPrinter(const ir::Module& module, const dialects::Profile& profile, TextBuffer& out)
      : module_(module), profile_(profile), out_(out) {}

  /// Behind `=`, or inside the brackets of a condition.
  void Statement(ir::ExprId expr) { Print(expr, 0, NumberPlace::kMacro); }
  /// Behind an address letter: a number, `#n`, `-#n`, or brackets.
  void WordValue(ir::ExprId expr, NumberPlace place);

 private:
  void Print(ir::ExprId expr, int level, NumberPlace place);
  void PrintLiteral(const ir::Expr& expr, NumberPlace place, bool inside);
  void PrintFunction(const ir::Expr& expr, NumberPlace place);

  const ir::Module& module_;
  const dialects::Profile& profile_;
  TextBuffer& out_;
};

/// Levels of brackets that printing the expression as a statement, or as the value of a word, opens (fanuc-4.2).
int BracketDepth(const ir::Module& module, ir::ExprId expr, bool in_word);

}  // namespace ncport::backends::fanuc
