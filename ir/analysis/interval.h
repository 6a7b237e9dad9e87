// Intervals of numbers: what is known of a value before the run. Operations enclose the results of ir/ops: every value
// that the kernel can give for operands inside the intervals lies inside the result (bounds are rounded outward; one
// known operand set is computed by the kernel itself). Results with an error of the kernel are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "ir/machine.h"
#include "ir/nodes.h"
#include "ir/ops/result.h"

namespace ncport::ir::analysis {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Values from `low` to `high`. An infinite bound means: as far as a double goes. No number at all: low > high.
struct Interval {
  double low = -kInfinity;
  double high = kInfinity;
  std::uint8_t flags = 0;

  static constexpr std::uint8_t kWhole = 1;    // whole numbers only
  static constexpr std::uint8_t kNonZero = 2;  // 0 is not among them
  static constexpr std::uint8_t kVacant = 4;   // or empty
  static constexpr std::uint8_t kInteger = 8;  // the value is of a whole type: INT, BOOL, CHAR
  static constexpr std::uint8_t kInput = 16;   // follows from something that only an operator or another program knows
  static constexpr std::uint8_t kEntry = 32;   // a parameter as the unknown caller gave it
  static constexpr std::uint8_t kZeroSeen = 64;  // some way really brings 0 here
  static constexpr std::uint8_t kTested = 128;   // a bound comes from a test of the program

  static constexpr Interval None() { return {kInfinity, -kInfinity, 0}; }
  static Interval Point(double value);
  static constexpr Interval Unknown(std::uint8_t flags = kInput) { return {-kInfinity, kInfinity, flags}; }

  [[nodiscard]] constexpr bool Has(std::uint8_t flag) const { return (flags & flag) != 0; }
  [[nodiscard]] constexpr bool HasNumber() const { return low <= high; }
  /// Neither a number nor empty: no run comes here.
  [[nodiscard]] constexpr bool IsNone() const { return !HasNumber() && !Has(kVacant); }
  [[nodiscard]] constexpr bool IsPoint() const { return low == high && !Has(kVacant); }
  [[nodiscard]] constexpr bool HasZero() const { return low <= 0 && high >= 0 && !Has(kNonZero); }
  [[nodiscard]] constexpr bool IsZero() const { return low == 0 && high == 0 && !Has(kVacant); }
  [[nodiscard]] constexpr bool Holds(double value) const {
    return value >= low && value <= high && (value != 0 || !Has(kNonZero));
  }
  [[nodiscard]] constexpr bool IsBounded() const { return low > -kInfinity && high < kInfinity; }
  bool operator==(const Interval&) const = default;
};

/// All values of both.
Interval Join(const Interval& a, const Interval& b);
/// Values of `a` that lie in `b` too; keeps what is known of their source.
Interval Meet(const Interval& a, const Interval& b);
/// `a` without 0.
Interval WithoutZero(const Interval& a);
/// Numbers only: the empty value counts as 0.
Interval VacantAsZero(const Interval& a);
Interval WithoutVacant(Interval a);
/// A little wider on both sides.
Interval Outward(Interval a);

Interval Negated(const Interval& a);
Interval Sum(const Interval& a, const Interval& b);
Interval Difference(const Interval& a, const Interval& b);
Interval Product(const Interval& a, const Interval& b);
/// Divisors other than 0.
Interval Quotient(const Interval& a, const Interval& b);
Interval WholeQuotient(const Interval& a, const Interval& b);
Interval Remainder(const Interval& a, const Interval& b);
Interval Rounded(const Interval& a);
Interval Cut(const Interval& a);
/// Functions of numbers (ops::IsNumeric).
Interval Apply(Function function, const Interval* args, std::size_t count, const Machine& machine);
/// As ops::Convert, values that fit only. Types that are no numbers: unknown.
Interval Converted(const Interval& a, Type type, const Machine& machine);

/// Whether a comparison holds: 0, 1 or both, as Interval of a BOOL.
Interval Compared(ExprOp op, const Interval& a, const Interval& b, double tolerance);
/// What is known of `a` when `a op b` holds.
Interval Constrained(ExprOp op, const Interval& a, const Interval& b, double tolerance);
/// 0, 1 or both.
Interval Truth(const Interval& a);
Interval Bool(bool may_be_false, bool may_be_true);

}  // namespace ncport::ir::analysis
