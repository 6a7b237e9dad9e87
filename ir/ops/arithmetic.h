// The arithmetic of all languages: pure functions on doubles. Folding, checks and the evaluator share them, so that a
// constant means the same everywhere. Results of doubles that are not finite are errors, never values.
#pragma once

#include <cmath>
#include <cstdint>

#include "ir/machine.h"
#include "ir/ops/result.h"

namespace ncport::ir::ops {

constexpr Number Finite(double value) {
  const bool finite = value - value == 0;  // false for infinities and NaN
  return finite ? Number{value, Error::kNone} : Fail(Error::kOverflow);
}

constexpr Number Add(double a, double b) { return Finite(a + b); }
constexpr Number Subtract(double a, double b) { return Finite(a - b); }
constexpr Number Multiply(double a, double b) { return Finite(a * b); }
/// Real quotient, also of whole numbers.
constexpr Number Divide(double a, double b) { return b == 0 ? Fail(Error::kDivisionByZero) : Finite(a / b); }
/// Quotient of the operands as they are, cut toward zero: 7 and 0.4 give 17, -7 and 2 give -3 (sinumerik-4.2). No
/// tolerance: 0.6 and 0.2 give 2, because the double 0.6 is smaller than three times the double 0.2.
Number DivideInteger(double a, double b);
/// a - b * DivideInteger(a, b): the fraction stays, the sign is that of `a`. Without the error of that formula: the
/// remainder of two doubles is exact.
Number Modulo(double a, double b);

/// |a - b| <= tolerance * larger magnitude; tolerance 0 = exact.
inline bool Equal(double a, double b, double tolerance) {
  if (a == b) return true;
  return tolerance != 0 && std::fabs(a - b) <= tolerance * std::fmax(std::fabs(a), std::fabs(b));
}
/// Less, and not equal within the tolerance.
inline bool Less(double a, double b, double tolerance) { return a < b && !Equal(a, b, tolerance); }

/// To the nearest whole number, halves away from zero.
double Round(double value);
/// Away from zero to the next whole number.
double RoundAway(double value);
/// To the nearest multiple of `increment` (> 0), halves away from zero; the result has no binary noise of the multiple.
/// A half that noise left a little short, as in -21.63/4+0.4, is a half: Round(value * StepsOf(increment).factor) /
/// per.
double RoundToIncrement(double value, double increment);
/// How many increments one unit holds, and the factor that counts them: larger by 1e-11 of itself or 1e-8, so that it
/// is written with eight decimals (sinumerik-2.1) and pushes what is a half but for noise over it, on both sides of 0.
struct IncrementSteps {
  double per = 1;
  double factor = 1;
};
IncrementSteps StepsOf(double increment);
/// As RoundToIncrement, but cuts toward zero. A value that is a multiple but for binary noise keeps it.
double TruncateToIncrement(double value, double increment);

/// Significant decimal digits that each result keeps; 0: all that a double holds.
constexpr int ResultDigits(NumericModel model) { return model == NumericModel::kDecimal8 ? 8 : 0; }

/// Result of an operation on a control that does not keep every digit. kNum8 keeps values as they are: it cuts at
/// stores.
double ApplyModel(double value, NumericModel model);
/// What a variable keeps of `value`. kNum8: first eight digits, the rest cut (NUM-10); more than eight before the point
/// is kOverflow. Other models: the value.
Number Store(double value, NumericModel model);

/// Bit operations on whole numbers of 32 bits; operands outside are kConversion.
enum class BitOp : std::uint8_t { kAnd, kOr, kXor };
Number Bits(BitOp op, double a, double b);
Number BitNot(double a);

}  // namespace ncport::ir::ops
