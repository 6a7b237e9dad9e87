#include "ir/ops/functions.h"

#include <cmath>
#include <cstdint>

#include "base/result.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/convert.h"
#include "ir/ops/trigonometry.h"

namespace ncport::ir::ops {
namespace {

Number Ok(double value) { return {value, Error::kNone}; }

Number Factorial(double value) {
  const Number whole = WholeUpTo(value, 170);  // 171! is no double any more
  if (!whole.Ok()) return whole;
  double product = 1;
  for (double factor = 2; factor <= whole.value; ++factor) product *= factor;
  return Finite(product);
}

/// Four bits a digit to a number, and back. Eight digits at most.
Number FromBcd(double value) {
  const Number whole = WholeUpTo(value, 4294967295.0);
  if (!whole.Ok()) return whole;
  auto bits = static_cast<std::uint32_t>(whole.value);
  double result = 0;
  for (double place = 1; bits != 0; bits >>= 4U, place *= 10) {
    const std::uint32_t digit = bits & 15U;
    if (digit > 9) return Fail(Error::kDomain);
    result += digit * place;
  }
  return Ok(result);
}

Number ToBcd(double value) {
  const Number whole = WholeUpTo(value, 99999999.0);
  if (!whole.Ok()) return whole;
  auto rest = static_cast<std::uint32_t>(whole.value);
  std::uint32_t bits = 0;
  for (unsigned shift = 0; rest != 0; rest /= 10, shift += 4) bits |= (rest % 10) << shift;
  return Ok(bits);
}

Number Power(double base, double exponent) {
  if (base < 0 && exponent != std::trunc(exponent)) return Fail(Error::kDomain);
  if (base == 0 && exponent < 0) return Fail(Error::kDivisionByZero);
  return Finite(std::pow(base, exponent));
}

}  // namespace

bool IsNumeric(Function function) { return function <= Function::kAddDecimalPoint; }

Number Apply(Function function, const double* args, std::size_t count, const Machine& machine) {
  NCPORT_CHECK(count >= ArityOf(function).least && count <= ArityOf(function).most, "wrong number of arguments for {}",
               NameOf(function));
  const double x = args[0];
  switch (function) {
    case Function::kSin:
      return Ok(Sin(x));
    case Function::kCos:
      return Ok(Cos(x));
    case Function::kTan:
      return Tan(x);
    case Function::kAsin:
      return Asin(x);
    case Function::kAsinPositive: {
      const Number angle = Asin(x);
      return angle.Ok() && angle.value < 0 ? Ok(angle.value + 360.0) : angle;
    }
    case Function::kAcos:
      return Acos(x);
    case Function::kAtan:
      return Ok(Atan(x));
    case Function::kAtan2:
      return Ok(Atan2(x, args[1]));
    case Function::kAtan2Positive: {
      const double angle = Atan2(x, args[1]);
      return Ok(angle < 0 ? angle + 360.0 : angle);
    }
    case Function::kSqrt:
      return x < 0 ? Fail(Error::kDomain) : Ok(std::sqrt(x));
    case Function::kAbs:
      return Ok(std::fabs(x));
    case Function::kSquare:
      return Finite(x * x);
    case Function::kPower:
      return Power(x, args[1]);
    case Function::kLn:
      return x <= 0 ? Fail(Error::kDomain) : Ok(std::log(x));
    case Function::kExp:
      return Finite(std::exp(x));
    case Function::kTruncate:
      return Ok(std::trunc(x) + 0.0);
    case Function::kRound:
      return Ok(Round(x));
    case Function::kRoundUp:
      return Ok(std::ceil(x) + 0.0);
    case Function::kRoundAway:
      return Ok(RoundAway(x));
    case Function::kRoundToIncrement:
      return Ok(RoundToIncrement(x, machine.increment));
    case Function::kMinimum:
      return Ok(std::fmin(x, args[1]));
    case Function::kMaximum:
      return Ok(std::fmax(x, args[1]));
    case Function::kBound:
      return x > args[1] ? Fail(Error::kDomain) : Ok(std::fmin(std::fmax(args[2], x), args[1]));
    case Function::kFactorial:
      return Factorial(x);
    case Function::kFromBcd:
      return FromBcd(x);
    case Function::kToBcd:
      return ToBcd(x);
    case Function::kAddDecimalPoint:
      return Ok(x);
    default:
      NCPORT_BUG("{} is not a function of numbers", NameOf(function));
  }
}

}  // namespace ncport::ir::ops
