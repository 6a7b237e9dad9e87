#include "frontend/sinumerik/hints.h"

#include "frontend/sinumerik/syntax_hints.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

void SyntaxHints::Run() {
  // Each looks for one kind of slip; the first that fits has the word.
  (void)(GroupIndex() || TornNumber() || LettersInNumber() || LettersBehindSign() || JumpWithoutBlank() ||
         RunTogether() || Head() || NewName() || TornName() || MissingType() || ForeignOperator() || Dwell() ||
         Incomplete() || ForeignSign() || Comparison() || NoFunction() || NoBrackets() || LooseCell() || NoOperator() ||
         Closer() || Gap() || SecondSign() || MissingValue() || ForeignName() || TornWord() || ColonOfLabel() ||
         Statement() || InnerWord() || CommentMark());
  if (!help_.empty()) error_.help = help_.c_str();
}

bool SyntaxHints::IsValue(K kind) {
  switch (kind) {
    case K::kNumber:
    case K::kText:
    case K::kBoolean:
    case K::kName:
    case K::kCell:
    case K::kRightParen:
    case K::kRightBracket:
    case K::kAxisValue:
    case K::kAddressValue:
      return true;
    default:
      return false;
  }
}

bool SyntaxHints::IsOperator(K kind) {
  return kind >= K::kEqualTo && kind <= K::kConcat && kind != K::kNot && kind != K::kBitNot;
}

bool SyntaxHints::StartsValue(K kind) {
  switch (kind) {
    case K::kNumber:
    case K::kText:
    case K::kBoolean:
    case K::kName:
    case K::kCell:
    case K::kCellAt:
    case K::kSystem:
    case K::kFunction:
    case K::kMode:
    case K::kAxis:
    case K::kAxisValue:
    case K::kLeftParen:
    case K::kSet:
    case K::kRep:
    case K::kMinus:
    case K::kPlus:
    case K::kNot:
    case K::kBitNot:
    case K::kConcat:
      return true;
    default:
      return false;
  }
}

void ExplainSyntax(std::span<const Token> tokens, std::size_t at, std::string_view line, LineError& error,
                   std::string& help) {
  help.clear();
  if (ExplainJumpWithZeros(line, error, help)) return;
  SyntaxHints(tokens, at, line, error, help).Run();
  if (help.empty()) ExplainComment(tokens, line, error, help);
}

}  // namespace ncport::frontend::sinumerik
