// What a block begins with fixes the form of the rest: PROC, IF, REPEAT, CASE.
#include "frontend/sinumerik/syntax_hints.h"

namespace ncport::frontend::sinumerik {

bool SyntaxHints::Head() {
  if (at_ == 0 || at_ >= tokens_.size()) return false;
  switch (KindAt(First())) {
    case K::kProc:
      // `PROC SUB(REAL A) SAVE, DISPLOF`.
      return Kind() == K::kComma && OpenBrackets() == 0 && at_ > First() + 2 &&
             Say("the words behind PROC stand without commas between them");
    case K::kIf:
      return Conditional();
    case K::kRepeat:
    case K::kRepeatBlock:
      // `REPEAT P=3 BEGIN END`.
      return (Kind() == K::kPasses || Kind() == K::kPassesValue) && at_ == First() + 1 &&
             Say("P stands behind the labels: {} .. P=..", TextOf(First()));
    case K::kCase:
      // `CASE A OF 1 GOTOF B 2 C`.
      return Kind() == K::kName && Holds(K::kOf) && Before() == K::kNumber &&
             Say("GOTOF or GOTOB is missing between {} and {}", TextOf(at_ - 1), TextOf(at_));
    default:
      return false;
  }
}

// `IF A>B C=D`, `IF A>B G0 X10`: a statement behind a condition that is whole.
bool SyntaxHints::Conditional() {
  if (at_ < First() + 2 || !IsValue(Before()) || OpenBrackets() != 0) return false;
  const bool assignment = (Kind() == K::kName || Kind() == K::kCell) && KindAt(at_ + 1) == K::kEquals;
  const bool words = Kind() == K::kCode || Kind() == K::kAxisValue || Kind() == K::kAddressValue;
  if (!assignment && !words) return false;
  return Say("a condition has a block of its own: a block IF .., a block {}, a block ENDIF; only jumps stand behind it",
             assignment ? "with the assignment" : "with the words");
}

std::size_t SyntaxHints::OpenBrackets() const {
  std::size_t open = 0;
  for (std::size_t i = 0; i < at_ && i < tokens_.size(); ++i) {
    if (KindAt(i) == K::kLeftParen || KindAt(i) == K::kLeftBracket) ++open;
    if ((KindAt(i) == K::kRightParen || KindAt(i) == K::kRightBracket) && open > 0) --open;
  }
  return open;
}

}  // namespace ncport::frontend::sinumerik
