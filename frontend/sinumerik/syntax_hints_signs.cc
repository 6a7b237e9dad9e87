// Comparisons, brackets and signs of other languages.
#include <vector>

#include "frontend/sinumerik/syntax_hints.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

// `R3 GE R4`: the comparisons of other controls are words.
bool SyntaxHints::ForeignOperator() {
  if (Kind() != K::kName || !IsValue(Before())) return false;
  const ForeignOperatorWord* foreign = FindForeignOperator(TextOf(at_));
  if (foreign == nullptr) return false;
  Put(Code::kUnexpectedText, at_);
  return Say("{} is written {}", foreign->meaning, foreign->sign);
}

// `R1++`, `R1+=5`, `2**3`, `X10 // text`: signs of other languages.
bool SyntaxHints::ForeignSign() {
  if (at_ == 0) return false;
  for (const std::size_t token : {at_ - 1, at_}) {
    if (token + 1 >= tokens_.size()) continue;
    const K kind = KindAt(token);
    if (kind != KindAt(token + 1) || tokens_[token].End() != tokens_[token + 1].offset) continue;
    if (kind == K::kSlash) {
      Put(Code::kUnexpectedText, token);
      return Say("a comment begins with ;");
    }
    if (kind == K::kStar) return Say("there is no sign for powers: POT(..) is the square");
    const bool end = token + 2 >= tokens_.size();
    if (end && token > 0 && (kind == K::kPlus || kind == K::kMinus))
      return Say("a value is set with =: {}={}{}1", TextOf(token - 1), TextOf(token - 1), TextOf(token));
  }
  const bool sign = Kind() == K::kPlus || Kind() == K::kMinus || Kind() == K::kStar || Kind() == K::kSlash;
  if (sign && at_ == First() + 1 && KindAt(at_ + 1) == K::kEquals && tokens_[at_].End() == tokens_[at_ + 1].offset)
    return Say("a value is set with =: {}={}{}..", TextOf(at_ - 1), TextOf(at_ - 1), TextOf(at_));
  return false;
}

// `=` for `==` and the other way round; `=>`.
bool SyntaxHints::Comparison() {
  // `R2:=5`, `R2:5`: the sign of other languages; the colon makes a label.
  const bool colon = at_ > 0 && (Before() == K::kLabel || Before() == K::kColon);
  if (colon && Kind() == K::kEquals) {
    error_ = {.code = Code::kUnexpectedText,
              .begin = tokens_[at_].offset - 1,
              .length = tokens_[at_].End() - tokens_[at_].offset + 1};
    return Say("a value is set with = alone");
  }
  if (colon && Kind() == K::kNumber) {
    const std::string_view name = TextOf(at_ - 1);
    return Say("a value is set with =: {}={}", name.substr(0, name.find(':')), TextOf(at_));
  }
  // `IF [R3>5]`: brackets of other controls.
  if (Kind() == K::kLeftBracket && (Before() == K::kIf || Before() == K::kWhile || Before() == K::kUntil ||
                                    Before() == K::kEquals || Before() == K::kLeftParen || IsOperator(Before())))
    return Say("the brackets of an expression are round: (..); an index stands in []");
  const bool condition = Holds(K::kIf) || Holds(K::kWhile) || Holds(K::kUntil) || Holds(K::kCase);
  if ((Kind() == K::kEquals && (Before() == K::kGreater || Before() == K::kLess)) ||
      ((Kind() == K::kGreater || Kind() == K::kLess) && Before() == K::kEquals)) {
    return Say("did you mean {}=?", (Kind() == K::kGreater || Before() == K::kGreater) ? ">" : "<");
  }
  const K next = KindAt(at_ + 1);
  if (Kind() == K::kEquals && (next == K::kGreater || next == K::kLess))
    return Say("did you mean {}=?", next == K::kGreater ? ">" : "<");
  if (Kind() == K::kGreater && Before() == K::kLess) return Say("not equal is written <>, without a blank");
  if (Kind() == K::kEquals && condition) return Say("two values are compared with ==");
  if (Kind() == K::kEqualTo && !condition) return Say("a value is set with one =");
  if (Kind() == K::kEquals && at_ == First()) return Say("what gets the value is missing in front of =");
  return false;
}

// `A[0)`, `(1]`: the innermost open bracket is of the other form.
bool SyntaxHints::Closer() {
  if (Kind() != K::kRightParen && Kind() != K::kRightBracket) return false;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < at_; ++i) {
    if (KindAt(i) == K::kLeftParen || KindAt(i) == K::kLeftBracket) open.push_back(i);
    if ((KindAt(i) == K::kRightParen || KindAt(i) == K::kRightBracket) && !open.empty()) open.pop_back();
  }
  if (open.empty()) return Say("no bracket is open here");
  const bool round = KindAt(open.back()) == K::kLeftParen;
  if (round == (Kind() == K::kRightParen)) {
    if (open.back() + 1 == at_) return Say("the brackets are empty: a value is missing");
    return Gap();
  }
  Put(Code::kUnclosedBracket, open.back());
  return Say("{} is closed by {}", round ? "(" : "[", round ? ")" : "]");
}

}  // namespace ncport::frontend::sinumerik
