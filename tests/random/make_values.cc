// Numbers and conditions with known bounds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprId;
using ir::ExprOp;
using ir::Type;
namespace {

constexpr double kMost = 1e5;  // of any value on the way
constexpr Interval kBounds[kRanges] = {
    {0, 1, true},       {0, 12, true},  {-100, 100, true}, {-40, 40, false}, {0.5, 20, false},
    {-360, 360, false}, {-1, 1, false}, {50, 3000, false}, {0, 0, true},     {0, 0, true},
};

Interval Apply(double (*function)(double), const Interval& a) { return {function(a.low), function(a.high), true}; }

}  // namespace

Interval BoundsOf(Range range) { return kBounds[static_cast<std::size_t>(range)]; }

Maker::Made Maker::Operation(ExprOp op, Made left, Made right, Type type, Interval range) {
  const ExprId id = expr_.Binary(op, left.id, right.id);
  module_.exprs[id].type = type;
  return {id, type, range};
}

Maker::Made Maker::Call(ir::Function function, std::initializer_list<Made> arguments, Type type, Interval range) {
  ExprId ids[4];
  std::size_t count = 0;
  for (const Made& argument : arguments) ids[count++] = argument.id;
  const ExprId id = count == 1   ? expr_.Function(function, {ids[0]}, type)
                    : count == 2 ? expr_.Function(function, {ids[0], ids[1]}, type)
                                 : expr_.Function(function, {ids[0], ids[1], ids[2]}, type);
  return {id, type, range};
}

Maker::Made Maker::Group(Made made) {
  made.id = expr_.Unary(ExprOp::kGroup, made.id);
  return made;
}

Maker::Made Maker::MaybeGroup(Made made) { return Draw(Feature::kBrackets) ? Group(made) : made; }

ExprId Maker::As(const Made& made, Type type) {
  return made.type == type || !IsSinumerik() ? made.id : expr_.Convert(made.id, type);
}

// A number on a grid of up to three decimals, written in one of the ways that people write numbers.
Maker::Made Maker::Literal(const Interval& target) {
  static constexpr int kDecimals[] = {0, 0, 0, 1, 1, 2, 3};
  int decimals = target.whole ? 0 : random_.Pick(kDecimals);
  double scale = std::pow(10.0, decimals);
  double value = target.low;
  if (target.low == target.high) {
    // One value: as many decimals as it has.
    while (decimals < 9 && std::round(value * scale) / scale != value) scale = std::pow(10.0, ++decimals);
  } else {
    while (decimals < 9 && std::ceil(target.low * scale) > std::floor(target.high * scale))
      scale = std::pow(10.0, ++decimals);
    const auto first = static_cast<std::int64_t>(std::ceil(target.low * scale));
    // Bounds that differ by their rounding only hold no written number: the nearest one above.
    const auto last = std::max(first, static_cast<std::int64_t>(std::floor(target.high * scale)));
    value = static_cast<double>(random_.Between(first, last)) / scale;
  }
  std::string text = fmt::format("{:.{}f}", std::fabs(value), decimals);
  bool point = decimals != 0;
  if (!point && !target.whole && random_.Percent(50)) {
    text += '.';
    point = true;
  }
  if (point && text.size() > 2 && text[0] == '0' && text[1] == '.' && random_.Percent(20)) text.erase(0, 1);
  if (point && text.back() != '.' && random_.Percent(15)) text += '0';
  if (random_.Percent(3)) text = "0" + text;
  if (value < 0) text = "-" + text;
  const Type type = IsSinumerik() && !point ? Type::kInt : Type::kReal;
  return {expr_.Number(text, type), type, Interval::Point(value)};
}

