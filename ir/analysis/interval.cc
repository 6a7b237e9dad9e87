#include "ir/analysis/interval.h"

#include <algorithm>
#include <cmath>

#include "ir/comparison.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/convert.h"

namespace ncport::ir::analysis {

namespace {

constexpr double kExact = 9007199254740992.0;  // whole numbers up to here are exact

/// What a computed value keeps of its operands.
std::uint8_t Sources(const Interval& a, const Interval& b) {
  return static_cast<std::uint8_t>(((a.flags | b.flags) & Interval::kInput) | (a.flags & b.flags & Interval::kInteger));
}

bool BothWhole(const Interval& a, const Interval& b) { return a.Has(Interval::kWhole) && b.Has(Interval::kWhole); }

/// Bounds as computed, with the room that the rounding of doubles needs.
Interval Enclose(double low, double high, bool whole, std::uint8_t flags) {
  if (low == kInfinity || high == -kInfinity) return Interval::None();  // all of them are too large
  Interval result{low, high, flags};
  if (whole) result.flags |= Interval::kWhole;
  if (whole && std::fabs(low) < kExact && std::fabs(high) < kExact) return result;
  return Outward(result);
}

/// Product of bounds: 0 times infinity is 0, for the infinite bound stands for finite numbers.
double Times(double a, double b) { return a == 0 || b == 0 ? 0.0 : a * b; }

Interval FromKernel(const ops::Number& number, std::uint8_t flags) {
  if (!number.Ok()) return Interval::None();
  Interval result = Interval::Point(number.value);
  result.flags |= flags;
  return result;
}

}  // namespace

Interval Interval::Point(double value) {
  Interval result{value, value, 0};
  if (value == std::trunc(value)) result.flags |= kWhole;
  result.flags |= value == 0 ? kZeroSeen : kNonZero;
  return result;
}

Interval Outward(Interval a) {
  if (a.low > -kInfinity) a.low = std::nextafter(a.low, -kInfinity);
  if (a.high < kInfinity) a.high = std::nextafter(a.high, kInfinity);
  return a;
}

Interval Join(const Interval& a, const Interval& b) {
  if (a.IsNone()) return b;
  if (b.IsNone()) return a;
  constexpr std::uint8_t kAny = Interval::kVacant | Interval::kInput | Interval::kZeroSeen | Interval::kTested;
  constexpr std::uint8_t kBoth = Interval::kWhole | Interval::kNonZero | Interval::kInteger | Interval::kEntry;
  // A side without a number says nothing of numbers.
  const std::uint8_t of_a = a.HasNumber() ? a.flags : static_cast<std::uint8_t>(a.flags | kBoth);
  const std::uint8_t of_b = b.HasNumber() ? b.flags : static_cast<std::uint8_t>(b.flags | kBoth);
  Interval result{std::min(a.low, b.low), std::max(a.high, b.high), 0};
  result.flags = static_cast<std::uint8_t>(((of_a | of_b) & kAny) | (of_a & of_b & kBoth));
  // 0 outside of one side is not among its values.
  const bool zero = a.HasZero() || b.HasZero();
  if (zero) {
    result.flags &= static_cast<std::uint8_t>(~Interval::kNonZero);
  } else {
    result.flags |= Interval::kNonZero;
    result.flags &= static_cast<std::uint8_t>(~Interval::kZeroSeen);
  }
  return result;
}

Interval Meet(const Interval& a, const Interval& b) {
  Interval result = a;
  result.low = std::max(a.low, b.low);
  result.high = std::min(a.high, b.high);
  result.flags |= b.flags & (Interval::kWhole | Interval::kNonZero);
  if (!b.Has(Interval::kVacant)) result.flags &= static_cast<std::uint8_t>(~Interval::kVacant);
  if (result.Has(Interval::kWhole)) {
    result.low = std::ceil(result.low);
    result.high = std::floor(result.high);
  }
  if (result.Has(Interval::kNonZero)) {
    const double step = result.Has(Interval::kWhole) ? 1.0 : std::numeric_limits<double>::denorm_min();
    if (result.low == 0) result.low = step;
    if (result.high == 0) result.high = -step;
    result.flags &= static_cast<std::uint8_t>(~Interval::kZeroSeen);
  }
  if (!result.HasNumber()) {
    result.low = kInfinity;
    result.high = -kInfinity;
  } else if (!result.HasZero()) {
    result.flags &= static_cast<std::uint8_t>(~Interval::kZeroSeen);
  }
  return result;
}

Interval WithoutZero(const Interval& a) {
  return Meet(a,
              {-kInfinity, kInfinity, static_cast<std::uint8_t>(Interval::kNonZero | (a.flags & Interval::kVacant))});
}

Interval WithoutVacant(Interval a) {
  a.flags &= static_cast<std::uint8_t>(~Interval::kVacant);
  return a;
}

Interval VacantAsZero(const Interval& a) {
  if (!a.Has(Interval::kVacant)) return a;
  Interval zero = Interval::Point(0);
  zero.flags |= a.flags & (Interval::kInput | Interval::kEntry);
  if (a.Has(Interval::kInput)) zero.flags &= static_cast<std::uint8_t>(~Interval::kZeroSeen);
  Interval numbers = WithoutVacant(a);
  return numbers.HasNumber() ? Join(numbers, zero) : zero;
}

Interval Negated(const Interval& a) {
  if (!a.HasNumber()) return a;
  constexpr std::uint8_t kKept = Interval::kWhole | Interval::kNonZero | Interval::kInteger | Interval::kInput |
                                 Interval::kZeroSeen | Interval::kEntry | Interval::kTested;
  return {0.0 - a.high, 0.0 - a.low, static_cast<std::uint8_t>(a.flags & kKept)};
}

Interval Sum(const Interval& a, const Interval& b) {
  if (!a.HasNumber() || !b.HasNumber()) return Interval::None();
  const std::uint8_t flags = Sources(a, b);
  if (a.IsPoint() && b.IsPoint()) return FromKernel(ops::Add(a.low, b.low), flags);
  return Enclose(a.low + b.low, a.high + b.high, BothWhole(a, b), flags);
}

Interval Difference(const Interval& a, const Interval& b) {
  if (!a.HasNumber() || !b.HasNumber()) return Interval::None();
  const std::uint8_t flags = Sources(a, b);
  if (a.IsPoint() && b.IsPoint()) return FromKernel(ops::Subtract(a.low, b.low), flags);
  return Enclose(a.low - b.high, a.high - b.low, BothWhole(a, b), flags);
}

Interval Product(const Interval& a, const Interval& b) {
  if (!a.HasNumber() || !b.HasNumber()) return Interval::None();
  const std::uint8_t flags = Sources(a, b);
  if (a.IsPoint() && b.IsPoint()) return FromKernel(ops::Multiply(a.low, b.low), flags);
  const double corners[] = {Times(a.low, b.low), Times(a.low, b.high), Times(a.high, b.low), Times(a.high, b.high)};
  const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
  return Enclose(*low, *high, BothWhole(a, b), flags);
}

namespace {

/// `divide` is a / b, or a / b cut: both grow with a and fall with b on one side of 0.
template <class Divide>
Interval OverOneSide(const Interval& a, double low, double high, Divide divide) {
  const double corners[] = {divide(a.low, low), divide(a.low, high), divide(a.high, low), divide(a.high, high)};
  const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
  return {*least, *most, 0};
}

/// Bounds of the quotient by divisors on both sides of 0, without 0.
template <class Divide>
Interval OverDivisors(const Interval& a, const Interval& b, Divide divide) {
  const double tiny = b.Has(Interval::kWhole) ? 1.0 : std::numeric_limits<double>::denorm_min();
  Interval result = Interval::None();
  if (b.high > 0) result = OverOneSide(a, std::max(b.low, tiny), b.high, divide);
  if (b.low < 0) {
    const Interval other = OverOneSide(a, b.low, std::min(b.high, -tiny), divide);
    result =
        result.HasNumber() ? Interval{std::min(result.low, other.low), std::max(result.high, other.high), 0} : other;
  }
  return result;
}

double Over(double a, double b) {
  if (std::isinf(a) && std::isinf(b)) return (a > 0) == (b > 0) ? kInfinity : -kInfinity;
  return std::isinf(b) ? 0.0 : a / b;
}

}  // namespace

Interval Quotient(const Interval& a, const Interval& b) {
  if (!a.HasNumber() || !b.HasNumber() || b.IsZero()) return Interval::None();
  const auto flags = static_cast<std::uint8_t>(Sources(a, b) & ~Interval::kInteger);
  if (a.IsPoint() && b.IsPoint()) return FromKernel(ops::Divide(a.low, b.low), flags);
  Interval result = OverDivisors(a, b, Over);
  // Infinity over infinity reaches down to 0 as well.
  if (std::isinf(a.low) || std::isinf(a.high)) {
    if (std::isinf(b.low) || std::isinf(b.high)) {
      result.low = std::min(result.low, 0.0);
      result.high = std::max(result.high, 0.0);
    }
  }
  return Enclose(result.low, result.high, false, flags);
}

Interval WholeQuotient(const Interval& a, const Interval& b) {
  if (!a.HasNumber() || !b.HasNumber() || b.IsZero()) return Interval::None();
  const std::uint8_t flags = Sources(a, b);
  if (a.IsPoint() && b.IsPoint()) return FromKernel(ops::DivideInteger(a.low, b.low), flags);
  return Cut(Quotient(a, b));
}

Interval Remainder(const Interval& a, const Interval& b) {
  if (!a.HasNumber() || !b.HasNumber() || b.IsZero()) return Interval::None();
  const std::uint8_t flags = Sources(a, b);
  if (a.IsPoint() && b.IsPoint()) return FromKernel(ops::Modulo(a.low, b.low), flags);
  const double divisor = std::max(std::fabs(b.low), std::fabs(b.high));
  const double dividend = std::max(std::fabs(a.low), std::fabs(a.high));
  const bool whole = BothWhole(a, b) && dividend < 1e15 && divisor < 1e15;
  // The steps of the kernel are rounded: a quotient rounded up to the next whole number turns the sign of a tiny
  // remainder, and where the quotient is large the error is that of the dividend.
  const double slack = whole ? 0.0 : dividend * 1e-15;
  const double most = whole ? std::min(divisor - 1, dividend) : std::min(divisor, dividend) + slack;
  return Enclose(a.low < 0 ? -most : -slack, a.high > 0 ? most : slack, whole, flags);
}

namespace {

template <class Step>
Interval ByWholeSteps(const Interval& a, Step step) {
  if (!a.HasNumber()) return Interval::None();
  constexpr std::uint8_t kKept = Interval::kInput | Interval::kEntry | Interval::kInteger | Interval::kTested;
  Interval result{std::isinf(a.low) ? a.low : step(a.low), std::isinf(a.high) ? a.high : step(a.high), 0};
  result.flags = static_cast<std::uint8_t>((a.flags & kKept) | Interval::kWhole);
  if (a.Has(Interval::kWhole)) result.flags |= a.flags & (Interval::kNonZero | Interval::kZeroSeen);
  if (!result.HasZero()) result.flags |= Interval::kNonZero;
  return result;
}

}  // namespace

Interval Rounded(const Interval& a) { return ByWholeSteps(a, ops::Round); }
Interval Cut(const Interval& a) {
  return ByWholeSteps(a, [](double value) { return std::trunc(value) + 0.0; });
}

Interval Converted(const Interval& a, Type type, const Machine& machine) {
  switch (type) {
    case Type::kInt: {
      Interval result =
          Meet(Rounded(a), {static_cast<double>(machine.int_min), static_cast<double>(machine.int_max), 0});
      result.flags |= Interval::kInteger;
      return result;
    }
    case Type::kChar: {
      Interval result = Meet(Rounded(a), {0, 255, 0});
      result.flags |= Interval::kInteger;
      return result;
    }
    case Type::kBool: {
      Interval result = Truth(a);
      result.flags |= a.flags & (Interval::kInput | Interval::kEntry);
      return result;
    }
    case Type::kReal: {
      Interval result = a;
      result.flags &= static_cast<std::uint8_t>(~(Interval::kInteger | Interval::kVacant));
      return result;
    }
    case Type::kNumber:
    case Type::kAny:
    case Type::kNone:
      return a;
    default:
      return Interval::Unknown();
  }
}

Interval Bool(bool may_be_false, bool may_be_true) {
  if (!may_be_false && !may_be_true) return Interval::None();
  Interval result{may_be_false ? 0.0 : 1.0, may_be_true ? 1.0 : 0.0, Interval::kWhole | Interval::kInteger};
  if (!may_be_false) result.flags |= Interval::kNonZero;
  if (!may_be_true) result.flags |= Interval::kZeroSeen;
  return result;
}

Interval Truth(const Interval& a) {
  const bool may_be_true = a.HasNumber() && !(a.low == 0 && a.high == 0);
  return Bool(a.HasZero() || a.Has(Interval::kVacant), may_be_true);
}

namespace {

/// Room that a relative tolerance takes beside a bound. Infinite bounds have none.
double Slack(double bound, double tolerance) {
  return tolerance == 0 || std::isinf(bound) ? 0.0 : 2 * tolerance * std::fabs(bound);
}

}  // namespace

Interval Compared(ExprOp op, const Interval& left, const Interval& right, double tolerance) {
  const Interval a = VacantAsZero(left);
  const Interval b = VacantAsZero(right);
  if (!a.HasNumber() || !b.HasNumber()) return Interval::None();
  const auto flags = static_cast<std::uint8_t>((a.flags | b.flags) & Interval::kInput);
  bool may_be_true = true;
  bool may_be_false = true;
  if (a.IsPoint() && b.IsPoint()) {
    const bool equal = ops::Equal(a.low, b.low, tolerance);
    const bool less = ops::Less(a.low, b.low, tolerance);
    const bool greater = ops::Less(b.low, a.low, tolerance);
    const bool holds = op == ExprOp::kEqual       ? equal
                       : op == ExprOp::kNotEqual  ? !equal
                       : op == ExprOp::kLess      ? less
                       : op == ExprOp::kLessEqual ? !greater
                       : op == ExprOp::kGreater   ? greater
                                                  : !less;
    may_be_true = holds;
    may_be_false = !holds;
  } else {
    const Interval yes = Constrained(op, a, b, tolerance);
    const Interval yes_right = Constrained(Swapped(op), b, a, tolerance);
    may_be_true = yes.HasNumber() && yes_right.HasNumber();
    const ExprOp other = Negated(op);
    may_be_false =
        Constrained(other, a, b, tolerance).HasNumber() && Constrained(Swapped(other), b, a, tolerance).HasNumber();
  }
  Interval result = Bool(may_be_false, may_be_true);
  result.flags |= flags;
  return result;
}

Interval Constrained(ExprOp op, const Interval& a, const Interval& b, double tolerance) {
  if (!b.HasNumber()) return Interval::None();
  const bool whole = a.Has(Interval::kWhole) && a.low > -kExact && a.high < kExact;
  Interval limit{-kInfinity, kInfinity, static_cast<std::uint8_t>(a.flags & Interval::kVacant)};
  switch (op) {
    case ExprOp::kEqual:
      limit.low = b.low - Slack(b.low, tolerance);
      limit.high = b.high + Slack(b.high, tolerance);
      if (b.Has(Interval::kNonZero)) limit.flags |= Interval::kNonZero;
      break;
    case ExprOp::kNotEqual:
      if (!b.IsPoint()) break;
      if (b.low == 0) {
        limit.flags |= Interval::kNonZero;
      } else if (whole) {
        // A whole bound that is excluded moves by one.
        if (a.low == b.low) limit.low = b.low + 1;
        if (a.high == b.low) limit.high = b.low - 1;
      } else if (a.IsPoint() && ops::Equal(a.low, b.low, tolerance)) {
        return Interval::None();
      }
      break;
    case ExprOp::kLess:
      limit.high = b.high;
      if (whole) limit.high = std::ceil(b.high) - 1;
      if (!whole && !std::isinf(b.high)) limit.high = std::nextafter(b.high, -kInfinity);
      break;
    case ExprOp::kLessEqual:
      limit.high = b.high + Slack(b.high, tolerance);
      break;
    case ExprOp::kGreater:
      limit.low = b.low;
      if (whole) limit.low = std::floor(b.low) + 1;
      if (!whole && !std::isinf(b.low)) limit.low = std::nextafter(b.low, kInfinity);
      break;
    case ExprOp::kGreaterEqual:
      limit.low = b.low - Slack(b.low, tolerance);
      break;
    default:
      return a;
  }
  // An empty value compares as 0.
  if (a.Has(Interval::kVacant) && !limit.Holds(0)) limit.flags &= static_cast<std::uint8_t>(~Interval::kVacant);
  Interval result = Meet(a, limit);
  if (result.low != a.low || result.high != a.high) {
    result.flags |= Interval::kTested;
    if (!a.HasNumber() || !result.HasZero()) result.flags &= static_cast<std::uint8_t>(~Interval::kTested);
  }
  return result;
}

}  // namespace ncport::ir::analysis
