// Constants: numbers and texts (card 2.1, 2.5; part of token_source.h).
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "base/number_text.h"
#include "frontend/sinumerik/chars.h"
#include "frontend/sinumerik/token_source.h"

namespace ncport::frontend::sinumerik {

namespace {

using K = TokenKind;
using diag::Code;

}  // namespace

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

}  // namespace ncport::frontend::sinumerik