ExprId Maker::PlaceExpr(const Place& place, int depth) {
  if (place.system.Valid()) {
    return expr_.System(place.system, {expr_.Number(fmt::format("{}", place.first), Type::kInt)});
  }
  if (place.variable.Valid()) {
    if (!place.is_array) return expr_.Variable(place.variable);
    const ir::Variable variable = module_.variables[place.variable];
    ExprId indices[2];
    for (std::uint8_t i = 0; i < variable.dimension_count; ++i) {
      const Interval range{0, static_cast<double>(variable.dimensions[i]) - 1, true};
      indices[i] =
          Draw(Feature::kComputedIndex) ? As(NumberIn(range, depth - 1), Type::kInt) : As(Literal(range), Type::kInt);
    }
    return variable.dimension_count == 1 ? expr_.Element(place.variable, {indices[0]})
                                         : expr_.Element(place.variable, {indices[0], indices[1]});
  }
  const double last = place.first + place.count - 1;
  if (place.count > 1 && Draw(Feature::kComputedIndex)) {
    const Made index = NumberIn({static_cast<double>(place.first), last, true}, depth - 1);
    return expr_.CellAt(place.space, index.id);
  }
  return expr_.Cell(place.space, place.first + random_.Below(place.count));
}

Maker::Made Maker::ReadPlace(const Place& place, int depth) {
  return {PlaceExpr(place, depth), place.type, BoundsOf(place.range)};
}

const Place* Maker::PickPlace(const Interval& target, bool whole_type) {
  const Place* found = nullptr;
  std::uint32_t seen = 0;
  const auto look = [&](const std::vector<Place>& places) {
    for (const Place& place : places) {
      if (place.range == Range::kText || place.range == Range::kAxis) continue;
      if (whole_type && place.type != Type::kInt) continue;
      if (!BoundsOf(place.range).Inside(target)) continue;
      if (random_.Below(++seen) == 0) found = &place;
    }
  };
  look(places_);
  look(shared_);
  return found;
}

const Place* Maker::FindPlace(Range range, Type type) {
  const Place* found = nullptr;
  std::uint32_t seen = 0;
  for (const Place& place : places_) {
    if (place.range == range && place.type == type && random_.Below(++seen) == 0) found = &place;
  }
  return found;
}

const Place* Maker::PickWritable() {
  const Place* found = nullptr;
  std::uint32_t seen = 0;
  for (const std::vector<Place>* places : {&places_, &shared_}) {
    for (const Place& place : *places) {
      if (place.writable && random_.Below(++seen) == 0) found = &place;
    }
  }
  return found;
}

Maker::Made Maker::NumberIn(const Interval& target, int depth) {
  const Made made = AnyNumberIn(target, depth);
  return TooDeep(made) ? Literal(target) : made;
}

Maker::Made Maker::AnyNumberIn(const Interval& target, int depth) {
  const std::uint32_t way = random_.Below(10);
  if (way < 4) {
    const Place* const place = PickPlace(target, false);
    if (place != nullptr) return ReadPlace(*place, depth);
  }
  if (way < 8 && depth > 0) return Fit(Number(depth - 1), target);
  return Literal(target);
}

