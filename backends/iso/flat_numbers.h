// Coordinates of flat blocks as whole increments of the target: rounded once, exactly, and printed from there, so that
// what the next arc starts from is what stands in the text.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/text_buffer.h"

namespace ncport::backends::iso {

/// Largest magnitude that a flat word may have, in increments: what a double and a reader of eight to twelve digits
/// hold.
inline constexpr double kMaxIncrements = 1e12;

/// `value * scale` as a whole number, rounded from the exact product, halves away from zero. |value * scale| must be
/// below 2^53 (see kMaxIncrements).
inline std::int64_t RoundToIncrements(double value, double scale) {
  const double product = value * scale;
  auto whole = static_cast<std::int64_t>(product);
  const double rest = product - static_cast<double>(whole);  // exact: both are near
  const std::int64_t away = product < 0 ? -1 : 1;
  if (std::fabs(rest) > 0.5) return whole + away;
  if (std::fabs(rest) < 0.5) return whole;
  // A tie in double: the part of the product that did not fit decides.
  const double lost = std::fma(value, scale, -product);
  return lost * static_cast<double>(away) < 0 ? whole : whole + away;
}

/// Appends a letter and a number with a point and at most `decimals` decimals, no trailing zeros: `X10.`, `Z-0.25`.
void AppendWord(TextBuffer& out, char letter, std::int64_t increments, int decimals);

/// Ten to the power of `decimals` (0 to 9).
double ScaleOf(int decimals);

}  // namespace ncport::backends::iso
