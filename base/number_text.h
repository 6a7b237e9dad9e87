// Numbers of NC programs as text: plain decimals, no exponent, no locale. Literals keep their written form; computed
// values are rounded once, exactly.
#pragma once

#include <cstdint>

#include "base/text_buffer.h"

namespace ncport {

/// A decimal literal and how it was written: "-007.50" is {-7.5, 3, 2, true, true}.
struct DecimalText {
  double value = 0;             // nearest double
  std::uint8_t int_digits = 0;  // digits before the point as written, 0 for ".5"
  std::uint8_t decimals = 0;    // digits behind the point as written, 0 for "5."
  bool has_point = false;
  bool exact =
      false;  // AppendNumber of these fields gives the same text; false for a plus sign and for digits a double lacks
};

/// Reads [+-] digits [. digits] with at least one digit, as long as it goes. On success `p` stands behind it. On
/// failure (no digit) `p` stays and `number` is unchanged. A literal too large for a double gives infinity; callers
/// refuse it.
bool ParseDecimal(const char*& p, const char* end, DecimalText& number);

/// Appends `value` with exactly `decimals` digits behind the point and at least `int_digits` before it (leading zeros;
/// 0 leaves out a zero before the point). `has_point` writes the point also when no decimal follows. A negative zero
/// gets its sign, as it was written so. Rounds the exact value of the double, halves away from zero. Infinity and NaN
/// are a bug of the caller.
void AppendNumber(TextBuffer& buffer, double value, std::uint8_t int_digits, std::uint8_t decimals, bool has_point);

/// Appends `value` with at most `max_decimals` decimals: no trailing zeros, no point without decimals, no exponent, -0
/// as 0. Rounds like AppendNumber. Infinity and NaN are a bug of the caller.
void AppendTrimmed(TextBuffer& buffer, double value, int max_decimals);

/// Appends a whole number.
void AppendInteger(TextBuffer& buffer, std::int64_t value);

}  // namespace ncport
