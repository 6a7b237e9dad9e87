// Words that are no words of the language, or are torn, run together or out of their place.
#include "frontend/common/chars.h"
#include "frontend/sinumerik/syntax_hints.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

// `G[8]=2`: the word of a group by its index.
bool SyntaxHints::GroupIndex() {
  // `X[1]=5`: the axis by its number.
  if ((Before() != K::kComputedG && Before() != K::kAxis) || Kind() != K::kLeftBracket) return false;
  return Put(Code::kNotSupported, at_ - 1);
}

// `IF R1<R2 GOTOFREADY`: the jump word and its label run into one name.
bool SyntaxHints::JumpWithoutBlank() {
  if (Kind() != K::kName || !IsValue(Before())) return false;
  const std::string split = AsJumpAndLabel(TextOf(at_));
  if (split.empty()) return false;
  Put(Code::kUnknownWord, at_);
  return Say("a blank is missing: {}", split);
}

// `IFR1>3`, `ENDIFG0`, `DEFREAL A_B`, `R1 ANDR2`: a word of the language and what follows run into one name.
bool SyntaxHints::RunTogether() {
  const auto missing = [&](std::size_t token, const std::string& split) {
    if (split.empty()) return false;
    Put(Code::kUnknownWord, token);
    return Say("a blank is missing: {}", split);
  };
  const std::size_t first = First();
  if (KindAt(first) == K::kName && at_ > first) {
    Behind behind = Behind::kAnything;
    if (Kind() >= K::kEqualTo && Kind() <= K::kGreaterEqual) behind = Behind::kComparison;
    if (Kind() == K::kTo) behind = Behind::kTo;
    if (Kind() == K::kOf) behind = Behind::kOf;
    if (Kind() == K::kType || Kind() == K::kStringType) behind = Behind::kType;
    if (missing(first, AsRunTogether(TextOf(first), behind))) return true;
  }
  return Kind() == K::kName && IsValue(Before()) && missing(at_, AsRunTogetherInside(TextOf(at_)));
}

// `G4 P500`, `G4 U2`: the letters of other controls for the time.
bool SyntaxHints::Dwell() {
  if (at_ >= tokens_.size()) return false;
  for (std::size_t i = First(); i < at_; ++i) {
    if (KindAt(i) != K::kCode || !(IsWord(TextOf(i), "G4") || IsWord(TextOf(i), "G04"))) continue;
    Put(Code::kUnexpectedText, at_);
    return Say("the time of a dwell stands behind F (seconds) or S (turns of the spindle)");
  }
  return false;
}

// A word of another language, where it is the wrong one or stands in front of it.
bool SyntaxHints::ForeignName() {
  for (const std::size_t token : {at_, at_ - 1}) {
    if (token >= tokens_.size() || (KindAt(token) != K::kName && KindAt(token) != K::kSubName)) continue;
    const ForeignWord* foreign = FindForeignWord(TextOf(token));
    if (foreign == nullptr) continue;
    Put(Code::kUnknownWord, token);
    return Say("{}", foreign->help);
  }
  return false;
}

// `END IF`, `GOTO F`: one word, torn by a blank.
bool SyntaxHints::TornWord() {
  const std::size_t first = First();
  if (at_ != first + 1 || at_ >= tokens_.size() || KindAt(first) != K::kName || !IsWord(TextOf(first), "END"))
    return false;
  std::string_view meant;
  switch (Kind()) {
    case K::kIf:
      meant = "ENDIF";
      break;
    case K::kWhile:
      meant = "ENDWHILE";
      break;
    case K::kFor:
      meant = "ENDFOR";
      break;
    case K::kLoop:
      meant = "ENDLOOP";
      break;
    default:
      return false;
  }
  error_ = {
      .code = Code::kUnknownWord, .begin = tokens_[first].offset, .length = tokens_[at_].End() - tokens_[first].offset};
  return Say("{} is one word, without a blank", meant);
}

// `GOTOF NAME:`.
bool SyntaxHints::ColonOfLabel() {
  if (Kind() != K::kColon || at_ < 2 || KindAt(at_ - 2) != K::kGoto) return false;
  return Say("a jump names its label without the colon");
}

