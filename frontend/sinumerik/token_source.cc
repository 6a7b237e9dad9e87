#include "frontend/sinumerik/token_source.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "base/number_text.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/word_index.h"

namespace ncport::frontend::sinumerik {

namespace {

using K = TokenKind;
using diag::Code;

constexpr std::uint8_t kBlank = 1;       // also characters that cannot be printed, and `&` (card 2)
constexpr std::uint8_t kIdentifier = 2;  // letter, digit, _
constexpr std::uint8_t kStart = 4;       // letter, _
constexpr auto kClasses = [] {
  std::array<std::uint8_t, 256> classes{};
  for (int c = 0; c <= ' '; ++c) classes[c] = kBlank;
  classes[127] = kBlank;
  classes['&'] = kBlank;
  for (int c = '0'; c <= '9'; ++c) classes[c] = kIdentifier;
  for (int c = 'A'; c <= 'Z'; ++c) classes[c] = kIdentifier | kStart;
  for (int c = 'a'; c <= 'z'; ++c) classes[c] = kIdentifier | kStart;
  classes['_'] = kIdentifier | kStart;
  return classes;
}();
bool Is(char c, std::uint8_t mask) { return (kClasses[static_cast<unsigned char>(c)] & mask) != 0; }

const char* SkipBlanks(const char* at, const char* end) {
  while (at < end && Is(*at, kBlank)) ++at;
  return at;
}
const char* SkipDigits(const char* at, const char* end) {
  while (at < end && IsDigit(*at)) ++at;
  return at;
}
const char* SkipIdentifier(const char* at, const char* end) {
  while (at < end && Is(*at, kIdentifier)) ++at;
  return at;
}

constexpr std::size_t kMaxWord = 64;
/// `text` in upper case, in `buffer`; empty if it is longer than any word.
std::string_view UpperIn(std::string_view text, char (&buffer)[kMaxWord]) {
  if (text.size() > kMaxWord) return {};
  for (std::size_t i = 0; i < text.size(); ++i) buffer[i] = Upper(text[i]);
  return {buffer, text.size()};
}

/// Axis number of one of the nine letters, or kNamedAxis.
std::uint8_t LetterAxis(char upper) {
  static constexpr auto kAxes = [] {
    std::array<std::uint8_t, 256> axes{};
    axes.fill(kNamedAxis);
    std::uint8_t number = 0;
    for (const char letter : std::string_view("XYZABCUVW")) axes[static_cast<unsigned char>(letter)] = number++;
    return axes;
  }();
  return kAxes[static_cast<unsigned char>(upper)];
}

/// Rows of the addresses of one letter.
std::uint32_t AddressRowOf(char upper) {
  static const auto rows = [] {
    std::array<std::uint32_t, 128> all{};
    all.fill(kAuxiliaryRow);
    const auto addresses = dialects::sinumerik::Addresses();
    for (std::uint32_t row = 0; row < addresses.size(); ++row) {
      if (addresses[row].text.size() == 1) all[static_cast<unsigned char>(addresses[row].text[0])] = row;
    }
    return all;
  }();
  return rows[static_cast<unsigned char>(upper)];
}
/// Row of I1, J1, K1.
std::uint32_t ViaRowOf(char upper) {
  const auto addresses = dialects::sinumerik::Addresses();
  for (std::uint32_t row = 0; row < addresses.size(); ++row) {
    if (addresses[row].op == ir::WordOp::kVia && addresses[row].text[0] == upper) return row;
  }
  return kAuxiliaryRow;
}

/// `GOTO :30` is a jump to a main block, not a label.
bool IsGotoWord(std::string_view text) {
  char buffer[kMaxWord];
  const WordEntry* entry = FindWord(UpperIn(text, buffer));
  return entry != nullptr && entry->kind == K::kGoto;
}

bool IsStructureWord(K kind) {
  switch (kind) {
    case K::kIf:
    case K::kElse:
    case K::kEndIf:
    case K::kWhile:
    case K::kEndWhile:
    case K::kFor:
    case K::kEndFor:
    case K::kLoop:
    case K::kEndLoop:
    case K::kRepeat:
    case K::kUntil:
      return true;
    default:
      return false;
  }
}

}  // namespace

bool Macros::Add(std::string_view name, std::string_view text) {
  std::string upper(name);
  for (char& c : upper) c = Upper(c);
  if (Find(upper) != nullptr) return false;
  all_.push_back({std::move(upper), std::string(text)});
  return true;
}

const Macros::Macro* Macros::Find(std::string_view upper) const {
  for (const Macro& macro : all_) {
    if (macro.name == upper) return &macro;
  }
  return nullptr;
}

const Token* TokenSource::Refused() const { return refused_ != 0 && !defines_ ? &tokens_[refused_ - 1] : nullptr; }

bool TokenSource::OnlyHead() const {
  for (const Token& token : tokens_) {
    const auto kind = static_cast<K>(token.kind);
    if (kind != K::kSkip && kind != K::kBlockNumber && kind != K::kMainNumber && kind != K::kLabel) return false;
  }
  return true;
}

Token& TokenSource::Push(K kind, const char* from, const char* to) {
  Token& token = tokens_.emplace_back();
  token.kind = static_cast<std::uint16_t>(kind);
  token.offset = OffsetOf(from);
  token.length = in_macro_ != nullptr ? macro_length_ : static_cast<std::uint32_t>(to - from);
  const bool sign =
      kind == K::kMinus || kind == K::kPlus || kind == K::kNot || kind == K::kBitNot || kind == K::kConcat;
  unary_ = sign ? unary_ + 1 : 0;
  return token;
}

void TokenSource::Fail(Code code, const char* from, const char* to, const char* help, const char* detail) {
  if (failed_) return;
  failed_ = true;
  error_ = {.code = code,
            .begin = OffsetOf(from),
            .length = in_macro_ != nullptr ? macro_length_ : static_cast<std::uint32_t>(to - from),
            .help = help,
            .detail = detail};
}

void TokenSource::Lex(std::string_view line, const Macros& macros) {
  tokens_.clear();
  line_ = line.data();
  macros_ = &macros;
  in_macro_ = nullptr;
  comment_ = kNoComment;
  depth_ = 0;
  unary_ = 0;
  refused_ = 0;
  structure_ = K::kNone;
  defines_ = false;
  failed_ = false;

  Cursor c{line.data(), line.data() + line.size()};
  c.at = SkipBlanks(c.at, c.end);
  indent_ = static_cast<std::uint32_t>(c.at - line_);
  if (c.at == c.end) return;
  if (*c.at == ';') {
    comment_ = indent_;
    return;
  }
  LexStart(c);
  LexWords(c);
  if (!failed_ && depth_ != 0 && !defines_) {
    const Open& open = open_[depth_ - 1];
    failed_ = true;
    error_ = {.code = Code::kUnclosedBracket, .begin = open.offset, .length = 1};
  }
}

// `/3 N10 LABEL:` in this order (card 1.3).
void TokenSource::LexStart(Cursor& c) {
  if (*c.at == '/') {
    const char* from = c.at++;
    const bool level = c.at < c.end && IsDigit(*c.at);
    Token& token = Push(K::kSkip, from, level ? c.at + 1 : c.at);
    if (level) {
      token.sub = static_cast<std::uint8_t>(*c.at - '0');
      token.digits = 1;
      ++c.at;
    }
    c.at = SkipBlanks(c.at, c.end);
  }
  if (c.at < c.end && (Upper(*c.at) == 'N' || *c.at == ':')) {
    const K kind = *c.at == ':' ? K::kMainNumber : K::kBlockNumber;
    const char* digits = SkipBlanks(c.at + 1, c.end);
    if (digits < c.end && IsDigit(*digits)) {
      LexNumberedWord(c, kind);
      c.at = SkipBlanks(c.at, c.end);
    }
  }
  if (c.at < c.end && Is(*c.at, kStart)) {
    const char* word_end = SkipIdentifier(c.at, c.end);
    const char* colon = SkipBlanks(word_end, c.end);
    if (colon < c.end && *colon == ':' && word_end - c.at >= 2 &&
        !IsGotoWord({c.at, static_cast<std::size_t>(word_end - c.at)})) {
      const char* from = c.at;
      Token& token = Push(K::kLabel, from, colon + 1);
      token.data = strings_.Intern({from, static_cast<std::size_t>(word_end - from)}).value;
      c.at = colon + 1;
    }
  }
}

void TokenSource::LexWords(Cursor& c) {
  while (!failed_) {
    c.at = SkipBlanks(c.at, c.end);
    if (c.at == c.end) return;
    if (in_macro_ == nullptr && static_cast<std::uint32_t>(c.at - line_) > kMaxLineBytes) {
      Fail(Code::kBlockTooLong, c.at, c.end);
      error_.limit = kMaxLineBytes;
      return;
    }
    if (tokens_.size() > kMaxTokens) {
      Fail(Code::kTooManyWords, c.at, c.end);
      error_.limit = kMaxTokens;
      return;
    }
    if (unary_ > kMaxUnary) {
      Fail(Code::kNestingLimit, c.at, c.at + 1, nullptr, "signs");
      error_.limit = kMaxUnary;
      return;
    }
    const char first = *c.at;
    if (first == ';') {
      if (in_macro_ == nullptr) comment_ = static_cast<std::uint32_t>(c.at - line_);
      return;
    }
    if (Is(first, kStart)) {
      if (!LexLetter(c)) return;
    } else if (IsDigit(first) || (first == '.' && c.at + 1 < c.end && IsDigit(c.at[1]))) {
      LexNumber(c);
    } else if (first == '"') {
      LexText(c);
    } else if (first == '\'') {
      LexBased(c);
    } else if (first == '$') {
      LexSystem(c);
    } else if (static_cast<unsigned char>(first) == 0xC2 && c.at + 1 < c.end &&
               static_cast<unsigned char>(c.at[1]) == 0xA0) {
      c.at += 2;  // a no-break space, pasted from a document
    } else if (!LexOperator(c)) {
      const char* to = c.at + 1;
      while (to < c.end && (static_cast<unsigned char>(*to) & 0xC0U) == 0x80U) ++to;
      Fail(Code::kUnknownCharacter, c.at, to);
    }
  }
}

// Behind GOTO and REPEAT a name is a label, also where it looks like an address (`GOTOF L1`, `GOTOF START`).
bool TokenSource::WantsTarget() const {
  switch (Last()) {
    case K::kGoto:
    case K::kRepeat:
    case K::kRepeatBlock:
      return true;
    case K::kName:
      return tokens_.size() >= 2 && static_cast<K>(tokens_[tokens_.size() - 2].kind) == K::kRepeat;
    default:
      return false;
  }
}

bool TokenSource::LexLetter(Cursor& c) {
  if (WantsTarget()) {
    const char* word_end = SkipIdentifier(c.at, c.end);
    const char* next = SkipBlanks(word_end, c.end);
    const bool number = Upper(*c.at) == 'N' && word_end - c.at > 1 && SkipDigits(c.at + 1, word_end) == word_end;
    const bool other = next < c.end && (*next == '(' || *next == '[' || (*next == '=' && word_end - c.at == 1));
    const bool single = word_end - c.at == 1 || (Upper(*c.at) == 'P' && SkipDigits(c.at + 1, word_end) == word_end);
    if (!number && !other && !single) {
      const char* from = c.at;
      c.at = word_end;
      Push(K::kName, from, word_end).data = strings_.Intern({from, static_cast<std::size_t>(word_end - from)}).value;
      return true;
    }
  }
  if (!macros_->Empty() && !defines_ && LexMacro(c)) return !failed_;
  const char* second = c.at + 1;
  // Card 2.3: two letters or underscores start an identifier, one letter is an address.
  if (*c.at == '_' || (second < c.end && Is(*second, kStart))) {
    LexIdentifier(c, SkipIdentifier(c.at, c.end));
  } else {
    LexAddress(c);
  }
  return !failed_;
}

bool TokenSource::LexMacro(Cursor& c) {
  char buffer[kMaxWord];
  const char* word_end = SkipIdentifier(c.at, c.end);
  const Macros::Macro* macro = macros_->Find(UpperIn({c.at, static_cast<std::size_t>(word_end - c.at)}, buffer));
  if (macro == nullptr && !(c.at + 1 < c.end && Is(c.at[1], kStart))) {
    word_end = SkipDigits(c.at + 1, c.end);  // M06X10: the macro M06
    macro = macros_->Find(UpperIn({c.at, static_cast<std::size_t>(word_end - c.at)}, buffer));
  }
  if (macro == nullptr) return false;
  if (in_macro_ != nullptr) {
    if (macro == in_macro_) return false;  // DEFINE M6 AS M6 T1: the word itself
    Fail(Code::kNestedMacro, c.at, word_end);
    return true;
  }
  in_macro_ = macro;
  macro_offset_ = static_cast<std::uint32_t>(c.at - line_);
  macro_length_ = static_cast<std::uint32_t>(word_end - c.at);
  Cursor inner{macro->text.data(), macro->text.data() + macro->text.size()};
  LexWords(inner);
  in_macro_ = nullptr;
  c.at = word_end;
  return true;
}

void TokenSource::LexIdentifier(Cursor& c, const char* word_end) {
  const char* from = c.at;
  const std::string_view text(from, static_cast<std::size_t>(word_end - from));
  c.at = word_end;
  char buffer[kMaxWord];
  const std::string_view upper = UpperIn(text, buffer);
  const WordEntry* entry = upper.empty() ? nullptr : FindWord(upper);
  if (entry == nullptr) {
    if (upper.size() > 2 && upper.substr(0, 2) == "RG" && SkipDigits(from + 2, word_end) == word_end) {
      Token& token = Push(K::kCell, from, word_end);
      token.sub = 1;
      ReadUnsigned(from + 2, word_end, token);
      return;
    }
    Push(K::kName, from, word_end).data = strings_.Intern(text).value;
    return;
  }
  if (IsStructureWord(entry->kind) && OnlyHead()) structure_ = entry->kind;
  Token& token = Push(entry->kind, from, word_end);
  token.sub = entry->sub;
  token.digits = entry->digits;
  token.data = entry->data;
  switch (entry->kind) {
    case K::kBoolean:
      token.number = entry->sub;
      break;
    case K::kRefused:
      if (refused_ == 0) refused_ = static_cast<std::uint32_t>(tokens_.size());
      break;
    case K::kDefine:
      defines_ = true;
      break;
    case K::kPathCall:
      LexPath(c);
      break;
    case K::kAddress: {
      // A word of two letters or more always has `=` (card 2.2); without it the name is something else.
      const char* next = SkipBlanks(c.at, c.end);
      if (next == c.end || (*next != '=' && *next != '[')) {
        Fail(Code::kMissingValue, from, word_end);
      }
      break;
    }
    default:
      break;
  }
}

// One letter: an address, an R cell, a code, an L name, a block number.
void TokenSource::LexAddress(Cursor& c) {
  const char* from = c.at;
  const char letter = Upper(*from);
  switch (letter) {
    case 'G':
    case 'M':
      LexCode(c);
      return;
    case 'N':
      LexNumberedWord(c, K::kBlockNumber);
      return;
    case 'R': {
      const char* digits = SkipBlanks(from + 1, c.end);
      if (digits < c.end && *digits == '[') {
        Push(K::kCellAt, from, from + 1);
        c.at = from + 1;
      } else if (digits < c.end && IsDigit(*digits)) {
        LexNumberedWord(c, K::kCell);
      } else {
        Fail(Code::kMissingValue, from, from + 1,
             "R is the space of R parameters: R1, R[1]; the radius of an arc is CR=");
      }
      return;
    }
    case 'L': {
      const char* digits = SkipBlanks(from + 1, c.end);
      const char* end = SkipDigits(digits, c.end);
      if (digits == end) {
        Fail(Code::kMissingValue, from, from + 1);
        return;
      }
      char name[kMaxWord] = {'L'};
      const auto count = static_cast<std::size_t>(end - digits);
      if (count >= kMaxWord) {
        Fail(Code::kUnknownWord, from, end);
        return;
      }
      std::memcpy(name + 1, digits, count);
      c.at = end;
      Push(K::kSubName, from, end).data = strings_.Intern({name, count + 1}).value;
      return;
    }
    default:
      break;
  }
  // Inside brackets a letter is the name of an axis or spindle: `$AA_IM[X]`, `SPI(S1)`.
  const char* value_at = SkipBlanks(from + 1, c.end);
  const std::uint8_t axis = LetterAxis(letter);
  if (depth_ != 0) {
    const char* digits_end = SkipDigits(from + 1, c.end);
    if (axis != kNamedAxis) {
      LexAxis(c, from, digits_end);
    } else {
      c.at = digits_end;
      Push(K::kName, from, digits_end).data =
          strings_.Intern({from, static_cast<std::size_t>(digits_end - from)}).value;
    }
    return;
  }
  // Digits are an extension only before `=` or `[` (card 2.2).
  const char* digits_end = SkipDigits(value_at, c.end);
  const char* behind = SkipBlanks(digits_end, c.end);
  const bool assigned =
      behind < c.end && ((*behind == '=' && !(behind + 1 < c.end && behind[1] == '=')) || *behind == '[');
  const bool extended = assigned && digits_end > value_at;
  const std::uint32_t row = AddressRowOf(letter);
  if (extended && digits_end - value_at > 4) {
    Fail(Code::kUnknownAddress, from, digits_end);
    return;
  }
  if (letter == 'P') {
    if (assigned && !extended) {
      c.at = from + 1;
      Push(K::kPasses, from, from + 1);
      return;
    }
  } else if (axis != kNamedAxis || (row == kAuxiliaryRow && extended)) {
    if (extended || assigned) {
      LexAxis(c, from, extended ? digits_end : from + 1);
      return;
    }
  } else if (row != kAuxiliaryRow && assigned) {
    std::uint32_t number = 0;
    std::from_chars(value_at, digits_end, number);
    c.at = extended ? digits_end : from + 1;
    const std::uint32_t via = extended && number == 1 ? ViaRowOf(letter) : kAuxiliaryRow;
    Token& token = Push(K::kAddress, from, c.at);
    token.data = via != kAuxiliaryRow ? via : row;
    token.sub = via != kAuxiliaryRow ? 0 : static_cast<std::uint8_t>(number);
    const bool takes = via != kAuxiliaryRow || !extended ||
                       dialects::sinumerik::Addresses()[row].extension != dialects::sinumerik::Extension::kNone;
    if (!takes || number > 99) Fail(Code::kUnknownAddress, from, c.at);
    return;
  }
  if (axis == kNamedAxis && row == kAuxiliaryRow && letter != 'P') {
    Fail(Code::kUnknownAddress, from, from + 1);
    return;
  }
  Token& token = Push(letter == 'P'        ? K::kPassesValue
                      : axis != kNamedAxis ? K::kAxisValue
                                           : K::kAddressValue,
                      from, from + 1);
  token.sub = axis;
  token.digits = static_cast<std::uint8_t>(row);  // `data` may become the spelling of the number
  const char* end = ReadValue(value_at, c.end, token);
  if (end != nullptr) {
    if (in_macro_ == nullptr) token.length = static_cast<std::uint32_t>(end - from);
    c.at = end;
    return;
  }
  if (failed_) return;
  c.at = from + 1;
  if (axis != kNamedAxis) {  // `=X`: the axis as a value
    token.kind = static_cast<std::uint16_t>(K::kAxis);
    return;
  }
  Fail(Code::kMissingValue, from, from + 1);
}

// X, X1, X01 as a name; the digits are part of it.
void TokenSource::LexAxis(Cursor& c, const char* start, const char* digits_end) {
  c.at = digits_end;
  Token& token = Push(K::kAxis, start, digits_end);
  token.sub = LetterAxis(Upper(*start));
  const char* digits = SkipBlanks(start + 1, digits_end);
  while (digits + 1 < digits_end && *digits == '0') ++digits;  // leading zeros of an extension do not count (card 2.3)
  const auto count = static_cast<std::size_t>(digits_end - digits);
  if (digits_end == start + 1 || count == 0) return;
  if (count > 4) {
    Fail(Code::kUnknownAddress, start, digits_end);
    return;
  }
  char name[8] = {Upper(*start)};
  std::memcpy(name + 1, digits, count);
  token.sub = kNamedAxis;
  token.data = strings_.Intern({name, count + 1}).value;
}

void TokenSource::LexCode(Cursor& c) {
  const char* from = c.at;
  const bool is_g = Upper(*from) == 'G';
  const char* digits = SkipBlanks(from + 1, c.end);
  const char* end = SkipDigits(digits, c.end);
  const char* behind = SkipBlanks(end, c.end);
  const bool assigned =
      behind < c.end && ((*behind == '=' && !(behind + 1 < c.end && behind[1] == '=')) || *behind == '[');
  std::uint32_t number = 0;
  const bool fits = std::from_chars(digits, end, number).ec == std::errc() && end - digits <= 9;
  if (assigned) {
    c.at = digits == end ? from + 1 : end;
    Token& token = Push(is_g ? K::kComputedG : K::kComputedM, from, c.at);
    token.sub = static_cast<std::uint8_t>(number);
    if (is_g && digits != end) {
      Fail(Code::kUnexpectedText, behind, behind + 1);  // `G1=5`: the number stands there already
    } else if (number > 99) {
      Fail(Code::kUnknownCode, from, c.at);
    }
    return;
  }
  if (digits == end || !fits) {
    Fail(digits == end ? Code::kMissingValue : Code::kUnknownCode, from, digits == end ? from + 1 : end);
    return;
  }
  c.at = end;
  Token& token = Push(K::kCode, from, end);
  token.number = number;
  token.digits = static_cast<std::uint8_t>(end - digits);
  token.data = is_g ? FindGCode(number) : FindMCode(number);
  if (is_g && token.data == kAuxiliaryRow) {
    if (!IsRefusedGCode(number)) {
      Fail(Code::kUnknownCode, from, end);
      return;
    }
    token.kind = static_cast<std::uint16_t>(K::kRefused);
    if (refused_ == 0) refused_ = static_cast<std::uint32_t>(tokens_.size());
  }
}

// N10, :10, R5: a letter or sign and a whole number.
void TokenSource::LexNumberedWord(Cursor& c, K kind) {
  const char* from = c.at;
  const char* digits = SkipBlanks(from + 1, c.end);
  const char* end = SkipDigits(digits, c.end);
  std::uint32_t number = 0;
  if (digits == end || std::from_chars(digits, end, number).ec != std::errc() || end - digits > 200) {
    Fail(digits == end ? Code::kMissingValue : Code::kBadNumber, from, digits == end ? from + 1 : end);
    return;
  }
  c.at = end;
  Token& token = Push(kind, from, end);
  token.number = number;
  token.digits = static_cast<std::uint8_t>(end - digits);
}

const char* TokenSource::ReadValue(const char* at, const char* end, Token& token) {
  const char* p = at;
  if (p < end && (*p == '-' || *p == '+')) p = SkipBlanks(p + 1, end);
  const char* stop = ReadUnsigned(p, end, token);
  if (stop == nullptr) return nullptr;
  if (*at == '-') token.number = -token.number;
  if (*at == '+') token.format.flags |= ir::NumberFormat::kPlusSign;
  if (p != at && (token.format.flags & ir::NumberFormat::kAsText) != 0) {
    token.data = strings_.Intern({at, static_cast<std::size_t>(stop - at)}).value;  // the spelling holds the sign
  }
  return stop;
}

const char* TokenSource::ReadUnsigned(const char* at, const char* end, Token& token) {
  if (at == end || !(IsDigit(*at) || *at == '.')) return nullptr;
  const char* p = at;
  DecimalText decimal;
  if (!ParseDecimal(p, end, decimal)) return nullptr;
  token.number = decimal.value;
  token.format.int_digits = decimal.int_digits;
  token.format.decimals = decimal.decimals;
  token.format.flags = decimal.has_point ? ir::NumberFormat::kPoint : 0;
  if (!decimal.exact) token.format.flags |= ir::NumberFormat::kAsText;
  // `EX` behind digits is the exponent (card 2.1); EX without digits behind it is an address and a name.
  if (p + 2 < end && Upper(p[0]) == 'E' && Upper(p[1]) == 'X') ReadExponent(at, p, end, token);
  if (!std::isfinite(token.number)) {
    Fail(Code::kBadNumber, at, p);
    return nullptr;
  }
  if ((token.format.flags & ir::NumberFormat::kAsText) != 0) {
    token.data = strings_.Intern({at, static_cast<std::size_t>(p - at)}).value;
  }
  return p;
}

void TokenSource::ReadExponent(const char* start, const char*& at, const char* end, Token& token) {
  const char* digits = at + 2;
  if (digits < end && (*digits == '-' || *digits == '+')) ++digits;
  const char* stop = SkipDigits(digits, end);
  if (stop == digits) return;
  // The text with `e` for `EX` is what from_chars reads.
  char buffer[kMaxWord];
  const auto mantissa = static_cast<std::size_t>(at - start);
  const char* exponent = at[2] == '+' ? at + 3 : at + 2;
  const auto rest = static_cast<std::size_t>(stop - exponent);
  if (mantissa + rest + 1 > kMaxWord) {
    Fail(Code::kBadNumber, start, stop);
    return;
  }
  std::memcpy(buffer, start, mantissa);
  buffer[mantissa] = 'e';
  std::memcpy(buffer + mantissa + 1, exponent, rest);
  const auto result = std::from_chars(buffer, buffer + mantissa + 1 + rest, token.number);
  if (result.ec != std::errc()) Fail(Code::kBadNumber, start, stop);
  token.format.flags |= ir::NumberFormat::kAsText | ir::NumberFormat::kPoint;  // REAL, also without a point
  at = stop;
}

void TokenSource::LexNumber(Cursor& c) {
  const char* from = c.at;
  Token& token = Push(K::kNumber, from, from);
  const char* end = ReadUnsigned(from, c.end, token);
  if (end == nullptr) {
    Fail(Code::kBadNumber, from, from + 1);
    return;
  }
  if (in_macro_ == nullptr) token.length = static_cast<std::uint32_t>(end - from);
  c.at = end;
}

// 'H3C7F' and 'B1010' (card 2.1): INT constants.
void TokenSource::LexBased(Cursor& c) {
  const char* from = c.at;
  const char* end = from + 1;
  while (end < c.end && Is(*end, kIdentifier)) ++end;
  if (end == c.end || *end != '\'' || end - from < 3) {
    Fail(Code::kBadNumber, from, end);
    return;
  }
  const char base = Upper(from[1]);
  std::uint32_t value = 0;
  const auto result = std::from_chars(from + 2, end, value, base == 'H' ? 16 : 2);
  if ((base != 'H' && base != 'B') || result.ec != std::errc() || result.ptr != end) {
    Fail(Code::kBadNumber, from, end + 1);
    return;
  }
  c.at = end + 1;
  Token& token = Push(K::kNumber, from, c.at);
  token.number = static_cast<std::int32_t>(value);  // 32 bits: 'HFFFFFFFF' is -1
  token.format.flags = ir::NumberFormat::kAsText;
  token.data = strings_.Intern({from, static_cast<std::size_t>(c.at - from)}).value;
}

void TokenSource::LexText(Cursor& c) {
  const char* from = c.at;
  const char* p = from + 1;
  bool quoted = false;
  while (p < c.end) {
    if (*p == '\'' && p + 2 < c.end && p[1] == '"' && p[2] == '\'') {  // "a'"'b": a quote inside (card 2.5)
      quoted = true;
      p += 3;
      continue;
    }
    if (*p == '"') break;
    ++p;
  }
  if (p >= c.end) {
    Fail(Code::kUnclosedString, from, c.end);
    return;
  }
  c.at = p + 1;
  Token& token = Push(K::kText, from, c.at);
  const std::string_view inner(from + 1, static_cast<std::size_t>(p - from - 1));
  if (!quoted) {
    token.data = strings_.Intern(inner).value;
    return;
  }
  std::string text;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (inner.substr(i, 3) == "'\"'") {
      text.push_back('"');
      i += 2;
    } else {
      text.push_back(inner[i]);
    }
  }
  token.data = strings_.Intern(text).value;
}

