#include "ir/ops/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>

#include "base/letter_case.h"
#include "base/number_text.h"

namespace ncport::ir::ops {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string_view Trim(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Position in characters of the byte offset `offset`.
std::int64_t PositionOf(std::string_view text, std::size_t offset) {
  return static_cast<std::int64_t>(Length(text.substr(0, offset)));
}

}  // namespace

void AppendNumberText(TextBuffer& buffer, double value) { AppendTrimmed(buffer, value, 10); }

void AppendCharacter(TextBuffer& buffer, double code) {
  const auto byte = static_cast<unsigned>(code);
  if (byte == 0) return;
  if (byte < 0x80U) {
    buffer.Append(static_cast<char>(byte));
    return;
  }
  buffer.Append(static_cast<char>(0xC0U | (byte >> 6U)));
  buffer.Append(static_cast<char>(0x80U | (byte & 0x3FU)));
}

Number ParseNumber(std::string_view text) {
  text = Trim(text);
  bool negative = false;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    negative = text.front() == '-';
    text.remove_prefix(1);
  }
  std::size_t digits = 0;
  std::size_t end = 0;
  bool point = false;
  for (; end < text.size() && (IsDigit(text[end]) || (text[end] == '.' && !point)); ++end) {
    point = point || text[end] == '.';
    digits += IsDigit(text[end]) ? 1 : 0;
  }
  if (digits == 0) return Fail(Error::kConversion);
  std::string_view rest = text.substr(end);
  int exponent = 0;
  if (!rest.empty()) {
    if (rest.size() < 3 || Upper(rest[0]) != 'E' || Upper(rest[1]) != 'X') return Fail(Error::kConversion);
    rest.remove_prefix(2);
    if (rest.front() == '+') rest.remove_prefix(1);
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), exponent);
    if (error != std::errc{} || stop != rest.data() + rest.size()) return Fail(Error::kConversion);
  }
  // from_chars reads digits and exponent together, so that 1.5EX-7 is the nearest double and not a rounded product.
  TextBuffer decimal;
  decimal.Append(text.substr(0, end));
  decimal.Append('e');
  AppendInteger(decimal, exponent);
  double value = 0;
  const char* begin = decimal.data();
  const auto [stop, error] = std::from_chars(begin, begin + decimal.size(), value);
  if (error != std::errc{}) return Fail(Error::kConversion);
  return {(negative ? -value : value) + 0.0, Error::kNone};
}

std::size_t Length(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, IsContinuation));
}

std::size_t OffsetOf(std::string_view text, std::size_t index) {
  std::size_t offset = 0;
  for (; offset < text.size() && index > 0; --index) {
    ++offset;
    while (offset < text.size() && IsContinuation(text[offset])) ++offset;
  }
  return offset;
}

Character CharacterAt(std::string_view text, std::size_t offset) {
  const auto lead = static_cast<unsigned char>(text[offset]);
  if (lead < 0x80U) return {lead, 1};
  std::size_t bytes = 1;
  while (offset + bytes < text.size() && IsContinuation(text[offset + bytes])) ++bytes;
  std::uint32_t code = bytes == 2 ? lead & 0x1FU : bytes == 3 ? lead & 0x0FU : lead & 0x07U;
  for (std::size_t i = 1; i < bytes; ++i) code = (code << 6U) | (static_cast<unsigned char>(text[offset + i]) & 0x3FU);
  return {code, bytes};
}

std::int64_t IndexOf(std::string_view text, std::uint32_t code) {
  std::int64_t index = 0;
  for (std::size_t offset = 0; offset < text.size(); ++index) {
    const Character character = CharacterAt(text, offset);
    if (character.code == code) return index;
    offset += character.bytes;
  }
  return -1;
}

std::int64_t LastIndexOf(std::string_view text, std::uint32_t code) {
  std::int64_t index = 0;
  std::int64_t found = -1;
  for (std::size_t offset = 0; offset < text.size(); ++index) {
    const Character character = CharacterAt(text, offset);
    if (character.code == code) found = index;
    offset += character.bytes;
  }
  return found;
}

std::int64_t IndexOfAny(std::string_view text, std::string_view set) {
  std::int64_t index = 0;
  for (std::size_t offset = 0; offset < text.size(); ++index) {
    const Character character = CharacterAt(text, offset);
    if (IndexOf(set, character.code) >= 0) return index;
    offset += character.bytes;
  }
  return -1;
}

std::int64_t Find(std::string_view text, std::string_view part) {
  const std::size_t offset = text.find(part);
  return offset == std::string_view::npos ? -1 : PositionOf(text, offset);
}

std::string_view Substring(std::string_view text, std::size_t first, std::size_t count) {
  text.remove_prefix(OffsetOf(text, first));
  return text.substr(0, OffsetOf(text, count));
}

void AppendUpper(TextBuffer& buffer, std::string_view text) {
  char* out = buffer.Reserve(text.size());
  buffer.SetEnd(std::ranges::transform(text, out, Upper).out);
}

void AppendLower(TextBuffer& buffer, std::string_view text) {
  char* out = buffer.Reserve(text.size());
  buffer.SetEnd(std::ranges::transform(text, out, Lower).out);
}

bool SameName(std::string_view a, std::string_view b) { return EqualIgnoringCase(a, b); }

}  // namespace ncport::ir::ops
