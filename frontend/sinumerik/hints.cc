#include "frontend/sinumerik/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/near_name.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/token_kind.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

namespace {

using diag::Code;
using K = TokenKind;
namespace words = dialects::sinumerik;

class Hints {
 public:
  Hints(std::span<const Token> tokens, std::size_t at, std::string_view line, LineError& error, std::string& help)
      : tokens_(tokens), at_(at), line_(line), error_(error), help_(help) {}

  void Run() {
    // Each looks for one kind of slip; the first that fits has the word.
    (void)(GroupIndex() || TornNumber() || LettersInNumber() || LettersBehindSign() || JumpWithoutBlank() ||
           NewName() || TornName() || MissingType() || ForeignOperator() || Dwell() || Incomplete() || ForeignSign() ||
           Comparison() || NoFunction() || NoBrackets() || LooseCell() || NoOperator() || Closer() || Gap() ||
           SecondSign() || MissingValue() || ForeignName() || TornWord() || ColonOfLabel() || Statement() ||
           InnerWord() || CommentMark());
    if (!help_.empty()) error_.help = help_.c_str();
  }

 private:
  [[nodiscard]] K KindAt(std::size_t token) const {
    return token < tokens_.size() ? static_cast<K>(tokens_[token].kind) : K::kNone;
  }
  [[nodiscard]] K Kind() const { return KindAt(at_); }
  [[nodiscard]] K Before() const { return at_ == 0 ? K::kNone : KindAt(at_ - 1); }
  [[nodiscard]] std::string_view TextOf(std::size_t token) const {
    return line_.substr(tokens_[token].offset, tokens_[token].length);
  }
  /// First token behind skip mark, block number and label.
  [[nodiscard]] std::size_t First() const {
    std::size_t first = 0;
    while (KindAt(first) == K::kSkip || KindAt(first) == K::kBlockNumber || KindAt(first) == K::kMainNumber ||
           KindAt(first) == K::kLabel)
      ++first;
    return first;
  }
  [[nodiscard]] bool Holds(K kind) const {
    for (std::size_t i = 0; i < std::min(at_, tokens_.size()); ++i) {
      if (KindAt(i) == kind) return true;
    }
    return false;
  }
  bool Put(Code code, std::size_t token, const char* detail = nullptr) {
    error_.code = code;
    error_.begin = tokens_[token].offset;
    error_.length = tokens_[token].length;
    error_.detail = detail;
    return true;
  }
  template <class... Args>
  bool Say(fmt::format_string<Args...> text, Args&&... args) {
    help_ = fmt::format(text, std::forward<Args>(args)...);
    return true;
  }
  static bool IsValue(K kind) {
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
  static bool IsOperator(K kind) {
    return kind >= K::kEqualTo && kind <= K::kConcat && kind != K::kNot && kind != K::kBitNot;
  }

  // `G[8]=2`: the word of a group by its index.
  bool GroupIndex() {
    // `X[1]=5`: the axis by its number.
    if ((Before() != K::kComputedG && Before() != K::kAxis) || Kind() != K::kLeftBracket) return false;
    return Put(Code::kNotSupported, at_ - 1);
  }

  // `10.5.2`: the second point begins a number of its own.
  bool TornNumber() {
    if (at_ == 0 || at_ >= tokens_.size() || !TextOf(at_).starts_with('.')) return false;
    const Token& before = tokens_[at_ - 1];
    if (before.End() != tokens_[at_].offset || !IsValue(Before())) return false;
    error_ = {.code = Code::kBadNumber, .begin = before.offset, .length = tokens_[at_].End() - before.offset};
    if (Before() == K::kCell)
      return Say("the number of an R parameter is whole; is a comma meant: {},{}?", TextOf(at_ - 1),
                 TextOf(at_).substr(1));
    return Say("a number has one decimal point");
  }

  // `F2OO`, `=2OOO`: letters that stand for digits go on where the number ends.
  bool LettersInNumber() {
    std::size_t letters = at_;
    if (error_.code == Code::kNotAlone) letters = TokenAt(error_.begin);
    if (letters == 0 || letters >= tokens_.size()) return false;
    const Token& before = tokens_[letters - 1];
    const std::string_view text = TextOf(letters);
    const bool number = KindAt(letters - 1) == K::kNumber || KindAt(letters - 1) == K::kAxisValue ||
                        KindAt(letters - 1) == K::kAddressValue || KindAt(letters - 1) == K::kCell;
    if (!number || before.End() != tokens_[letters].offset || !LooksLikeNumber(text)) return false;
    const std::string_view whole = line_.substr(before.offset, tokens_[letters].End() - before.offset);
    error_ = {.code = Code::kBadNumber, .begin = before.offset, .length = static_cast<std::uint32_t>(whole.size())};
    return Say("did you mean {}{}?", TextOf(letters - 1), AsDigits(text));
  }
  [[nodiscard]] std::size_t TokenAt(std::uint32_t offset) const {
    std::size_t token = 0;
    while (token < tokens_.size() && tokens_[token].offset != offset) ++token;
    return token;
  }

  // `Z-l5`, `R1=-I0`: a letter for the first digit behind a sign begins a word of its own.
  bool LettersBehindSign() {
    std::size_t letters = at_;
    if (Kind() == K::kMinus || Kind() == K::kPlus) ++letters;
    if (letters == 0 || letters >= tokens_.size()) return false;
    const Token& sign = tokens_[letters - 1];
    const K kind = KindAt(letters - 1);
    const std::string_view text = TextOf(letters);
    if ((kind != K::kMinus && kind != K::kPlus) || sign.End() != tokens_[letters].offset || !LooksLikeNumber(text) ||
        std::all_of(text.begin(), text.end(), IsDigit))
      return false;
    std::size_t first = letters - 1;
    const K before = first == 0 ? K::kNone : KindAt(first - 1);
    if ((before == K::kAxis || before == K::kAddress) && tokens_[first - 1].End() == sign.offset) --first;
    const std::string_view head = line_.substr(tokens_[first].offset, sign.End() - tokens_[first].offset);
    error_ = {.code = Code::kBadNumber,
              .begin = tokens_[first].offset,
              .length = tokens_[letters].End() - tokens_[first].offset};
    return Say("did you mean {}{}?", head, AsDigits(text));
  }

  // `IF R1<R2 GOTOFREADY`: the jump word and its label run into one name.
  bool JumpWithoutBlank() {
    if (Kind() != K::kName || !IsValue(Before())) return false;
    const std::string split = AsJumpAndLabel(TextOf(at_));
    if (split.empty()) return false;
    Put(Code::kUnknownWord, at_);
    return Say("a blank is missing: {}", split);
  }

  // A word of the language, or a number, where a new name stands.
  bool NewName() {
    if (error_.code != Code::kExpectedText || error_.detail == nullptr || at_ >= tokens_.size() ||
        std::string_view(error_.detail) != "a name")
      return false;
    const std::string_view text = TextOf(at_);
    if (text.size() > 1 && std::all_of(text.begin(), text.end(), [](char c) { return IsLetter(c) || c == '_'; })) {
      error_.code = Code::kReservedName;
      error_.detail = nullptr;
      return true;
    }
    if (Kind() == K::kComma) return Say("a name is missing in front of the comma");
    const std::size_t behind = tokens_[at_].offset + tokens_[at_].length;
    if (text.find('$') != std::string_view::npos || (behind < line_.size() && line_[behind] == '$'))
      return Say("a name holds letters, digits and _; $ stands in front of system variables");
    return Say("a name begins with two letters, or with _ and a letter");
  }

  // `DEF INT A-B`, `DEF INT A B`: signs inside a name, or a comma that is missing.
  bool TornName() {
    const K first = KindAt(First());
    if (first != K::kDef || Before() != K::kName || Holds(K::kEquals) || at_ >= tokens_.size()) return false;
    if (IsOperator(Kind())) return Say("a name holds letters, digits and _");
    if (Kind() == K::kNumber || Kind() == K::kText || Kind() == K::kBoolean)
      return Say("a start value stands behind =: {}={}", TextOf(at_ - 1), TextOf(at_));
    if (TextOf(at_).starts_with('$'))
      return Say("a name holds letters, digits and _; $ stands in front of system variables");
    return StartsValue(Kind()) && Kind() != K::kLeftParen && Say("a comma stands between two names");
  }

  // `DEF INTEGER A`, `PROC P(A)`: a name where the type stands.
  bool MissingType() {
    const K first = KindAt(First());
    if (Kind() != K::kName) return false;
    const bool definition = first == K::kDef && !Holds(K::kType) && !Holds(K::kStringType) && !Holds(K::kEquals);
    const bool parameter =
        first == K::kProc && (Before() == K::kLeftParen || Before() == K::kComma || Before() == K::kVar);
    if (!definition && !parameter) return false;
    Put(Code::kExpectedText, at_, "a type");
    std::vector<std::string_view> types;
    for (const auto& row : words::Types()) types.push_back(row.text);
    std::string_view near = NearName(TextOf(at_), types);
    for (const std::string_view type : types) {
      if (near.empty() && type.size() > 2 && IsWord(TextOf(at_).substr(0, type.size()), type)) near = type;
    }
    if (!near.empty()) return Say("did you mean {}?", near);
    return Say("the types are INT, REAL, BOOL, CHAR, STRING[n], AXIS, FRAME");
  }

  // `R3 GE R4`: the comparisons of other controls are words.
  bool ForeignOperator() {
    if (Kind() != K::kName || !IsValue(Before())) return false;
    const ForeignOperatorWord* foreign = FindForeignOperator(TextOf(at_));
    if (foreign == nullptr) return false;
    Put(Code::kUnexpectedText, at_);
    return Say("{} is written {}", foreign->meaning, foreign->sign);
  }

  // `G4 P500`, `G4 U2`: the letters of other controls for the time.
  bool Dwell() {
    if (at_ >= tokens_.size()) return false;
    for (std::size_t i = First(); i < at_; ++i) {
      if (KindAt(i) != K::kCode || !(IsWord(TextOf(i), "G4") || IsWord(TextOf(i), "G04"))) continue;
      Put(Code::kUnexpectedText, at_);
      return Say("the time of a dwell stands behind F (seconds) or S (turns of the spindle)");
    }
    return false;
  }

  // `R1++`, `R1+=5`, `2**3`, `X10 // text`: signs of other languages.
  bool ForeignSign() {
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

  // What is missing in a head: `IF GOTOF A`, `DEF STRING A`, `M98 P1000`, `1ANF:`, `SCALE 2`.
  bool Incomplete() {
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

  // `=` for `==` and the other way round; `=>`.
  bool Comparison() {
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

  // `SQTR(..)`: a name in front of a bracket inside an expression.
  bool NoFunction() {
    if (Kind() != K::kLeftParen || Before() != K::kName || at_ - 1 == First()) return false;
    Put(Code::kUnknownName, at_ - 1);
    std::vector<std::string_view> names;
    for (const auto& row : words::Functions()) names.push_back(row.text);
    for (const auto& row : words::ValueModes()) names.push_back(row.text);
    const std::string_view near = NearName(TextOf(at_ - 1), names);
    if (!near.empty()) return Say("did you mean {}?", near);
    return Say("there is no such function; an array has its index in []");
  }

  bool NoBrackets() {
    if (Before() != K::kFunction) return false;
    return Say("{} takes its argument in brackets: {}(..)", TextOf(at_ - 1), TextOf(at_ - 1));
  }

  // `(A+B)(C-D)`, `MSG "A"`, `$P_EP(X)`: brackets and what stands in front of them.
  bool NoOperator() {
    if (Kind() == K::kText && (Before() == K::kMessage || Before() == K::kSetAlarm))
      return Say("{} takes its values in brackets: {}({})", TextOf(at_ - 1), TextOf(at_ - 1), TextOf(at_));
    if (Before() == K::kMode && error_.code == Code::kExpectedText)
      return Say("{} takes its value in brackets: {}(..)", TextOf(at_ - 1), TextOf(at_ - 1));
    if (Kind() == K::kLeftParen && (Before() == K::kSystem || Before() == K::kCell))
      return Say("an index stands in []");
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
           tokens_[at_ - 1].End() < tokens_[at_].offset &&
           Say("a number holds no blank; a word begins with its letter");
  }

  [[nodiscard]] std::string_view BetweenTokens() const {
    const std::uint32_t end = tokens_[at_ - 1].End();
    return line_.substr(end, tokens_[at_].offset - end);
  }
  /// True in the brackets of a call, which hold a list.
  [[nodiscard]] bool InCall() const {
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

  // `G2 X20 R5`, `X=R1 R2`: an R parameter that neither gets a value nor gives one.
  bool LooseCell() {
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

  // `A[0)`, `(1]`: the innermost open bracket is of the other form.
  bool Closer() {
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

  // A value is missing between two signs.
  bool Gap() {
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
  static bool StartsValue(K kind) {
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

  // `Z--2`: two signs in front of a number.
  bool SecondSign() {
    if (at_ == 0 || at_ >= tokens_.size() || tokens_[at_ - 1].End() != tokens_[at_].offset) return false;
    const K next = KindAt(at_ + 1);
    if (IsOperator(Kind()) && (Before() == K::kAxisValue || Before() == K::kAddressValue) && StartsValue(next)) {
      const std::string_view word = TextOf(at_ - 1);
      return Say("a value that is computed stands behind =: {}={}{}{}", word.substr(0, 1), word.substr(1), TextOf(at_),
                 TextOf(at_ + 1));
    }
    if (Kind() != K::kMinus && Kind() != K::kPlus) return false;
    if (Before() != K::kAxis && Before() != K::kAddress) return false;
    error_.code = Code::kUnexpectedText;
    error_.detail = nullptr;
    if (next == K::kMinus || next == K::kPlus) return Say("a number has one sign");
    if (!StartsValue(next)) return Say("a value is missing behind {}", TextOf(at_));
    return Say("a value that is computed stands behind =");
  }

  // `X Y10`: an axis letter with neither a value nor `=`.
  bool MissingValue() {
    if (error_.code != Code::kExpectedText || Before() != K::kAxis || error_.detail == nullptr) return false;
    if (std::string_view(error_.detail) != "=" || IsOperator(Kind()) || Kind() == K::kLeftParen) return false;
    if (Kind() == K::kNumber || Kind() == K::kName || Kind() == K::kCell || Kind() == K::kFunction) return false;
    return Put(Code::kMissingValue, at_ - 1);
  }

  // A word of another language, where it is the wrong one or stands in front of it.
  bool ForeignName() {
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
  bool TornWord() {
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
    error_ = {.code = Code::kUnknownWord,
              .begin = tokens_[first].offset,
              .length = tokens_[at_].End() - tokens_[first].offset};
    return Say("{} is one word, without a blank", meant);
  }

  // `GOTOF NAME:`.
  bool ColonOfLabel() {
    if (Kind() != K::kColon || at_ < 2 || KindAt(at_ - 2) != K::kGoto) return false;
    return Say("a jump names its label without the colon");
  }

  // A name inside of a block that is nearly a word: `ADN`, `GOTFO`.
  bool InnerWord() {
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
  bool Statement() {
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
  bool CommentMark() {
    if (Kind() != K::kLeftParen) return false;
    if (at_ != First() && !IsCompleteWord(Before()) && !LooksLikeComment()) return false;
    return Say("a comment begins with ; and brackets hold expressions");
  }
  /// A word behind which no bracket can go on.
  static bool IsCompleteWord(K kind) {
    return kind == K::kCode || kind == K::kAxisValue || kind == K::kAddressValue || kind == K::kText;
  }
  /// A blank in front of the bracket, and up to the end of the line nothing but words without an operator between them.
  [[nodiscard]] bool LooksLikeComment() const {
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

  std::span<const Token> tokens_;
  std::size_t at_;
  std::string_view line_;
  LineError& error_;
  std::string& help_;
};

/// `G0TOF`, `G0T0B`: a jump word with zeros for its letters O falls apart into G0 and what follows. Moves the error to
/// the word and names the jump.
bool JumpWithZeros(std::string_view line, LineError& error, std::string& help) {
  const auto in_word = [&](std::size_t i) { return i < line.size() && (IsLetter(line[i]) || IsDigit(line[i])); };
  std::size_t begin = std::min<std::size_t>(error.begin, line.size());
  while (begin > 0 && in_word(begin - 1)) --begin;
  std::size_t end = begin;
  while (in_word(end)) ++end;
  std::string word(line.substr(begin, end - begin));
  if (word.find('0') == std::string::npos) return false;
  for (char& letter : word) letter = letter == '0' ? 'O' : Upper(letter);
  constexpr std::string_view kJumps[] = {"GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS"};
  if (std::ranges::find(kJumps, word) == std::end(kJumps)) return false;
  help = fmt::format("did you mean {}?", word);
  error = {.code = Code::kUnknownWord,
           .begin = static_cast<std::uint32_t>(begin),
           .length = static_cast<std::uint32_t>(end - begin)};
  error.help = help.c_str();
  return true;
}

}  // namespace

void ExplainSyntax(std::span<const Token> tokens, std::size_t at, std::string_view line, LineError& error,
                   std::string& help) {
  help.clear();
  if (JumpWithZeros(line, error, help)) return;
  Hints(tokens, at, line, error, help).Run();
}

namespace {

/// `M3 (TOOL #1)`, `(100%)`: start of a bracket around `at` that begins the block or stands apart behind a finished
/// word and closes at the end of the line, as comments of other controls do; npos: there is none.
std::size_t BracketedComment(std::string_view line, std::size_t at) {
  const std::size_t open = line.substr(0, at).find('(');
  const std::size_t last = line.find_last_not_of(" \t\r");
  if (open == std::string_view::npos || last == std::string_view::npos || line[last] != ')' ||
      line.substr(0, at).find_first_of("\"=;") < open)
    return std::string_view::npos;
  const std::size_t before = open == 0 ? std::string_view::npos : line.find_last_not_of(" \t", open - 1);
  if (before == std::string_view::npos || (before + 1 < open && IsDigit(line[before]))) return open;
  return std::string_view::npos;
}

}  // namespace

void ExplainWord(std::string_view line, LineError& error, std::string& help) {
  help.clear();
  if (error.begin < line.size()) {
    if (const std::size_t open = BracketedComment(line, error.begin); open != std::string_view::npos) {
      help = "a comment begins with ; and brackets hold expressions";
      error = {.code = Code::kUnexpectedText, .begin = static_cast<std::uint32_t>(open), .length = 1};
      error.help = help.c_str();
      return;
    }
  }
  if (error.begin >= line.size() || error.help != nullptr) return;
  if (JumpWithZeros(line, error, help)) return;
  if (error.code == Code::kUnknownCode) {
    // Its own text: no copy is needed.
    error.help = InsteadOfCode(line.substr(error.begin, error.length));
    return;
  }
  const char c = Upper(line[error.begin]);
  const std::string_view behind = line.substr(error.begin + 1);
  const auto digit_at = [&](std::size_t i) { return i < line.size() && IsDigit(line[i]); };
  const std::size_t next = error.begin + 1;
  if (error.code == Code::kUnknownAddress && c == 'E' && error.begin > 0 && digit_at(error.begin - 1) &&
      (digit_at(next) || (next < line.size() && (line[next] == '-' || line[next] == '+') && digit_at(next + 1)))) {
    // `2.5E-3`.
    std::size_t begin = error.begin;
    while (begin > 0 && (IsDigit(line[begin - 1]) || line[begin - 1] == '.')) --begin;
    std::size_t end = next + 1;
    while (digit_at(end)) ++end;
    help = fmt::format("the exponent is written with EX: {}EX{}", line.substr(begin, error.begin - begin),
                       line.substr(next, end - next));
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(end - begin)};
  } else if (error.code == Code::kUnclosedBracket && behind.find(';') != std::string_view::npos &&
             behind.find(line[error.begin] == '(' ? ')' : ']', behind.find(';')) != std::string_view::npos) {
    help = "; begins a comment, so the closing bracket behind it does not count";
  } else if (error.code == Code::kUnknownAddress && c == 'O' && error.begin > 0 && IsDigit(line[error.begin - 1])) {
    // `Y2O`: the letter O behind a digit.
    std::size_t begin = error.begin;
    while (begin > 0 && (IsDigit(line[begin - 1]) || line[begin - 1] == '.' || line[begin - 1] == '-')) --begin;
    if (begin > 0) --begin;
    std::size_t end = error.begin;
    while (end < line.size() && (IsDigit(line[end]) || line[end] == '.' || Upper(line[end]) == 'O')) ++end;
    std::string word(line.substr(begin, end - begin));
    for (char& letter : word) letter = Upper(letter) == 'O' ? '0' : letter;
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(end - begin)};
    help = fmt::format("did you mean {}?", word);
  } else if (error.code == Code::kUnknownAddress && c == 'O' && error.begin == 0 && digit_at(next)) {
    help = "programs have names, that of the file or %_N_NAME_MPF in front of them; is the digit 0 meant?";
  } else if (error.code == Code::kMissingValue && error.begin + error.length < line.size() &&
             line[error.begin + error.length] == '"') {
    const std::string_view text = line.substr(error.begin + error.length);
    const std::size_t quote = text.find('"', 1);
    if (quote != std::string_view::npos)
      help = fmt::format("a text stands behind =: {}={}", line.substr(error.begin, error.length),
                         text.substr(0, quote + 1));
  } else if (error.code == Code::kUnknownCharacter && c == '^') {
    help = "there is no sign for powers: POT(..) is the square";
  } else if (error.code == Code::kUnknownAddress && c == 'O' && error.begin > 0 &&
             (line[error.begin - 1] == '-' || line[error.begin - 1] == '+')) {
    // `Z-O5`: the letter O behind a sign.
    const std::size_t begin = error.begin > 1 && IsLetter(line[error.begin - 2]) ? error.begin - 2 : error.begin - 1;
    std::size_t end = error.begin;
    while (end < line.size() && (IsDigit(line[end]) || line[end] == '.' || Upper(line[end]) == 'O')) ++end;
    std::string word(line.substr(begin, end - begin));
    std::replace(word.begin() + 1, word.end(), 'O', '0');
    std::replace(word.begin() + 1, word.end(), 'o', '0');
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(end - begin)};
    help = fmt::format("did you mean {}?", word);
  } else if (error.code == Code::kUnknownAddress && c == 'O') {
    help = "the letter O; is the digit 0 meant?";
  } else if (error.code == Code::kUnknownCharacter && c == '!' && behind.starts_with('=')) {
    help = "not equal is written <>";
  } else if (error.code == Code::kUnknownCharacter && c == '#') {
    help = digit_at(next) ? "variables of this control are R parameters, R1, and names from DEF"
                          : "variables of this control are R parameters, R1 or R[..], and names from DEF";
  } else if (error.code == Code::kBadNumber && c == '\'') {
    // `'H3G'`: the digit that its base does not have.
    const bool hex = behind.starts_with('H') || behind.starts_with('h');
    const bool binary = behind.starts_with('B') || behind.starts_with('b');
    std::size_t wrong = 0;
    for (std::size_t i = 1; (hex || binary) && i < behind.size() && behind[i] != '\''; ++i) {
      const char digit = Upper(behind[i]);
      if (hex ? IsDigit(digit) || (digit >= 'A' && digit <= 'F') : digit == '0' || digit == '1') continue;
      // One wrong digit is a slip, letters alone are a word.
      if (++wrong > 1) {
        const std::string_view content = behind.substr(0, behind.find('\''));
        if (std::none_of(content.begin(), content.end(), IsDigit))
          help = "a text stands in double quotes; these mark hexadecimal and binary numbers";
        break;
      }
      help = fmt::format("{} is no digit of a {} number", behind[i], hex ? "hexadecimal" : "binary");
    }
    if (!hex && !binary) help = "a text stands in double quotes; these mark hexadecimal and binary numbers";
  } else if (error.code == Code::kMissingValue && (c == 'I' || c == 'L') && error.begin > 1 &&
             digit_at(error.begin - 1) && (behind.empty() || behind[0] <= ' ')) {
    // `X3I`: the letter for the digit 1 behind a number.
    std::size_t begin = error.begin;
    while (begin > 0 && (IsDigit(line[begin - 1]) || line[begin - 1] == '.' || line[begin - 1] == '-')) --begin;
    if (begin > 0) --begin;
    help = fmt::format("did you mean {}1?", line.substr(begin, error.begin - begin));
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(error.begin + 1 - begin)};
  } else if (error.code == Code::kUnknownCharacter && c == '|') {
    help = "the word OR joins two conditions";
  } else if (error.code == Code::kUnexpectedText && (c == ')' || c == ']')) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < error.begin; ++i) {
      if (line[i] == '(' || line[i] == '[') open.push_back(i);
      if ((line[i] == ')' || line[i] == ']') && !open.empty()) open.pop_back();
    }
    if (open.empty()) {
      help = "no bracket is open here";
    } else {
      const bool round = line[open.back()] == '(';
      help = fmt::format("{} is closed by {}", round ? "(" : "[", round ? ")" : "]");
      error = {.code = Code::kUnclosedBracket, .begin = static_cast<std::uint32_t>(open.back()), .length = 1};
    }
  } else if (error.code == Code::kUnclosedString) {
    // Nothing behind the quote that could be the text.
    const std::size_t letter =
        std::find_if(behind.begin(), behind.end(), [](char b) { return IsLetter(b) || IsDigit(b); }) - behind.begin();
    if (letter == behind.size() || behind.find(';') < letter)
      help = "if a text ends here, its quote is missing in front";
  }
  if (!help.empty()) error.help = help.c_str();
}

void ExplainFrameSign(std::string_view line, std::uint32_t word, LineError& error, std::string& help) {
  constexpr std::string_view kFrames[] = {"CTRANS", "CROT", "CSCALE", "CMIRROR", "CFINE", "CROTS", "CRPL"};
  constexpr std::string_view kOperators = "+-*/";
  const auto wrong = [&](std::size_t at) {
    error = {.code = Code::kUnexpectedText, .begin = static_cast<std::uint32_t>(at), .length = 1};
    help = "frames are chained with :";
    error.help = help.c_str();
  };
  line = line.substr(0, line.find(';'));
  for (std::size_t at = word; at < line.size();) {
    std::size_t end = at;
    while (end < line.size() && (IsLetter(line[end]) || IsDigit(line[end]) || line[end] == '_')) ++end;
    if (end == at) {
      ++at;
      continue;
    }
    const std::string_view name = line.substr(at, end - at);
    const std::size_t open = line.find_first_not_of(" \t", end);
    const bool frame = std::any_of(std::begin(kFrames), std::end(kFrames),
                                   [&](std::string_view known) { return IsWord(name, known); });
    if (frame && open != std::string_view::npos && line[open] == '(') {
      const std::size_t before = at == 0 ? std::string_view::npos : line.find_last_not_of(" \t", at - 1);
      if (before != std::string_view::npos && kOperators.find(line[before]) != std::string_view::npos)
        return wrong(before);
      int depth = 0;
      std::size_t close = open;
      for (; close < line.size(); ++close) {
        if (line[close] == '(') ++depth;
        if (line[close] == ')' && --depth == 0) break;
      }
      const std::size_t next = close < line.size() ? line.find_first_not_of(" \t", close + 1) : std::string_view::npos;
      if (next != std::string_view::npos && kOperators.find(line[next]) != std::string_view::npos) return wrong(next);
      end = close;
    }
    at = std::max(end, at + 1);
  }
}

bool GoesOn(std::string_view line) {
  int depth = 0;
  bool text = false;
  std::string_view code;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i == line.size() || (line[i] == ';' && !text)) {
      code = line.substr(0, i);
      break;
    }
    if (line[i] == '"') text = !text;
    if (text) continue;
    if (line[i] == '(' || line[i] == '[') ++depth;
    if (line[i] == ')' || line[i] == ']') --depth;
  }
  while (!code.empty() && static_cast<unsigned char>(code.back()) <= ' ') code.remove_suffix(1);
  return depth > 0 && !text && (code.ends_with(',') || code.ends_with("<<") || code.ends_with('+'));
}

void ExplainSecondLine(std::string_view before, std::uint32_t line_before, std::string_view line, LineError& error,
                       std::string& help) {
  help = fmt::format("line {} goes on here, but a block ends with its line: write both in one", line_before);
  error.help = help.c_str();
  // A list of parameters: names behind types. The second one of a name is the finding, as no other block tells of it.
  std::vector<std::string_view> names;
  bool typed = false;
  const auto scan = [&](std::string_view text, bool second) {
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = at;
      while (end < text.size() && (IsLetter(text[end]) || IsDigit(text[end]) || text[end] == '_')) ++end;
      if (end == at) {
        ++at;
        continue;
      }
      const std::string_view word = text.substr(at, end - at);
      if (typed) {
        for (const std::string_view name : names) {
          if (!second || name.size() != word.size() ||
              !std::equal(name.begin(), name.end(), word.begin(), [](char a, char b) { return Upper(a) == Upper(b); }))
            continue;
          error = {.code = Code::kDoubleName,
                   .begin = static_cast<std::uint32_t>(at),
                   .length = static_cast<std::uint32_t>(word.size()),
                   .help = help.c_str()};
        }
        names.push_back(word);
      }
      typed = false;
      for (const auto& row : words::Types()) typed = typed || IsWord(word, row.text);
      at = end;
    }
  };
  scan(before, false);
  scan(line, true);
}

}  // namespace ncport::frontend::sinumerik