// Brings a value of other bounds into the target: cut off, folded, or scaled.
Maker::Made Maker::Fit(Made made, const Interval& target) {
  if (made.range.Inside(target)) return made;
  const bool functions = Has(Feature::kFunctions);
  if (target.whole && !made.range.whole) {
    if (!functions) return Literal(target);
    // ROUND inside a word of a FANUC program rounds to the increment (fanuc-4.4).
    const bool cut = random_.Percent(50) || !IsSinumerik();
    made = Call(cut ? ir::Function::kTruncate : ir::Function::kRound, {made}, Type::kReal,
                cut ? Truncated(made.range) : Rounded(made.range));
    if (made.range.Inside(target)) return made;
  }
  const std::uint32_t way = random_.Below(4);
  if (way < 2 && IsSinumerik() && functions) {
    const Interval inner{std::ceil(target.low), std::floor(target.high), target.whole};
    if (inner.low < inner.high) {
      const Made low = Literal(Interval::Point(inner.low));
      const Made high = Literal(Interval::Point(inner.high));
      const Interval range{inner.low, inner.high, made.range.whole};
      if (way == 0) return Call(ir::Function::kBound, {low, high, made}, Type::kReal, range);
      const Made least = Call(ir::Function::kMinimum, {made, high}, Type::kReal, range);
      return Call(ir::Function::kMaximum, {low, least}, Type::kReal, range);
    }
  }
  const double width = target.high - target.low;
  if (way == 2 && made.range.whole && Draw(Feature::kIntegerDivision) && std::floor(width) >= 1 && width < 1e4) {
    // low + ABS(m) MOD (width + 1)
    const Made divisor = Literal(Interval::Point(std::floor(width) + (target.whole ? 1 : 0)));
    const Made positive = Call(ir::Function::kAbs, {made}, made.type, Absolute(made.range));
    const Made rest =
        Operation(ExprOp::kModulo, positive, divisor, made.type, {0, std::floor(width) - (target.whole ? 0 : 1), true});
    const Made low = Literal(Interval::Point(std::ceil(target.low)));
    const Made sum = Operation(ExprOp::kAdd, low, rest, Type::kReal, low.range + rest.range);
    if (sum.range.Inside(target)) return sum;
  }
  if (!target.whole && width > 0) {
    double factor = 1;
    while (made.range.Magnitude() * factor > width * 0.45) factor *= 0.5;
    if (factor < 1e-6) return Literal(target);
    // A power of two down to 1/64 has few digits; smaller ones are divisions.
    const double divisor = 1 / factor;
    Made scaled = factor >= 1.0 / 8 && random_.Percent(50)
                      ? Operation(ExprOp::kMultiply, made,
                                  {expr_.Number(fmt::format("{}", factor)), Type::kReal, Interval::Point(factor)},
                                  Type::kReal, made.range * Interval::Point(factor))
                      : Operation(ExprOp::kDivide, made, Literal(Interval::Point(divisor)), Type::kReal,
                                  made.range / Interval::Point(divisor));
    if (scaled.range.Inside(target) && random_.Percent(50)) return scaled;
    const double middle = (target.low + target.high) / 2;
    const double slack = width * 0.02;
    const Made shift = Literal({middle - slack, middle + slack, false});
    const Made sum = Operation(ExprOp::kAdd, scaled, shift, Type::kReal, scaled.range + shift.range);
    if (sum.range.Inside(target)) return sum;
  }
  return Literal(target);
}

// A whole number of static type INT, for operations that take no other.
Maker::Made Maker::IntegerIn(const Interval& target, int depth) {
  const Place* const place = random_.Percent(60) ? PickPlace(target, true) : nullptr;
  if (place != nullptr) return ReadPlace(*place, depth);
  return Literal({target.low, target.high, true});
}

Maker::Made Maker::BitOperation(int depth) {
  const Made left = IntegerIn({0, 100, true}, depth);
  if (random_.Percent(20)) {
    Made made{expr_.Unary(ExprOp::kBitNot, left.id), Type::kInt, {-left.range.high - 1, -left.range.low - 1, true}};
    return made;
  }
  const Made right = IntegerIn({0, 100, true}, depth);
  static constexpr ExprOp kOps[] = {ExprOp::kBitAnd, ExprOp::kBitOr, ExprOp::kBitXor};
  return Operation(random_.Pick(kOps), left, right, Type::kInt, {0, 127, true});
}