// A name inside of a block that is nearly a word: `ADN`, `GOTFO`.
bool SyntaxHints::InnerWord() {
  for (const std::size_t token : {at_, at_ - 1}) {
    if (token >= tokens_.size() || KindAt(token) != K::kName || token == First()) continue;
    std::string_view near = NearInnerWord(TextOf(token));
    if (near.empty() && error_.code == Code::kNotAlone) near = NearCodeWord(TextOf(token));
    if (near.empty() || (token != at_ && error_.code != Code::kNotAlone && !IsOperator(Kind()))) continue;
    Put(Code::kUnknownWord, token);
    return Say("did you mean {}?", near);
  }
  if (error_.code == Code::kNotAlone && Kind() == K::kName && at_ + 1 == tokens_.size())
    return Say(
        "a name at the end of a block does nothing: a comment begins with ;, a subprogram call has a block of "
        "its own, a variable is set with =");
  return false;
}

// A block that begins with a name which no `=` follows: a misspelled word, a label without colon, an address.
bool SyntaxHints::Statement() {
  const bool stands_alone = error_.code == Code::kNotAlone;
  std::size_t name = First();
  if (stands_alone) {
    while (name < tokens_.size() && tokens_[name].offset != error_.begin) ++name;
  } else if (at_ != name + 1) {
    return false;
  }
  if (KindAt(name) != K::kName) return false;
  const std::string_view text = TextOf(name);
  if (const std::string number = AsNumberWord(text); !number.empty()) {
    Put(Code::kUnknownWord, name);
    return Say("did you mean {}?", number);
  }
  if (const std::string whole = AsAddressWithValue(text); !whole.empty()) {
    Put(Code::kExpectedText, name, "=");
    return Say("an address of several letters has its value behind =: {}", whole);
  }
  if (text.size() > 2 && text.size() < 6 && (text[1] == 'R' || text[1] == 'r') && IsDigit(text[2])) {
    Put(Code::kExpectedText, name, "=");
    ++error_.begin;
    --error_.length;
    return Say("an address and an expression are written with =: {}={}", text.substr(0, 1), text.substr(1));
  }
  if (const std::string_view near = NearStatementWord(text); !near.empty()) {
    Put(Code::kUnknownWord, name);
    return Say("did you mean {}?", near);
  }
  if (name == First() && !stands_alone &&
      (Kind() == K::kCode || Kind() == K::kAxisValue || Kind() == K::kAddressValue)) {
    Put(Code::kUnknownWord, name);
    return Say("a label ends with a colon: {}:", text);
  }
  return false;
}

// `(ROUGHING)` in front of a block, behind its words or alone.
bool SyntaxHints::CommentMark() {
  if (Kind() != K::kLeftParen) return false;
  if (at_ != First() && !IsCompleteWord(Before()) && !LooksLikeComment()) return false;
  return Say("a comment begins with ; and brackets hold expressions");
}

/// A word behind which no bracket can go on.
bool SyntaxHints::IsCompleteWord(K kind) {
  return kind == K::kCode || kind == K::kAxisValue || kind == K::kAddressValue || kind == K::kText;
}

/// A blank in front of the bracket, and up to the end of the line nothing but words without an operator between them.
bool SyntaxHints::LooksLikeComment() const {
  if (at_ == 0 || tokens_[at_ - 1].End() == tokens_[at_].offset) return false;
  const std::string_view inside = line_.substr(tokens_[at_].End());
  const std::size_t end = inside.find(')');
  if (end == std::string_view::npos || inside.find_first_not_of(" \t\r", end + 1) != std::string_view::npos)
    return false;
  bool word = false;
  bool blank = false;
  for (const char c : inside.substr(0, end)) {
    if (IsLetter(c) || IsDigit(c)) {
      if (word && blank) return true;
      word = true;
      blank = false;
    } else if (c == ' ') {
      blank = word;
    } else if (c != '_' && c != '.') {
      return false;
    }
  }
  return false;
}

}  // namespace ncport::frontend::sinumerik
