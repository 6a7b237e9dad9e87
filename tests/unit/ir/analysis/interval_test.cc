#include "ir/analysis/interval.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "ir/ops/arithmetic.h"
#include "ir/ops/convert.h"
#include "ir/ops/functions.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

/// The same numbers in every run.
class Numbers {
 public:
  std::uint64_t Bits() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return state_ >> 33U;
  }
  double Number() {
    constexpr double kTelling[] = {0, 1, -1, 0.5, -0.5, 2, 90, -90, 180, 360, 1e-9, 1e9, 2147483647, -2147483648.0};
    switch (Bits() % 4) {
      case 0:
        return kTelling[Bits() % 14];
      case 1:
        return static_cast<double>(Bits() % 21) - 10;
      case 2:
        return (static_cast<double>(Bits() % 200001) - 100000) / 1000;
      default:
        return (static_cast<double>(Bits() % 2000001) - 1000000) * 12.5;
    }
  }
  Interval Range(double inside) {
    Interval range{std::fmin(inside, Number()), inside, 0};
    range.high = std::fmax(inside, Number());
    if (Bits() % 5 == 0) range = Interval::Point(inside);
    if (Bits() % 9 == 0) range.low = -kInfinity;
    if (Bits() % 9 == 0) range.high = kInfinity;
    const bool whole = inside == std::trunc(inside);
    if (whole && Bits() % 2 == 0) {
      range.low = std::ceil(range.low);
      range.high = std::floor(range.high);
      range.flags |= Interval::kWhole;
    }
    if (inside != 0 && Bits() % 3 == 0) range.flags |= Interval::kNonZero;
    return range;
  }

 private:
  std::uint64_t state_ = 42;
};

void CheckInside(const Interval& range, const ops::Number& number, int operation, double a, double b) {
  if (!number.Ok()) return;
  const bool inside = range.HasNumber() && range.Holds(number.value) &&
                      (!range.Has(Interval::kWhole) || number.value == std::trunc(number.value));
  if (!inside) {
    CAPTURE(operation);
    CAPTURE(a);
    CAPTURE(b);
    CAPTURE(number.value);
    CAPTURE(range.low);
    CAPTURE(range.high);
    CHECK(inside);
  }
}

}  // namespace

TEST_CASE("intervals hold what the kernel gives") {
  Numbers numbers;
  Machine machine;
  for (int i = 0; i < 200000; ++i) {
    const double a = numbers.Number();
    const double b = numbers.Number();
    const Interval left = numbers.Range(a);
    const Interval right = numbers.Range(b);
    CheckInside(Sum(left, right), ops::Add(a, b), 1, a, b);
    CheckInside(Difference(left, right), ops::Subtract(a, b), 2, a, b);
    CheckInside(Product(left, right), ops::Multiply(a, b), 3, a, b);
    CheckInside(Quotient(left, right), ops::Divide(a, b), 4, a, b);
    CheckInside(WholeQuotient(left, right), ops::DivideInteger(a, b), 5, a, b);
    CheckInside(Remainder(left, right), ops::Modulo(a, b), 6, a, b);
    CheckInside(Rounded(left), {ops::Round(a), ops::Error::kNone}, 7, a, b);
    CheckInside(Negated(left), {0.0 - a, ops::Error::kNone}, 8, a, b);
    CheckInside(Converted(left, Type::kInt, machine), ops::Convert(a, Type::kInt, machine), 9, a, b);
    CheckInside(Converted(left, Type::kBool, machine), ops::Convert(a, Type::kBool, machine), 10, a, b);
    CheckInside(Join(left, right), {i % 2 == 0 ? a : b, ops::Error::kNone}, 11, a, b);
  }
}

TEST_CASE("intervals of functions hold what the kernel gives") {
  Numbers numbers;
  Machine machine;
  for (int i = 0; i < 200000; ++i) {
    const auto function =
        static_cast<Function>(numbers.Bits() % (static_cast<unsigned>(Function::kAddDecimalPoint) + 1));
    double values[3];
    Interval ranges[3];
    for (int arg = 0; arg < 3; ++arg) {
      values[arg] = numbers.Number();
      ranges[arg] = numbers.Range(values[arg]);
    }
    const std::size_t count = ArityOf(function).least;
    CheckInside(Apply(function, ranges, count, machine), ops::Apply(function, values, count, machine),
                100 + static_cast<int>(function), values[0], values[1]);
  }
}

TEST_CASE("intervals: comparisons and what they say of their sides") {
  Numbers numbers;
  constexpr ExprOp kOps[] = {ExprOp::kEqual,     ExprOp::kNotEqual, ExprOp::kLess,
                             ExprOp::kLessEqual, ExprOp::kGreater,  ExprOp::kGreaterEqual};
  for (int i = 0; i < 200000; ++i) {
    const ExprOp op = kOps[numbers.Bits() % 6];
    const double tolerance = numbers.Bits() % 2 == 0 ? 0 : 1e-12;
    const double a = numbers.Number();
    const double b = numbers.Bits() % 3 == 0 ? a * (1 + 1e-13) : numbers.Number();
    const Interval left = numbers.Range(a);
    const Interval right = numbers.Range(b);
    const bool equal = ops::Equal(a, b, tolerance);
    const bool less = ops::Less(a, b, tolerance);
    const bool greater = ops::Less(b, a, tolerance);
    const bool holds = op == ExprOp::kEqual       ? equal
                       : op == ExprOp::kNotEqual  ? !equal
                       : op == ExprOp::kLess      ? less
                       : op == ExprOp::kLessEqual ? !greater
                       : op == ExprOp::kGreater   ? greater
                                                  : !less;
    const ops::Number truth{holds ? 1.0 : 0.0, ops::Error::kNone};
    CheckInside(Compared(op, left, right, tolerance), truth, 200 + static_cast<int>(op), a, b);
    if (holds)
      CheckInside(Constrained(op, left, right, tolerance), {a, ops::Error::kNone}, 300 + static_cast<int>(op), a, b);
  }
}

TEST_CASE("intervals: zero and vacant values") {
  CHECK(Interval::Point(0).HasZero());
  CHECK_FALSE(WithoutZero({0, 5, 0}).HasZero());
  CHECK(WithoutZero({0, 5, Interval::kWhole}).low == 1);
  CHECK_FALSE(Join({1, 5, 0}, {-5, -1, 0}).HasZero());
  CHECK(Join({1, 5, Interval::kNonZero}, Interval::Point(0)).HasZero());
  CHECK(Quotient({1, 1, 0}, {0, 0, 0}).IsNone());
  Interval vacant = Interval::None();
  vacant.flags = Interval::kVacant;
  CHECK(VacantAsZero(vacant).IsZero());
  CHECK_FALSE(vacant.IsNone());
  CHECK(Truth(vacant).high == 0);
}