Maker::Made Maker::Function(int depth) {
  using F = ir::Function;
  const Type real = Type::kReal;
  std::uint32_t which = random_.Below(IsSinumerik() ? 16 : 13);
  if (which == 9 && !IsSinumerik()) which = 8;  // ROUND inside a word rounds to the increment (fanuc-4.4)
  switch (which) {
    case 0:
      return Call(F::kSin, {Number(depth)}, real, Widen({-1, 1, false}));
    case 1:
      return Call(F::kCos, {Number(depth)}, real, Widen({-1, 1, false}));
    case 2: {
      const Made angle = NumberIn({-60, 60, false}, depth);
      return Call(F::kTan, {angle}, real, {-2, 2, false});
    }
    case 3:
      return IsSinumerik() ? Call(F::kAsin, {NumberIn({-1, 1, false}, depth)}, real, {-90.001, 90.001, false})
                           : Call(F::kAsinPositive, {NumberIn({-1, 1, false}, depth)}, real, {0, 360.001, false});
    case 4:
      return Call(F::kAcos, {NumberIn({-1, 1, false}, depth)}, real, {-0.001, 180.001, false});
    case 5: {
      const Made across = Number(depth);
      const F function = IsSinumerik() ? F::kAtan2 : F::kAtan2Positive;
      return Call(function, {across, Number(depth)}, real,
                  {IsSinumerik() ? -180.001 : 0, IsSinumerik() ? 180.001 : 360.001, false});
    }
    case 6: {
      const Made square = NumberIn({0, 400, false}, depth);
      return Call(F::kSqrt, {square}, real,
                  Widen({std::sqrt(std::max(0.0, square.range.low)), std::sqrt(square.range.high), false}));
    }
    case 7: {
      const Made value = Number(depth);
      return Call(F::kAbs, {value}, value.type, Absolute(value.range));
    }
    case 8: {
      const Made value = Number(depth);
      return Call(F::kTruncate, {value}, real, Truncated(value.range));
    }
    case 9: {
      const Made value = Number(depth);
      return Call(F::kRound, {value}, real, Rounded(value.range));
    }
    case 10: {
      const Made value = Number(depth);
      return IsSinumerik()
                 ? Call(F::kRoundUp, {value}, real, Apply([](double x) { return std::ceil(x); }, value.range))
                 : Call(F::kRoundAway, {value}, real, {std::floor(value.range.low), std::ceil(value.range.high), true});
    }
    case 11: {
      const Made value = NumberIn({0.5, 20, false}, depth);
      return Call(F::kLn, {value}, real, Monotone([](double x) { return std::log(x); }, value.range));
    }
    case 12: {
      const Made value = NumberIn({-3, 3, false}, depth);
      return Call(F::kExp, {value}, real, Monotone([](double x) { return std::exp(x); }, value.range));
    }
    case 13: {
      const Made value = NumberIn({-100, 100, false}, depth);
      return Call(F::kSquare, {value}, real,
                  {0, value.range.Magnitude() * value.range.Magnitude() + 1e-6, value.range.whole});
    }
    default: {
      const bool least = random_.Percent(50);
      const Made left = Number(depth);
      const Made right = Number(depth);
      const Interval range{
          least ? std::min(left.range.low, right.range.low) : std::max(left.range.low, right.range.low),
          least ? std::min(left.range.high, right.range.high) : std::max(left.range.high, right.range.high),
          left.range.whole && right.range.whole};
      const Type type = left.type == Type::kInt && right.type == Type::kInt ? Type::kInt : real;
      return Call(least ? F::kMinimum : F::kMaximum, {left, right}, type, range);
    }
  }
}

// Any number.
Maker::Made Maker::Number(int depth) {
  const Made made = AnyNumber(depth);
  return TooDeep(made) ? Number(0) : made;
}

Maker::Made Maker::AnyNumber(int depth) {
  if (depth <= 0) {
    const Place* const place = random_.Percent(65) ? PickPlace({-kMost, kMost, false}, false) : nullptr;
    return place != nullptr ? ReadPlace(*place, depth) : Literal({-50, 50, random_.Percent(40)});
  }
  if (Draw(Feature::kFunctions)) return MaybeGroup(Function(depth - 1));
  if (Draw(Feature::kBitOperations)) return MaybeGroup(BitOperation(depth - 1));
  if (Draw(Feature::kSystemVariables)) return MaybeGroup(SystemNumber());
  if (Draw(Feature::kTextFunctions) && random_.Percent(6)) return MaybeGroup(TextNumber(depth - 1));
  if (Draw(Feature::kIntegerDivision)) {
    const Made left = Number(depth - 1);
    const Made right = NumberIn({0.5, 20, random_.Percent(60)}, depth - 1);
    const bool whole = left.type == Type::kInt && right.type == Type::kInt;
    if (random_.Percent(50)) {
      return MaybeGroup(Operation(ExprOp::kModulo, left, right, whole ? Type::kInt : Type::kReal,
                                  Remainder(left.range, right.range)));
    }
    return MaybeGroup(Operation(ExprOp::kDivideInteger, left, right, whole ? Type::kInt : Type::kReal,
                                Truncated(left.range / right.range)));
  }
  const std::uint32_t way = random_.Below(20);
  if (way < 3) return Number(0);
  const Made left = Number(depth - 1);
  if (way < 5) {
    // A sign stands before a bracket or a plain operand: in between controls differ.
    const ExprOp op = way == 3 || !IsSinumerik() ? ExprOp::kNegate : ExprOp::kPlus;
    const Made operand = Group(left);
    return MaybeGroup({expr_.Unary(op, operand.id), left.type, op == ExprOp::kNegate ? -left.range : left.range});
  }
  if (way < 9) {
    const Made right = NumberIn({0.5, 20, false}, depth - 1);
    const Made quotient = Operation(ExprOp::kDivide, left, right, Type::kReal, left.range / right.range);
    return quotient.range.Magnitude() < kMost ? MaybeGroup(quotient) : left;
  }
  const Made right = Number(depth - 1);
  const Type type = left.type == Type::kInt && right.type == Type::kInt ? Type::kInt : Type::kReal;
  if (way < 13) {
    const Interval range = left.range + right.range;
    return range.Magnitude() < kMost ? MaybeGroup(Operation(ExprOp::kAdd, left, right, type, range)) : left;
  }
  if (way < 16) {
    const Interval range = left.range - right.range;
    return range.Magnitude() < kMost ? MaybeGroup(Operation(ExprOp::kSubtract, left, right, type, range)) : left;
  }
  const Interval range = left.range * right.range;
  return range.Magnitude() < kMost ? MaybeGroup(Operation(ExprOp::kMultiply, left, right, type, range)) : left;
}

