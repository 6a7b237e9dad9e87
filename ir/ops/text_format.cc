// SPRINT.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "base/number_text.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/text.h"

namespace ncport::ir::ops {
namespace {

constexpr unsigned kMaxWidth = 200;  // longest text of the language

struct Conversion {
  bool left = false;
  bool zeros = false;
  unsigned width = 0;
  unsigned precision = 0;
  bool has_precision = false;
  char letter = 0;
};

unsigned ReadDigits(std::string_view format, std::size_t& at) {
  unsigned value = 0;
  for (; at < format.size() && format[at] >= '0' && format[at] <= '9'; ++at) {
    if (value <= kMaxWidth) value = value * 10 + static_cast<unsigned>(format[at] - '0');
  }
  return value;
}

/// Reads what follows a percent sign; letter 0 if the format ends there.
Conversion Read(std::string_view format, std::size_t& at) {
  Conversion conversion;
  for (; at < format.size() && (format[at] == '-' || format[at] == '0'); ++at) {
    (format[at] == '-' ? conversion.left : conversion.zeros) = true;
  }
  conversion.width = ReadDigits(format, at);
  if (at < format.size() && format[at] == '.') {
    ++at;
    conversion.has_precision = true;
    conversion.precision = ReadDigits(format, at);
  }
  if (at < format.size()) conversion.letter = format[at++];
  return conversion;
}

void Pad(TextBuffer& buffer, const Conversion& conversion, std::string_view text) {
  const std::size_t length = Length(text);
  const std::size_t fill = length < conversion.width ? conversion.width - length : 0;
  const bool zeros = conversion.zeros && !conversion.left;
  if (zeros && fill > 0 && !text.empty() && text.front() == '-') {
    buffer.Append('-');
    text.remove_prefix(1);
  }
  if (!conversion.left) {
    for (std::size_t i = 0; i < fill; ++i) buffer.Append(zeros ? '0' : ' ');
  }
  buffer.Append(text);
  if (conversion.left) {
    for (std::size_t i = 0; i < fill; ++i) buffer.Append(' ');
  }
}

Error AppendOne(TextBuffer& buffer, const Conversion& conversion, const FormatValue& value) {
  fmt::memory_buffer text;
  const unsigned precision = conversion.has_precision ? conversion.precision : 6;
  if (conversion.letter == 's') {
    if (!value.is_text) {
      TextBuffer number;
      AppendNumberText(number, value.number);
      Pad(buffer, conversion, number.View());
      return Error::kNone;
    }
    Pad(buffer, conversion, conversion.has_precision ? Substring(value.text, 0, conversion.precision) : value.text);
    return Error::kNone;
  }
  if (value.is_text || precision > kMaxWidth) return Error::kConversion;
  const auto out = std::back_inserter(text);
  const double whole = Round(value.number);
  switch (conversion.letter) {
    case 'd':
      fmt::format_to(out, "{:.0f}", whole + 0.0);
      break;
    case 'f':
      fmt::format_to(out, "{:.{}f}", value.number, precision);
      break;
    case 'e':
      fmt::format_to(out, "{:.{}e}", value.number, precision);
      break;
    case 'g':
      fmt::format_to(out, "{:.{}g}", value.number, precision == 0 ? 1 : precision);
      break;
    case 'x':
    case 'b': {
      if (!(std::fabs(whole) <= 4294967295.0)) return Error::kConversion;
      const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
      if (conversion.letter == 'x') {
        fmt::format_to(out, "{:X}", bits);
      } else {
        fmt::format_to(out, "{:b}", bits);
      }
      break;
    }
    case 'c': {
      if (!(whole >= 0 && whole <= 255)) return Error::kConversion;
      TextBuffer character;
      AppendCharacter(character, whole);
      Pad(buffer, conversion, character.View());
      return Error::kNone;
    }
    default:
      return Error::kConversion;
  }
  Pad(buffer, conversion, {text.data(), text.size()});
  return Error::kNone;
}

}  // namespace

Error Format(TextBuffer& buffer, std::string_view format, std::span<const FormatValue> values) {
  std::size_t next = 0;
  for (std::size_t at = 0; at < format.size();) {
    if (format[at] != '%') {
      buffer.Append(format[at++]);
      continue;
    }
    ++at;
    const Conversion conversion = Read(format, at);
    if (conversion.letter == '%') {
      buffer.Append('%');
      continue;
    }
    if (next >= values.size() || conversion.width > kMaxWidth) return Error::kConversion;
    const Error error = AppendOne(buffer, conversion, values[next++]);
    if (error != Error::kNone) return error;
  }
  return Error::kNone;
}

void AppendFixedText(TextBuffer& buffer, double value, int whole, int decimals, bool pads) {
  // Rounded as decimals, halves away from zero: the number that stands there is what is cut.
  TextBuffer digits;
  AppendNumber(digits, std::fabs(value), 1, static_cast<std::uint8_t>(decimals), decimals > 0);
  std::string_view text = digits.View();
  const std::size_t point = std::min(text.find('.'), text.size());
  bool zero = true;
  for (const char c : text) zero = zero && (c == '0' || c == '.');
  if (point > static_cast<std::size_t>(whole)) text.remove_prefix(point - static_cast<std::size_t>(whole));
  const std::size_t kept = std::min(text.find('.'), text.size());
  if (pads) {
    buffer.Append(value < 0 && !zero ? '-' : ' ');
    for (std::size_t i = kept; i < static_cast<std::size_t>(whole); ++i) buffer.Append(' ');
  } else if (value < 0 && !zero) {
    buffer.Append('-');
  }
  buffer.Append(text);
}

}  // namespace ncport::ir::ops