void TokenSource::LexSystem(Cursor& c) {
  const char* from = c.at;
  const char* end = SkipIdentifier(from + 1, c.end);
  if (end == from + 1) {
    // `$$..`: the main-run form of synchronized actions.
    Fail(Code::kUnknownCharacter, from, from + 1);
    return;
  }
  c.at = end;
  Push(K::kSystem, from, end).data = strings_.Intern({from + 1, static_cast<std::size_t>(end - from - 1)}).value;
}

// PCALL path: text without quotes up to a blank, a bracket or a comment.
void TokenSource::LexPath(Cursor& c) {
  const char* from = SkipBlanks(c.at, c.end);
  const char* end = from;
  while (end < c.end && !Is(*end, kBlank) && *end != '(' && *end != ';') ++end;
  if (end == from) return;
  c.at = end;
  Push(K::kPath, from, end).data = strings_.Intern({from, static_cast<std::size_t>(end - from)}).value;
}

bool TokenSource::LexOperator(Cursor& c) {
  const char* from = c.at;
  const char next = from + 1 < c.end ? from[1] : '\0';
  K kind = K::kNone;
  std::ptrdiff_t length = 1;
  switch (*from) {
    case '=':
      kind = next == '=' ? K::kEqualTo : K::kEquals;
      length = next == '=' ? 2 : 1;
      break;
    case '<':
      kind = next == '=' ? K::kLessEqual : next == '>' ? K::kNotEqual : next == '<' ? K::kConcat : K::kLess;
      length = kind == K::kLess ? 1 : 2;
      break;
    case '>':
      kind = next == '=' ? K::kGreaterEqual : K::kGreater;
      length = kind == K::kGreater ? 1 : 2;
      break;
    case '+':
      kind = K::kPlus;
      break;
    case '-':
      kind = K::kMinus;
      break;
    case '*':
      kind = K::kStar;
      break;
    case '/':
      kind = K::kSlash;
      break;
    case ',':
      kind = K::kComma;
      break;
    case ':': {
      const char* digits = SkipBlanks(from + 1, c.end);
      if (Last() == K::kGoto && digits < c.end && IsDigit(*digits)) {
        LexNumberedWord(c, K::kMainNumber);
        return true;
      }
      kind = K::kColon;
      break;
    }
    case '(':
    case '[':
      if (depth_ == kMaxDepth) {
        Fail(Code::kNestingLimit, from, from + 1, nullptr, "brackets");
        error_.limit = kMaxDepth;
        return true;
      }
      open_[depth_++] = {OffsetOf(from), *from};
      kind = *from == '(' ? K::kLeftParen : K::kLeftBracket;
      break;
    case ')':
    case ']':
      if (depth_ == 0 || (open_[depth_ - 1].bracket == '(') != (*from == ')')) {
        if (!defines_) {
          Fail(Code::kUnexpectedText, from, from + 1);
          return true;
        }
      } else {
        --depth_;
      }
      kind = *from == ')' ? K::kRightParen : K::kRightBracket;
      break;
    default:
      return false;
  }
  // `= =`, `> =`, `< >`: one operator, torn apart (card 11: pages for small controls print it so).
  const bool tears = kind == K::kEquals || kind == K::kLess || kind == K::kGreater;
  if (tears) {
    const char* after = SkipBlanks(from + 1, c.end);
    if (after > from + 1 && after < c.end && (*after == '=' || (kind == K::kLess && *after == '>'))) {
      Fail(Code::kSplitOperator, from, after + 1);
      return true;
    }
  }
  c.at = from + length;
  Push(kind, from, c.at);
  return true;
}

}  // namespace ncport::frontend::sinumerik
