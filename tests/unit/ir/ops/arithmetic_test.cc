#include "ir/ops/arithmetic.h"

#include <doctest/doctest.h>

#include <limits>

#include "ir/ops/convert.h"
#include "ir/ops/functions.h"

namespace ncport::ir::ops {

TEST_CASE("division and overflow are errors, not values") {
  CHECK(Divide(3, 4).value == 0.75);
  CHECK(Divide(1, 0).error == Error::kDivisionByZero);
  CHECK(Modulo(1, 0).error == Error::kDivisionByZero);
  CHECK(DivideInteger(1, 0).error == Error::kDivisionByZero);
  const double large = std::numeric_limits<double>::max();
  CHECK(Multiply(large, 2).error == Error::kOverflow);
  CHECK(Add(large, large).error == Error::kOverflow);
  CHECK(Subtract(-large, large).error == Error::kOverflow);
  CHECK(Divide(large, 0.1).error == Error::kOverflow);
}

TEST_CASE("integer quotient and remainder of REAL operands (sinumerik-4.2, vector 66)") {
  CHECK(DivideInteger(7, 4.1).value == 1);
  CHECK(DivideInteger(7, 0.4).value == 17);
  CHECK(DivideInteger(-7, 2).value == -3);
  CHECK(Modulo(7, 4.1).value == doctest::Approx(2.9));
  CHECK(Modulo(-370, 360).value == -10);
  CHECK(Modulo(725.5, 360).value == 5.5);
  CHECK(Modulo(3, 4).value == 3);
  // The double 0.3 is less than three times the double 0.1: the remainder is nearly 0.1, as the card says of every
  // control.
  CHECK(Modulo(0.3, 0.1).value == doctest::Approx(0.1));
  // Quotient and remainder belong together even where the rounded quotient is a whole number that the exact one is not.
  for (const double a : {0.6, 1.1, 2.2, 4.35, 1e15 + 0.3}) {
    for (const double b : {0.1, 0.2, 0.7, 0.011})
      CHECK(DivideInteger(a, b).value * b + Modulo(a, b).value == doctest::Approx(a));
  }
}

TEST_CASE("relative tolerance of comparisons") {
  CHECK(Equal(0.1 + 0.2, 0.3, 1e-12));
  CHECK(!Equal(0.1 + 0.2, 0.3, 0));
  CHECK(!Less(0.3, 0.1 + 0.2, 1e-12));
  CHECK(Less(0.3, 0.1 + 0.2, 0));
  CHECK(!Equal(1, 1 + 1e-11, 1e-12));
  CHECK(!Equal(0, 1e-300, 1e-12));
}

TEST_CASE("rounding") {
  CHECK(Round(2.5) == 3);
  CHECK(Round(-2.5) == -3);
  CHECK(Round(-2.4) == -2);
  CHECK(RoundAway(1.2) == 2);
  CHECK(RoundAway(-0.001) == -1);
  CHECK(RoundToIncrement(2.0005, 0.001) == 2.001);
  CHECK(RoundToIncrement(-5.00098, 0.001) == -5.001);
  CHECK(RoundToIncrement(1.005, 0.01) == 1.01);  // the double is a little less than the half
  // -5.0075 as binary sums give it is a little above the half; both signs go away from zero.
  CHECK(RoundToIncrement(-21.63 / 4 + 0.4, 0.001) == -5.008);
  CHECK(RoundToIncrement(21.63 / 4 - 0.4, 0.001) == 5.008);
  CHECK(RoundToIncrement(100.0075 - 99.5, 0.001) == 0.508);
  CHECK(RoundToIncrement(0.00125, 0.001 / 10) == 0.0013);
  CHECK(RoundToIncrement(7.4999, 5) == 5);
  CHECK(RoundToIncrement(0.0004999, 0.001) == 0);
  CHECK(TruncateToIncrement(2.0009, 0.001) == 2.0);
  CHECK(TruncateToIncrement(0.3, 0.1) == 0.3);
  CHECK(TruncateToIncrement(-2.0009, 0.001) == -2.0);
}

TEST_CASE("controls that keep eight digits") {
  CHECK(ApplyModel(200.0 / 3, NumericModel::kDecimal8) == 66.666667);
  CHECK(ApplyModel(200.0 / 3, NumericModel::kBinary64) == 200.0 / 3);
  CHECK(ApplyModel(123456789, NumericModel::kDecimal8) == 123456790);
  CHECK(Store(100.0 / 3, NumericModel::kNum8).value == 33.333333);
  CHECK(Store(200.0 / 3, NumericModel::kNum8).value == 66.666666);
  CHECK(Store(2000.0 / 3, NumericModel::kNum8).value == 666.66666);
  CHECK(Store(12345678.0 / 8, NumericModel::kNum8).value == 1543209.7);
  CHECK(Store(15.449999999999998, NumericModel::kNum8).value == 15.45);
  CHECK(Store(1.0 / 3, NumericModel::kNum8).value == 0.33333333);
  CHECK(Store(-200.0 / 3, NumericModel::kNum8).value == -66.666666);
  CHECK(Store(100000000, NumericModel::kNum8).error == Error::kOverflow);
}

TEST_CASE("bits are 32 wide") {
  CHECK(Bits(BitOp::kAnd, 12, 10).value == 8);
  CHECK(Bits(BitOp::kOr, 12, 10).value == 14);
  CHECK(Bits(BitOp::kXor, 12, 10).value == 6);
  CHECK(BitNot(0).value == -1);
  CHECK(Bits(BitOp::kOr, 4294967295.0, 0).value == -1);
  CHECK(Bits(BitOp::kOr, 1e10, 0).error == Error::kConversion);
}

TEST_CASE("conversions check their range (sinumerik-3.4)") {
  Machine machine;
  CHECK(ToInt(2.5, machine).value == 3);
  CHECK(ToInt(-2.5, machine).value == -3);
  CHECK(ToIntCut(-2.9, machine).value == -2);
  CHECK(ToInt(3e9, machine).error == Error::kConversion);
  CHECK(ToChar(255.4).value == 255);
  CHECK(ToChar(256).error == Error::kConversion);
  CHECK(ToChar(-1).error == Error::kConversion);
  CHECK(Convert(0.2, Type::kBool, machine).value == 1);
  CHECK(Convert(0.2, Type::kReal, machine).value == 0.2);
}

TEST_CASE("functions of numbers") {
  Machine machine;
  const auto call = [&](Function function, double a, double b = 0, double c = 0) {
    const double args[] = {a, b, c};
    return Apply(function, args, ArityOf(function).least, machine);
  };
  CHECK(call(Function::kTruncate, -3.7).value == -3);
  CHECK(call(Function::kRoundUp, 3.1).value == 4);
  CHECK(call(Function::kRoundUp, -3.1).value == -3);
  CHECK(call(Function::kRoundAway, -3.1).value == -4);
  CHECK(call(Function::kRoundToIncrement, 2.00049).value == 2);
  CHECK(call(Function::kSqrt, -1).error == Error::kDomain);
  CHECK(call(Function::kSqrt, 25).value == 5);
  CHECK(call(Function::kLn, 0).error == Error::kDomain);
  CHECK(call(Function::kExp, 1000).error == Error::kOverflow);
  CHECK(call(Function::kPower, 2, 10).value == 1024);
  CHECK(call(Function::kPower, -2, 0.5).error == Error::kDomain);
  CHECK(call(Function::kPower, 0, -1).error == Error::kDivisionByZero);
  CHECK(call(Function::kMinimum, 3, -2).value == -2);
  CHECK(call(Function::kMaximum, 3, -2).value == 3);
  CHECK(call(Function::kBound, -5, 5, 7.2).value == 5);
  CHECK(call(Function::kBound, -5, 5, -7.2).value == -5);
  CHECK(call(Function::kBound, 5, -5, 0).error == Error::kDomain);
  CHECK(call(Function::kFactorial, 5).value == 120);
  CHECK(call(Function::kFactorial, 171).error == Error::kDomain);
  CHECK(call(Function::kFromBcd, 0x1234).value == 1234);
  CHECK(call(Function::kFromBcd, 0x1A).error == Error::kDomain);
  CHECK(call(Function::kToBcd, 1234).value == 0x1234);
  CHECK(call(Function::kToBcd, -1).error == Error::kDomain);
  CHECK(call(Function::kAsin, 1.1).error == Error::kDomain);
  CHECK(call(Function::kAtan2Positive, -1, -1).value == 225);
}

}  // namespace ncport::ir::ops
