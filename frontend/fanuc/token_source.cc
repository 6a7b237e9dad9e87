#include "frontend/fanuc/token_source.h"

#include <cmath>

#include "base/number_text.h"
#include "dialects/fanuc/system_variables.h"
#include "frontend/common/chars.h"

namespace ncport::frontend::fanuc {

namespace {

using K = TokenKind;
using diag::Code;

constexpr bool IsBlank(char c) { return (c >= '\0' && c <= ' ') || c == 127; }

}  // namespace

const Token* TokenSource::Refused() const { return refused_ != 0 ? &tokens_[refused_ - 1] : nullptr; }

const char* TokenSource::SkipBlanks(const char* at) const {
  while (at < stop_ && IsBlank(*at)) ++at;
  return at;
}

bool TokenSource::StartsNumber(const char* at) const {
  if (IsDigit(At(at))) return true;
  return At(at) == '.' && IsDigit(At(SkipBlanks(at + 1)));
}

Token& TokenSource::Push(K kind, const char* from, const char* to) {
  Token& token = tokens_.emplace_back();
  token.kind = static_cast<std::uint16_t>(kind);
  token.offset = OffsetOf(from);
  token.length = static_cast<std::uint32_t>(to - from);
  return token;
}

void TokenSource::Fail(Code code, const char* from, const char* to, const char* help, const char* detail) {
  if (failed_) return;
  failed_ = true;
  error_ = {.code = code,
            .begin = OffsetOf(from),
            .length = static_cast<std::uint32_t>(to - from),
            .help = help,
            .detail = detail};
}

void TokenSource::Lex(std::string_view line, std::uint32_t begin) {
  tokens_.clear();
  comments_.clear();
  line_ = line.data();
  stop_ = line_ + line.size();
  at_ = SkipBlanks(line_ + begin);
  indent_ = OffsetOf(at_) - begin;
  next_ = end_ = static_cast<std::uint32_t>(line.size());
  depth_ = 0;
  refused_ = 0;
  structure_ = K::kNone;
  assigning_ = false;
  done_ = false;
  failed_ = false;
  LexHead();
  LexBlock();
  if (failed_) {
    // The block goes on to its end, which a comment does not hold.
    for (const char* p = line_ + error_.begin; p < stop_; ++p) {
      if (*p == ';') {
        end_ = OffsetOf(p);
        next_ = end_ + 1;
        break;
      }
    }
  } else if (depth_ != 0) {
    failed_ = true;
    error_ = {.code = Code::kUnclosedBracket, .begin = open_[depth_ - 1], .length = 1};
  }
}

// `/1 N10 O1234` in any of the orders that are met (fanuc-1).
void TokenSource::LexHead() {
  for (int part = 0; part < 4 && !failed_; ++part) {
    at_ = SkipBlanks(at_);
    const char letter = Upper(At(at_));
    if (At(at_) == '/') {
      if (!LexSkip(K::kSkip)) return;
      continue;
    }
    const bool number = letter == 'N' || letter == 'O' || letter == ':';
    const char* digits = number ? SkipBlanks(at_ + 1) : at_;
    if (!number || !IsDigit(At(digits))) return;
    const char* from = at_;
    Token& token = Push(letter == 'N' ? K::kBlockNumber : K::kProgramNumber, from, from);
    const char* end = ReadNumber(digits, token);
    if (end == nullptr) return;
    token.length = static_cast<std::uint32_t>(end - from);
    token.digits = token.format.int_digits;
    at_ = end;
    if ((token.format.flags & ir::NumberFormat::kPoint) != 0 || token.number > 99999999) {
      token.number = 0;  // the head is read all the same
      Fail(Code::kBadNumber, from, end);
      return;
    }
  }
}

void TokenSource::LexBlock() {
  while (!failed_ && !done_) {
    at_ = SkipBlanks(at_);
    if (at_ == stop_) return;
    if (OffsetOf(at_) > kMaxLineBytes) {
      Fail(Code::kBlockTooLong, at_, stop_);
      error_.limit = kMaxLineBytes;
      return;
    }
    if (tokens_.size() > kMaxTokens) {
      Fail(Code::kTooManyWords, at_, stop_);
      error_.limit = kMaxTokens;
      return;
    }
    LexOne();
  }
}

void TokenSource::LexOne() {
  const char first = *at_;
  if (IsLetter(first)) {
    LexLetters();
  } else if (StartsNumber(at_)) {
    const char* from = at_;
    Token& token = Push(K::kNumber, from, from);
    const char* end = ReadNumber(from, token);
    if (end == nullptr) return;
    token.length = static_cast<std::uint32_t>(end - from);
    at_ = end;
  } else if (first == '#') {
    LexVariable();
  } else if (first == '(') {
    LexComment();
  } else if (first == ';' || (first == ':' && SkipBlanks(at_ + 1) == stop_)) {
    // `:` at the end of a line is a slip for `;` (fanuc-1).
    end_ = OffsetOf(at_);
    next_ = end_ + 1;
    done_ = true;
  } else if (first == '<') {
    LexName();
  } else {
    LexMark();
  }
}

const char* TokenSource::ReadNumber(const char* at, Token& token) {
  const char* p = at;
  while (p < stop_ && (IsDigit(*p) || *p == '.')) ++p;
  const char* next = SkipBlanks(p);
  const char* begin = at;
  const char* end = p;
  const char* behind = p;
  if (next != p && (IsDigit(At(next)) || At(next) == '.')) {
    // `G 0 1`: blanks inside of a number mean nothing (fanuc-2.1).
    digits_.clear();
    for (p = at; p < stop_ && (IsDigit(*p) || *p == '.' || IsBlank(*p)); ++p) {
      if (IsBlank(*p)) continue;
      digits_.push_back(*p);
      behind = p + 1;
    }
    begin = digits_.data();
    end = begin + digits_.size();
  }
  DecimalText decimal;
  const char* parsed = begin;
  if (!ParseDecimal(parsed, end, decimal) || parsed != end || !std::isfinite(decimal.value)) {
    Fail(Code::kBadNumber, at, behind);
    return nullptr;
  }
  token.number = decimal.value;
  token.format.int_digits = decimal.int_digits;
  token.format.decimals = decimal.decimals;
  token.format.flags = decimal.has_point ? ir::NumberFormat::kPoint : 0;
  if (!decimal.exact) {
    token.format.flags |= ir::NumberFormat::kAsText;
    token.data = strings_.Intern({begin, static_cast<std::size_t>(end - begin)}).value;
  }
  return behind;
}

void TokenSource::LexVariable() {
  const char* from = at_;
  const char* p = SkipBlanks(at_ + 1);
  if (IsDigit(At(p))) {
    Token& token = Push(K::kCell, from, from);
    const char* end = ReadNumber(p, token);
    if (end == nullptr) return;
    token.length = static_cast<std::uint32_t>(end - from);
    at_ = end;
    return;
  }
  if (At(p) == '[') {
    Push(K::kCellAt, from, from + 1);
    at_ = p;
    return;
  }
  if (At(p) == '#') {
    Fail(Code::kUnexpectedText, p, p + 1, "a variable whose number is in another one is written #[#1]");
    return;
  }
  if (At(p) == '_') {
    const char* end = p;
    while (end < stop_ && (IsLetter(*end) || IsDigit(*end) || *end == '_')) ++end;
    char upper[32];
    const auto length = static_cast<std::size_t>(end - p);
    for (std::size_t i = 0; i < length && i < sizeof upper; ++i) upper[i] = Upper(p[i]);
    const dialects::fanuc::SystemName* name =
        length <= sizeof upper ? dialects::fanuc::FindSystemName({upper, length}) : nullptr;
    if (name == nullptr || name->indexed) {
      Fail(Code::kNotSupported, from, end, "write the variable by its number");
      return;
    }
    Push(K::kCell, from, end).number = name->base;
    at_ = end;
    return;
  }
  Fail(Code::kMissingValue, from, from + 1, "a variable is written #100 or #[expression]");
}

void TokenSource::LexName() {
  const char* from = at_;
  const char* end = from + 1;
  while (end < stop_ && *end != '>' && *end != '(' && *end != ';') ++end;
  if (At(end) != '>') {
    Fail(Code::kExpectedText, end, end, nullptr, ">");
    return;
  }
  std::string_view name(from + 1, static_cast<std::size_t>(end - from - 1));
  while (!name.empty() && IsBlank(name.back())) name.remove_suffix(1);
  while (!name.empty() && IsBlank(name.front())) name.remove_prefix(1);
  if (name.empty()) {
    Fail(Code::kMissingValue, from, end + 1);
    return;
  }
  at_ = end + 1;
  Push(K::kName, from, at_).data = strings_.Intern(name).value;
}

// Brackets inside a comment are not always balanced: it then ends at the last one of the line (real-programs-fanuc#4).
void TokenSource::LexComment() {
  const char* from = at_;
  const char* last = nullptr;
  std::uint32_t depth = 0;
  for (const char* p = from; p < stop_; ++p) {
    if (*p == '(') {
      if (depth == 0 && last != nullptr) break;  // another comment
      ++depth;
    } else if (*p == ')') {
      last = p;
      if (depth != 0) --depth;
    }
  }
  if (last == nullptr) {
    Fail(Code::kUnclosedComment, from, stop_);
    return;
  }
  comments_.push_back({OffsetOf(from), OffsetOf(from + 1), OffsetOf(last), static_cast<std::uint32_t>(tokens_.size())});
  at_ = last + 1;
}

// DPRNT[text #n[cd] ..]: `*` prints a blank, blanks mean nothing (fanuc-10).
void TokenSource::LexPrint() {
  at_ = SkipBlanks(at_);
  if (At(at_) != '[') {
    Fail(Code::kExpectedText, at_, at_, nullptr, "[");
    return;
  }
  Push(K::kLeftBracket, at_, at_ + 1);
  ++at_;
  std::string text;
  const char* text_from = at_;
  const auto flush = [&] {
    if (!text.empty()) Push(K::kPrintText, text_from, at_).data = strings_.Intern(text).value;
    text.clear();
  };
  while (at_ < stop_ && !failed_) {
    const char c = *at_;
    if (c == ']') {
      flush();
      Push(K::kRightBracket, at_, at_ + 1);
      ++at_;
      return;
    }
    if (c != '#') {
      if (text.empty()) text_from = at_;
      if (!IsBlank(c)) text.push_back(c == '*' ? ' ' : c);
      ++at_;
      continue;
    }
    flush();
    LexVariable();
    if (failed_) return;
    if (Last() == K::kCellAt) {
      do {
        LexOne();
        at_ = SkipBlanks(at_);
      } while (depth_ != 0 && !failed_ && !done_ && at_ < stop_);
      if (failed_) return;
    }
    const char* format = SkipBlanks(at_);
    const char* whole = SkipBlanks(format + 1);
    const char* decimals = SkipBlanks(whole + 1);
    const char* close = SkipBlanks(decimals + 1);
    if (At(format) != '[' || !IsDigit(At(whole)) || !IsDigit(At(decimals)) || At(close) != ']') {
      Fail(Code::kExpectedText, at_, at_, "the places before and behind the point follow the variable: #1[43]",
           "two digits in brackets");
      return;
    }
    at_ = close + 1;
    Token& token = Push(K::kPrintFormat, format, at_);
    token.sub = static_cast<std::uint8_t>(*whole - '0');
    token.digits = static_cast<std::uint8_t>(*decimals - '0');
    if (token.sub + token.digits == 0 || token.sub + token.digits > 8) {
      Fail(Code::kOutOfRange, format, at_, nullptr, "1 to 8 digits");
    }
  }
  if (!failed_) Fail(Code::kExpectedText, at_, at_, nullptr, "]");
}

bool TokenSource::LexSkip(K kind) {
  const char* from = at_;
  const char* digit = SkipBlanks(from + 1);
  const bool level = IsDigit(At(digit));
  at_ = level ? digit + 1 : from + 1;
  Token& token = Push(kind, from, at_);
  if (level) {
    token.sub = static_cast<std::uint8_t>(*digit - '0');
    token.digits = 1;
  }
  return true;
}

void TokenSource::LexMark() {
  const char* from = at_;
  K kind = K::kNone;
  std::ptrdiff_t length = 1;
  switch (*from) {
    case '=':
      kind = K::kEquals;
      if (depth_ == 0) assigning_ = true;
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
      // Outside of brackets and assignments a slash skips the rest of the block (fanuc-1).
      if (depth_ == 0 && !assigning_) {
        LexSkip(K::kSkipRest);
        return;
      }
      kind = K::kSlash;
      break;
    case '&':
    case '|':
      if (At(from + 1) == *from) {
        kind = *from == '&' ? K::kBothTrue : K::kOneTrue;
        length = 2;
      }
      break;
    case ',': {
      if (depth_ == 0) {
        // `,C ,R ,A`: option words (fanuc-8.10).
        const char* letter = SkipBlanks(from + 1);
        const char upper = Upper(At(letter));
        if (upper == 'C' || upper == 'R' || upper == 'A') {
          LexAddress(static_cast<char>(upper - 'A' + 'a'), from, letter + 1);
          return;
        }
      }
      kind = K::kComma;
      break;
    }
    case '[':
      if (depth_ == kMaxDepth) {
        Fail(Code::kNestingLimit, from, from + 1, nullptr, "brackets");
        error_.limit = kMaxDepth;
        return;
      }
      open_[depth_++] = OffsetOf(from);
      kind = K::kLeftBracket;
      break;
    case ']':
      if (depth_ == 0) {
        Fail(Code::kUnexpectedText, from, from + 1);
        return;
      }
      --depth_;
      kind = K::kRightBracket;
      break;
    default:
      break;
  }
  if (kind == K::kNone) {
    const char* to = from + 1;
    while (to < stop_ && (static_cast<unsigned char>(*to) & 0xC0U) == 0x80U) ++to;
    Fail(Code::kUnknownCharacter, from, to);
    return;
  }
  at_ = from + length;
  Push(kind, from, at_);
}

}  // namespace ncport::frontend::fanuc
