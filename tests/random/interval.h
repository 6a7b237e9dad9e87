// Bounds of values that the generator knows before any run: so no random program divides by zero or leaves the machine.
#pragma once

#include <algorithm>
#include <cmath>

namespace ncport::tests::random {

/// All values lie in [low, high]; `whole`: and are whole numbers.
struct Interval {
  double low = 0;
  double high = 0;
  bool whole = false;

  static constexpr Interval Point(double value) {
    return {value, value, value == static_cast<double>(static_cast<long long>(value))};
  }

  [[nodiscard]] bool Inside(const Interval& other) const {
    return low >= other.low && high <= other.high && (whole || !other.whole);
  }
  [[nodiscard]] double Magnitude() const { return std::max(std::fabs(low), std::fabs(high)); }
  /// No value nearer to zero than `distance`.
  [[nodiscard]] bool AwayFromZero(double distance) const { return low >= distance || high <= -distance; }
};

/// A little wider, so that the rounding of doubles cannot leave it. Whole numbers are exact.
inline Interval Widen(Interval a) {
  if (a.whole) return a;
  const double slack = 1e-9 * std::max(1.0, a.Magnitude());
  return {a.low - slack, a.high + slack, false};
}

inline Interval Hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high), a.whole && b.whole};
}
inline Interval operator-(const Interval& a) { return {-a.high, -a.low, a.whole}; }
inline Interval operator+(const Interval& a, const Interval& b) {
  return Widen({a.low + b.low, a.high + b.high, a.whole && b.whole});
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
inline Interval operator*(const Interval& a, const Interval& b) {
  const double corners[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return Widen({*std::min_element(corners, corners + 4), *std::max_element(corners, corners + 4), a.whole && b.whole});
}
/// `b` must be away from zero.
inline Interval operator/(const Interval& a, const Interval& b) {
  return Widen(Interval{a.low, a.high, false} * Interval{1 / b.high, 1 / b.low, false});
}
inline Interval Truncated(const Interval& a) { return {std::trunc(a.low), std::trunc(a.high), true}; }
inline Interval Rounded(const Interval& a) { return {std::round(a.low), std::round(a.high), true}; }
/// Remainder with the sign of the dividend.
inline Interval Remainder(const Interval& a, const Interval& b) {
  const bool whole = a.whole && b.whole;
  const double most = std::min(a.Magnitude(), b.Magnitude());
  return Widen({a.low < 0 ? -most : 0, a.high > 0 ? most : 0, whole});
}
inline Interval Absolute(const Interval& a) {
  const bool spans = a.low <= 0 && a.high >= 0;
  return {spans ? 0 : std::min(std::fabs(a.low), std::fabs(a.high)), a.Magnitude(), a.whole};
}
inline Interval Monotone(double (*function)(double), const Interval& a) {
  return Widen({function(a.low), function(a.high), false});
}

}  // namespace ncport::tests::random