ExprId Maker::Comparison(int depth) {
  static constexpr ExprOp kOps[] = {ExprOp::kEqual,     ExprOp::kNotEqual, ExprOp::kLess,
                                    ExprOp::kLessEqual, ExprOp::kGreater,  ExprOp::kGreaterEqual};
  const Made left = Number(depth);
  // Against a value of the same size, so that both answers occur.
  const Interval near{std::max(left.range.low, -100.0), std::min(left.range.high, 100.0), false};
  const Made right = near.high - near.low > 0.01 ? NumberIn(near, depth - 1) : Number(depth - 1);
  return expr_.Binary(random_.Pick(kOps), left.id, right.id, IsSinumerik() ? ir::Expr::kTolerance : std::uint8_t{0});
}

ExprId Maker::Truth(int depth) {
  const std::uint32_t way = random_.Below(20);
  if (depth > 0 && way < 5 && Has(Feature::kNestedConditions)) {
    if (way == 0) return expr_.Unary(ExprOp::kNot, expr_.Unary(ExprOp::kGroup, Truth(depth - 1)));
    static constexpr ExprOp kOps[] = {ExprOp::kAnd, ExprOp::kOr, ExprOp::kXor, ExprOp::kAnd, ExprOp::kOr};
    // Brackets around comparisons: what binds weaker differs between controls, so printers must get it right from the
    // tree; half of the time they get it spelled out.
    ExprId left = Truth(depth - 1);
    ExprId right = Truth(depth - 1);
    if (random_.Percent(50)) left = expr_.Unary(ExprOp::kGroup, left);
    if (random_.Percent(50)) right = expr_.Unary(ExprOp::kGroup, right);
    return expr_.Binary(random_.Pick(kOps), left, right);
  }
  if (IsSinumerik() && way < 7) {
    const Place* const place = FindPlace(Range::kTruth, Type::kBool);
    if (place != nullptr) return PlaceExpr(*place, depth);
    if (!Has(Feature::kPlainTruth)) return Comparison(depth);
    return expr_.Literal(random_.Below(2), Type::kBool);
  }
  if (IsSinumerik() && way == 7 && Draw(Feature::kTextFunctions)) return TextTruth(depth);
  if (IsSinumerik() && way == 8) return As(Number(depth), Type::kBool);
  return Comparison(depth);
}

ExprId Maker::ValueFor(Range range, Type type, int depth) {
  if (range == Range::kText) return TextValue(depth);
  if (range == Range::kAxis) {
    const Place* const place = random_.Percent(30) ? FindPlace(Range::kAxis, Type::kAxis) : nullptr;
    return place != nullptr ? PlaceExpr(*place, depth) : expr_.AxisName(random_.Percent(50) ? 0 : 2);
  }
  if (range == Range::kTruth) {
    if (IsSinumerik() && (type == Type::kBool || random_.Percent(40))) {
      // A number becomes true or false only where a truth is wanted.
      const ExprId truth = type == Type::kBool || !IsSinumerik() ? Truth(depth) : Comparison(depth);
      const Type from = module_.exprs[truth].type;
      return from == type || !IsSinumerik() ? truth : expr_.Convert(truth, type);
    }
  }
  const Made made = NumberIn(BoundsOf(range), depth);
  return As(made, type);
}

}  // namespace ncport::tests::random
