// Intervals of the functions of numbers.
#include <algorithm>
#include <cmath>

#include "ir/analysis/interval.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/functions.h"
#include "ir/ops/trigonometry.h"

namespace ncport::ir::analysis {

namespace {

/// Room for the last digits of the library, and for inverse functions that give the whole degree beside the result.
constexpr double kRoom = 2e-9;

double Below(double value) { return value - std::fabs(value) * 1e-12 - kRoom; }
double Above(double value) { return value + std::fabs(value) * 1e-12 + kRoom; }

Interval Growing(double (*function)(double), const Interval& a, double least, double most) {
  Interval result{least, most, 0};
  if (!std::isinf(a.low)) result.low = std::max(least, Below(function(a.low)));
  if (!std::isinf(a.high)) result.high = std::min(most, Above(function(a.high)));
  return result;
}

Interval Falling(double (*function)(double), const Interval& a, double least, double most) {
  if (std::isinf(a.low) || std::isinf(a.high)) return {least, most, 0};
  return {std::max(least, Below(function(a.high))), std::min(most, Above(function(a.low))), 0};
}

/// True if a + k * period lies in the interval for some whole k.
bool HasPhase(const Interval& a, double phase, double period) {
  const double first = phase + std::ceil((a.low - phase) / period) * period;
  return first <= a.high;
}

/// Sine (shift 0) or cosine (shift 90) of degrees.
Interval Wave(const Interval& a, double shift, double (*function)(double)) {
  Interval result{-1, 1, 0};
  if (!(a.high - a.low < 360) || std::fabs(a.low) > 1e9 || std::fabs(a.high) > 1e9) return result;
  const double first = function(a.low);
  const double last = function(a.high);
  result.low = std::max(-1.0, std::min(first, last) - 1e-12);
  result.high = std::min(1.0, std::max(first, last) + 1e-12);
  if (HasPhase(a, 90 - shift, 360)) result.high = 1;
  if (HasPhase(a, -90 - shift, 360)) result.low = -1;
  if (!HasPhase({a.low - 1e-9, a.high + 1e-9, 0}, -shift, 180)) {
    result.flags |= Interval::kNonZero;
    if (result.low > 0 || result.high < 0) return result;
    // One sign throughout: the room above took in 0 only.
    (first > 0 ? result.low : result.high) =
        first > 0 ? std::numeric_limits<double>::denorm_min() : -std::numeric_limits<double>::denorm_min();
  }
  return result;
}

double RootOf(double value) { return std::sqrt(value); }
double LogOf(double value) { return std::log(value); }
double ExpOf(double value) { return std::exp(value); }
double AsinOf(double value) { return ops::Asin(value).value; }
double AcosOf(double value) { return ops::Acos(value).value; }
double AtanOf(double value) { return ops::Atan(value); }

Interval Whole(double low, double high) { return {low, high, Interval::kWhole}; }

}  // namespace

Interval Apply(Function function, const Interval* args, std::size_t count, const Machine& machine) {
  std::uint8_t sources = 0;
  bool points = true;
  bool integers = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (!args[i].HasNumber()) return Interval::None();
    sources |= args[i].flags & Interval::kInput;
    points = points && args[i].IsPoint();
    integers = integers && args[i].Has(Interval::kInteger);
  }
  const Interval& a = args[0];
  Interval result;
  if (points && count <= 3 && function != Function::kRoundToIncrement) {  // in inches it is a finer one
    double values[3] = {};
    for (std::size_t i = 0; i < count; ++i) values[i] = args[i].low;
    const ops::Number number = ops::Apply(function, values, count, machine);
    result = number.Ok() ? Interval::Point(number.value) : Interval::None();
  } else {
    switch (function) {
      case Function::kSin:
        result = Wave(a, 0, ops::Sin);
        break;
      case Function::kCos:
        result = Wave(a, 90, ops::Cos);
        break;
      case Function::kAsin:
      case Function::kAsinPositive:
        result = Growing(AsinOf, Meet(a, {-1, 1, 0}), -90, 90);
        if (function == Function::kAsinPositive && result.low < 0) result = {0, 360, 0};
        if (a.high < -1 || a.low > 1) result = Interval::None();
        break;
      case Function::kAcos:
        result = Falling(AcosOf, Meet(a, {-1, 1, 0}), 0, 180);
        if (a.high < -1 || a.low > 1) result = Interval::None();
        break;
      case Function::kAtan:
        result = Growing(AtanOf, a, -90, 90);
        break;
      case Function::kAtan2:
        result = {args[0].low >= 0 ? 0.0 : -180.0, 180, 0};
        break;
      case Function::kAtan2Positive:
        result = {0, args[0].low >= 0 ? 180.0 : 360.0, 0};
        break;
      case Function::kSqrt:
        if (a.high < 0) return Interval::None();
        result = Growing(RootOf, Meet(a, {0, kInfinity, 0}), 0, kInfinity);
        if (!a.HasZero()) result.flags |= Interval::kNonZero;
        break;
      case Function::kAbs: {
        const double most = std::max(std::fabs(a.low), std::fabs(a.high));
        const double least = a.low <= 0 && a.high >= 0 ? 0.0 : std::min(std::fabs(a.low), std::fabs(a.high));
        result = {least, most, static_cast<std::uint8_t>(a.flags & (Interval::kWhole | Interval::kNonZero))};
        break;
      }
      case Function::kSquare: {
        result = Product(a, a);
        result.low = std::max(0.0, result.low);
        result.flags &= Interval::kWhole;
        break;
      }
      case Function::kPower:
        if (a.low >= 0) result.low = 0;
        result.flags = 0;
        break;
      case Function::kLn:
        if (a.high <= 0) return Interval::None();
        result =
            a.low > 0 ? Growing(LogOf, a, -1e4, 1e4) : Interval{-1e4, a.high > 1 ? std::log(a.high) + 1e-9 : 1e-9, 0};
        result.high = std::min(result.high, 1e4);
        break;
      case Function::kExp:
        result = Growing(ExpOf, a, 0, kInfinity);
        break;
      case Function::kTruncate:
        result = Cut(a);
        break;
      case Function::kRound:
        result = Rounded(a);
        break;
      case Function::kRoundUp:
        result = Whole(std::ceil(a.low), std::ceil(a.high));
        break;
      case Function::kRoundAway:
        result = Whole(std::isinf(a.low) ? a.low : ops::RoundAway(a.low),
                       std::isinf(a.high) ? a.high : ops::RoundAway(a.high));
        break;
      case Function::kRoundToIncrement:
        // The factor that counts the increments is 1e-11 of itself too large.
        result = {a.low - machine.increment - std::fabs(a.low) * 1e-10,
                  a.high + machine.increment + std::fabs(a.high) * 1e-10, 0};
        break;
      case Function::kMinimum:
        result = {std::min(a.low, args[1].low), std::min(a.high, args[1].high),
                  static_cast<std::uint8_t>(a.flags & args[1].flags & (Interval::kWhole | Interval::kNonZero))};
        break;
      case Function::kMaximum:
        result = {std::max(a.low, args[1].low), std::max(a.high, args[1].high),
                  static_cast<std::uint8_t>(a.flags & args[1].flags & (Interval::kWhole | Interval::kNonZero))};
        break;
      case Function::kBound:
        result = {std::max(a.low, std::min(args[1].low, args[2].low)),
                  std::min(args[1].high, std::max(a.high, args[2].high)),
                  static_cast<std::uint8_t>(a.flags & args[1].flags & args[2].flags & Interval::kWhole)};
        if (!result.HasNumber()) result = {-kInfinity, kInfinity, 0};
        break;
      case Function::kFactorial:
        result = Whole(1, kInfinity);
        break;
      case Function::kFromBcd:
      case Function::kToBcd:
        result = Whole(0, 4294967295.0);
        break;
      case Function::kAddDecimalPoint:
        result = {a.low, a.high, static_cast<std::uint8_t>(a.flags & (Interval::kWhole | Interval::kNonZero))};
        break;
      default:
        break;
    }
  }
  result.flags &= static_cast<std::uint8_t>(~Interval::kInput);
  result.flags |= sources;
  const bool keeps = function == Function::kAbs || function == Function::kMinimum || function == Function::kMaximum ||
                     function == Function::kBound;
  result.flags &= static_cast<std::uint8_t>(~Interval::kInteger);
  if (keeps && integers) result.flags |= Interval::kInteger;
  return result;
}

}  // namespace ncport::ir::analysis
