#include "ir/ops/arithmetic.h"

#include <cstdio>
#include <cstdlib>

namespace ncport::ir::ops {
namespace {

/// Nearest double with that many significant decimal digits.
double Significant(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  return std::strtod(text, nullptr);
}

bool ToBits(double value, std::uint32_t& bits) {
  const double rounded = Round(value);
  if (!(rounded >= -2147483648.0 && rounded <= 4294967295.0)) return false;
  bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(rounded));
  return true;
}

Number FromBits(std::uint32_t bits) { return {static_cast<double>(static_cast<std::int32_t>(bits)), Error::kNone}; }

/// Multiples of decimal increments print clean when they are the quotient by the whole reciprocal: 5 * 0.001 -> 5 /
/// 1000.
double MultipleOf(double count, double increment) {
  const double reciprocal = std::round(1.0 / increment);
  if (increment < 1 && 1.0 / reciprocal == increment) return count / reciprocal;
  return count * increment;
}

}  // namespace

Number DivideInteger(double a, double b) {
  if (b == 0) return Fail(Error::kDivisionByZero);
  return Finite(std::trunc(a / b) + 0.0);
}

Number Modulo(double a, double b) {
  if (b == 0) return Fail(Error::kDivisionByZero);
  const Number quotient = DivideInteger(a, b);
  if (!quotient.Ok()) return quotient;
  // By its definition, each step rounded as a control rounds it: a target without MOD computes the same steps, and a
  // layer more or less at an exact multiple is decided alike (sinumerik-4.2).
  return Finite(a - b * quotient.value + 0.0);
}

double Round(double value) { return std::round(value) + 0.0; }

double RoundAway(double value) { return (value < 0 ? std::floor(value) : std::ceil(value)) + 0.0; }

IncrementSteps StepsOf(double increment) {
  const double whole = std::round(1 / increment);
  const bool decimal = increment < 1 && std::fabs(1 / whole - increment) <= 1e-12 * increment;
  const double per = decimal ? whole : 1 / increment;
  return {per, std::round((per + std::fmax(per * 1e-11, 1e-8)) * 1e8) / 1e8};
}

double RoundToIncrement(double value, double increment) {
  const IncrementSteps steps = StepsOf(increment);
  return std::round(value * steps.factor) / steps.per + 0.0;
}

double TruncateToIncrement(double value, double increment) {
  const double quotient = Significant(value / increment, 12);
  return MultipleOf(std::trunc(quotient), increment) + 0.0;
}

double ApplyModel(double value, NumericModel model) {
  const int digits = ResultDigits(model);
  if (digits == 0) return value;
  // Whole numbers with no more digits than these are themselves.
  return value != std::trunc(value) || std::fabs(value) >= 1e8 ? Significant(value, digits) : value;
}

Number Store(double value, NumericModel model) {
  if (model != NumericModel::kNum8) return Finite(value);
  // Rounding to 12 digits first removes binary noise: 15.449999999999998 must store as 15.45.
  const double clean = Significant(value, 12);
  const double magnitude = std::fabs(clean);
  if (std::trunc(magnitude) > 99999999.0) return Fail(Error::kOverflow);
  int digits = 0;
  for (double limit = 1; limit <= magnitude; limit *= 10) ++digits;
  const double scale = std::pow(10.0, 8 - digits);
  const double cut = std::floor(Significant(magnitude * scale, 12)) / scale;
  return {std::copysign(cut, clean) + 0.0, Error::kNone};
}

Number Bits(BitOp op, double a, double b) {
  std::uint32_t left = 0;
  std::uint32_t right = 0;
  if (!ToBits(a, left) || !ToBits(b, right)) return Fail(Error::kConversion);
  switch (op) {
    case BitOp::kAnd:
      return FromBits(left & right);
    case BitOp::kOr:
      return FromBits(left | right);
    case BitOp::kXor:
      return FromBits(left ^ right);
  }
  return Fail(Error::kConversion);
}

Number BitNot(double a) {
  std::uint32_t bits = 0;
  if (!ToBits(a, bits)) return Fail(Error::kConversion);
  return FromBits(~bits);
}

}  // namespace ncport::ir::ops
