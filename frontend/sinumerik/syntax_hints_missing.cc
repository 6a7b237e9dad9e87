// Values, operators, commas and brackets that are missing.
#include <algorithm>
#include <vector>

#include "base/near_name.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/syntax_hints.h"

namespace ncport::frontend::sinumerik {

namespace words = dialects::sinumerik;

// What is missing in a head: `IF GOTOF A`, `DEF STRING A`, `M98 P1000`, `1ANF:`, `SCALE 2`.
bool SyntaxHints::Incomplete() {
  if (Before() == K::kIf && Kind() == K::kGoto) return Say("a condition is missing behind IF");
  if (Before() == K::kStringType && KindAt(First()) != K::kExtern)
    return Say("a STRING has its greatest length in []: STRING[20]");
  if (KindAt(First()) == K::kExtern && Before() == K::kType && Kind() == K::kName)
    return Say("EXTERN lists types alone, without names");
  if (at_ == First() && Before() != K::kLabel && Kind() == K::kNumber &&
      line_.substr(0, line_.find(';')).find(':') != std::string_view::npos)
    return Say("a label begins with two letters, or with _ and a letter");
  if (Kind() == K::kPassesValue || Kind() == K::kPasses) {
    for (std::size_t i = First(); i < at_; ++i) {
      if (KindAt(i) == K::kCode && IsWord(TextOf(i), "M98"))
        return Say("a subprogram is called by its name; P behind the name is the number of passes");
    }
  }
  return false;
}

// `SQTR(..)`: a name in front of a bracket inside an expression.
bool SyntaxHints::NoFunction() {
  if (Kind() != K::kLeftParen || Before() != K::kName || at_ - 1 == First()) return false;
  Put(Code::kUnknownName, at_ - 1);
  std::vector<std::string_view> names;
  for (const auto& row : words::Functions()) names.push_back(row.text);
  for (const auto& row : words::ValueModes()) names.push_back(row.text);
  const std::string_view near = NearName(TextOf(at_ - 1), names);
  if (!near.empty()) return Say("did you mean {}?", near);
  return Say("there is no such function; an array has its index in []");
}

bool SyntaxHints::NoBrackets() {
  if (Before() != K::kFunction) return false;
  return Say("{} takes its argument in brackets: {}(..)", TextOf(at_ - 1), TextOf(at_ - 1));
}

// `(A+B)(C-D)`, `MSG "A"`, `$P_EP(X)`: brackets and what stands in front of them.
bool SyntaxHints::NoOperator() {
  if (Kind() == K::kText && (Before() == K::kMessage || Before() == K::kSetAlarm))
    return Say("{} takes its values in brackets: {}({})", TextOf(at_ - 1), TextOf(at_ - 1), TextOf(at_));
  if (Before() == K::kMode && error_.code == Code::kExpectedText)
    return Say("{} takes its value in brackets: {}(..)", TextOf(at_ - 1), TextOf(at_ - 1));
  if (Kind() == K::kLeftParen && (Before() == K::kSystem || Before() == K::kCell)) return Say("an index stands in []");
  if (at_ > 0 && at_ < tokens_.size() && BetweenTokens().find('&') != std::string_view::npos)
    return Say("the word AND joins two conditions");
  if (Kind() == K::kLeftParen && (Before() == K::kRightParen || Before() == K::kNumber)) {
    if (LooksLikeComment()) return CommentMark();
    const bool blank = tokens_[at_ - 1].End() < tokens_[at_].offset;
    return Say("an operator is missing between {} and ({}", TextOf(at_ - 1),
               blank ? "; if a comment was meant, it begins with ;" : "");
  }
  if (Before() == K::kRightParen && Holds(K::kEquals) && (Kind() == K::kNumber || Kind() == K::kCell))
    return Say("an operator is missing between ) and {}", TextOf(at_));
  if (at_ > 1 && Before() == K::kCell && KindAt(at_ - 2) == K::kRightParen &&
      tokens_[at_ - 2].End() == tokens_[at_ - 1].offset) {
    Put(Code::kUnexpectedText, at_ - 1);
    return Say("an operator is missing between ) and {}", TextOf(at_ - 1));
  }
  if (InCall() && Kind() == K::kCode && (Before() == K::kLeftParen || Before() == K::kComma)) {
    Put(Code::kUnexpectedText, at_);
    return Say("{} is a word of the language; a text stands in quotes: \"{}\"", TextOf(at_), TextOf(at_));
  }
  if (InCall() && IsValue(Before()) && StartsValue(Kind()) && error_.code == Code::kExpectedText)
    return Say("a comma is missing between {} and {}", TextOf(at_ - 1), TextOf(at_));
  if (Kind() == K::kFunction && (Before() == K::kNumber || Before() == K::kCell || Before() == K::kRightParen))
    return Say("an operator is missing between {} and {}", TextOf(at_ - 1), TextOf(at_));
  // `"PART "<<R5" OF "`: two parts of a text.
  const bool texts = Holds(K::kMessage) || Holds(K::kConcat);
  if (texts && ((Kind() == K::kText && IsValue(Before())) || (Before() == K::kText && StartsValue(Kind()))))
    return Say("<< is missing between {} and {}", TextOf(at_ - 1), TextOf(at_));
  const bool number = Before() == K::kNumber || Before() == K::kAxisValue || Before() == K::kAddressValue;
  return Kind() == K::kNumber && number && error_.code == Code::kUnexpectedText &&
         tokens_[at_ - 1].End() < tokens_[at_].offset && Say("a number holds no blank; a word begins with its letter");
}

/// True in the brackets of a call, which hold a list.
bool SyntaxHints::InCall() const {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < std::min(at_, tokens_.size()); ++i) {
    if (KindAt(i) == K::kLeftParen) open.push_back(i);
    if (KindAt(i) == K::kRightParen && !open.empty()) open.pop_back();
  }
  if (open.size() != 1 || open[0] == 0) return false;
  const K callee = KindAt(open[0] - 1);
  return open[0] - 1 >= First() && (callee == K::kName || callee == K::kSubName) &&
         (open[0] - 1 == First() || KindAt(open[0] - 2) == K::kModalCall);
}

std::string_view SyntaxHints::BetweenTokens() const {
  const std::uint32_t end = tokens_[at_ - 1].End();
  return line_.substr(end, tokens_[at_].offset - end);
}

// `G2 X20 R5`, `X=R1 R2`: an R parameter that neither gets a value nor gives one.
bool SyntaxHints::LooseCell() {
  if (Before() != K::kCell || error_.code != Code::kExpectedText || error_.detail == nullptr ||
      std::string_view(error_.detail) != "=" || Kind() == K::kEqualTo)
    return false;
  const std::string_view cell = TextOf(at_ - 1);
  const bool value_before =
      at_ > 1 && IsValue(KindAt(at_ - 2)) && KindAt(at_ - 2) != K::kAxisValue && KindAt(at_ - 2) != K::kAddressValue;
  if (IsOperator(Kind()) || at_ < 2) return false;
  bool arc = false;
  for (std::size_t i = 0; i < at_; ++i) {
    const std::string_view text = TextOf(i);
    arc = arc || (KindAt(i) == K::kCode &&
                  (IsWord(text, "G2") || IsWord(text, "G3") || IsWord(text, "G02") || IsWord(text, "G03")));
  }
  const std::string_view before = TextOf(at_ - 2);
  Put(Code::kUnexpectedText, at_ - 1);
  if (arc && !value_before)
    return Say("{} is an R parameter; the radius of an arc is written CR={}", cell, cell.substr(1));
  if (value_before) return Say("an operator is missing between {} and {}", before, cell);
  return Say("{} is an R parameter: it gets a value with =", cell);
}

// A value is missing between two signs.
bool SyntaxHints::Gap() {
  if (Kind() == K::kComma) {
    if (Before() == K::kComma) return Say("a value is missing between the commas");
    const bool digit = at_ + 1 < tokens_.size() && KindAt(at_ + 1) == K::kNumber && !Holds(K::kFor);
    if (digit && (Before() == K::kAxisValue || Before() == K::kAddressValue || Before() == K::kNumber))
      return Say("the decimal sign is a point");
    return false;
  }
  const bool operator_before = IsOperator(Before()) || Before() == K::kEquals;
  if (!operator_before) {
    // The parser may stop at the operator in front of the gap.
    if (!IsOperator(Kind())) return false;
    if (at_ + 1 >= tokens_.size()) return Say("a value is missing behind {}", TextOf(at_));
    if (IsOperator(KindAt(at_ + 1)) && !StartsValue(KindAt(at_ + 1)))
      return Say("a value is missing between {} and {}", TextOf(at_), TextOf(at_ + 1));
    return false;
  }
  if (IsOperator(Kind())) return Say("a value is missing between {} and {}", TextOf(at_ - 1), TextOf(at_));
  return !StartsValue(Kind()) && Say("a value is missing behind {}", TextOf(at_ - 1));
}

// `X Y10`: an axis letter with neither a value nor `=`.
bool SyntaxHints::MissingValue() {
  if (error_.code != Code::kExpectedText || Before() != K::kAxis || error_.detail == nullptr) return false;
  if (std::string_view(error_.detail) != "=" || IsOperator(Kind()) || Kind() == K::kLeftParen) return false;
  if (Kind() == K::kNumber || Kind() == K::kName || Kind() == K::kCell || Kind() == K::kFunction) return false;
  return Put(Code::kMissingValue, at_ - 1);
}

}  // namespace ncport::frontend::sinumerik
