// What a condition says of the values in it.
#include <cmath>

#include "ir/analysis/value_transfer.h"
#include "ir/comparison.h"

namespace ncport::ir::analysis {

namespace {

bool IsNumber(Type type) { return type != Type::kString && type != Type::kAxis && type != Type::kFrame; }

}  // namespace

bool ValueTransfer::Assume(ExprId condition, bool holds) {
  const Expr& expr = module_.exprs[condition];
  const ExprId left{std::size_t{expr.a}};
  const ExprId right{std::size_t{expr.b}};
  switch (expr.op) {
    case ExprOp::kGroup:
      return Assume(left, holds);
    case ExprOp::kNot:
      return Assume(left, !holds);
    case ExprOp::kConvert:
      if (expr.type == Type::kBool && IsNumber(module_.exprs[left].type)) return Assume(left, holds);
      break;
    case ExprOp::kAnd:
    case ExprOp::kOr: {
      if ((expr.op == ExprOp::kAnd) == holds) return Assume(left, holds) && Assume(right, holds);
      // One of both: what both ways leave.
      ValueState other = *state_;
      const bool first = Assume(left, holds);
      ValueState* const own = state_;
      state_ = &other;
      // The second way may take the first part as it is not.
      const bool second = Assume(right, holds);
      state_ = own;
      if (!second) return first;
      if (!first) {
        *state_ = std::move(other);
        return true;
      }
      (void)JoinInto(*state_, other);
      return true;
    }
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
      return AssumeComparison(expr, holds);
    case ExprOp::kText:
    case ExprOp::kConcat:
      return true;
    default:
      break;
  }
  if (!IsNumber(expr.type)) return true;
  const Interval value = Evaluate(condition);
  if (holds) {
    const Interval rest = WithoutVacant(WithoutZero(value));
    return rest.HasNumber() && Narrow(condition, rest);
  }
  if (!value.HasZero() && !value.Has(Interval::kVacant)) return false;
  return Narrow(condition, {0, 0, Interval::kVacant});
}

bool ValueTransfer::AssumeComparison(const Expr& expr, bool holds) {
  const ExprId left{std::size_t{expr.a}};
  const ExprId right{std::size_t{expr.b}};
  const auto is_text = [&](ExprId id) {
    const Expr& side = module_.exprs[id];
    return !IsNumber(side.type) || side.op == ExprOp::kText || side.op == ExprOp::kConcat ||
           side.op == ExprOp::kAxisName;
  };
  if (is_text(left) || is_text(right)) return true;
  const ExprOp op = holds ? expr.op : Negated(expr.op);
  const double tolerance = (expr.flags & Expr::kTolerance) != 0 ? machine_.compare_tolerance : 0;
  const Interval a = Evaluate(left);
  const Interval b = Evaluate(right);
  if (a.IsNone() || b.IsNone()) return false;
  const bool vacant_differs =
      (expr.flags & Expr::kVacantDiffers) != 0 && (a.Has(Interval::kVacant) || b.Has(Interval::kVacant));
  if (vacant_differs) {
    const auto side = [&](ExprId id, const Interval& value, const Interval& other) {
      if (op == ExprOp::kEqual) {
        Interval kept = Constrained(ExprOp::kEqual, WithoutVacant(value), WithoutVacant(other), tolerance);
        if (!kept.HasNumber()) kept = Interval::None();
        kept.flags &= static_cast<std::uint8_t>(~Interval::kVacant);
        if (value.Has(Interval::kVacant) && other.Has(Interval::kVacant)) kept.flags |= Interval::kVacant;
        return !kept.IsNone() && Narrow(id, kept);
      }
      if (!other.HasNumber()) {  // differs from the empty value
        const Interval numbers = WithoutVacant(value);
        return numbers.HasNumber() && Narrow(id, numbers);
      }
      return true;
    };
    return side(left, a, b) && side(right, b, a);
  }
  // Known values decide by the comparison itself.
  const Interval truth = Compared(op, a, b, tolerance);
  if (!truth.HasNumber() || truth.high == 0) return false;
  const Interval new_a = Constrained(op, a, VacantAsZero(b), tolerance);
  const Interval new_b = Constrained(Swapped(op), b, VacantAsZero(a), tolerance);
  if (new_a.IsNone() || new_b.IsNone()) return false;
  return Narrow(left, new_a) && Narrow(right, new_b);
}

bool ValueTransfer::Narrow(ExprId id, const Interval& to) {
  const Expr& expr = module_.exprs[id];
  const auto narrow_slot = [&](std::uint32_t slot) {
    if (slot == SlotMap::kNone || slots_.At(site_.context->program, slot).changes) return true;
    Interval& cell = state_->cells[slot];
    const Interval met = Meet(cell, to);
    if (met.IsNone()) return false;
    const std::uint8_t tested = to.flags & Interval::kTested;
    cell = met;
    cell.flags |= tested;
    return true;
  };
  switch (expr.op) {
    case ExprOp::kGroup:
    case ExprOp::kPlus:
      return Narrow(ExprId{std::size_t{expr.a}}, to);
    case ExprOp::kVariable: {
      const Variable& variable = module_.variables[VariableId{std::size_t{expr.a}}];
      if (variable.type == Type::kString || (variable.by_reference && shared_references_)) return true;
      if (variable.dimension_count != 0) return true;
      return narrow_slot(slots_.Of(VariableId{std::size_t{expr.a}}));
    }
    case ExprOp::kCell: {
      const SpaceId space = SpaceOf(SpaceId{std::size_t{expr.a}}, expr.b);
      return !space.Valid() || narrow_slot(slots_.Of(space, expr.b));
    }
    case ExprOp::kCellAt: {
      const Interval index = Rounded(Evaluate(ExprId{std::size_t{expr.a}}));
      if (!index.IsPoint()) return true;
      const SpaceId space = SpaceOf(SpaceId{std::size_t{expr.b}}, index.low);
      return !space.Valid() || narrow_slot(slots_.Of(space, static_cast<std::uint32_t>(index.low)));
    }
    case ExprOp::kConvert: {
      const ExprId inner{std::size_t{expr.a}};
      if (!IsNumber(module_.exprs[inner].type) || !to.HasNumber()) return true;
      if (expr.type == Type::kReal)
        return Narrow(inner, {to.low, to.high,
                              static_cast<std::uint8_t>(to.flags &
                                                        (Interval::kNonZero | Interval::kVacant | Interval::kTested))});
      if (expr.type == Type::kInt && (expr.flags & Expr::kRoundCut) == 0)
        return Narrow(inner, {to.low - 0.5, to.high + 0.5, Interval::kVacant});
      return true;
    }
    case ExprOp::kNegate: {
      if (!to.HasNumber()) return true;
      Interval inner = Negated(WithoutVacant(to));
      if (to.HasZero()) inner.flags |= Interval::kVacant;  // an empty operand counts as 0
      return Narrow(ExprId{std::size_t{expr.a}}, inner);
    }
    case ExprOp::kAdd:
    case ExprOp::kSubtract: {
      if (!to.HasNumber() || (expr.flags & (Expr::kVacantAsZero | Expr::kNumericModel)) != 0) return true;
      const ExprId left{std::size_t{expr.a}};
      const ExprId right{std::size_t{expr.b}};
      const Interval a = Evaluate(left);
      const Interval b = Evaluate(right);
      if (!a.HasNumber() || !b.HasNumber()) return true;
      const Interval sum{to.low, to.high, 0};
      const auto plain = [](Interval value) {
        value.flags = 0;
        if (!std::isinf(value.low)) value.low -= std::fabs(value.low) * 1e-12;
        if (!std::isinf(value.high)) value.high += std::fabs(value.high) * 1e-12;
        return value;
      };
      // Room for the rounding of the sum itself.
      const double size =
          std::fmax(std::fmax(std::fabs(a.low), std::fabs(a.high)), std::fmax(std::fabs(b.low), std::fabs(b.high)));
      if (std::isinf(size) && !(a.IsPoint() || b.IsPoint())) return true;
      Interval for_a = plain(expr.op == ExprOp::kAdd ? Difference(sum, b) : Sum(sum, b));
      Interval for_b = plain(expr.op == ExprOp::kAdd ? Difference(sum, a) : Difference(a, sum));
      if (!std::isinf(size)) {
        for_a.low -= size * 1e-12;
        for_a.high += size * 1e-12;
        for_b.low -= size * 1e-12;
        for_b.high += size * 1e-12;
      } else {
        const double known = std::fabs(a.IsPoint() ? a.low : b.low) * 1e-12;
        for_a.low -= known;
        for_a.high += known;
        for_b.low -= known;
        for_b.high += known;
      }
      if (!for_a.HasNumber() || !for_b.HasNumber()) return true;
      return Narrow(left, for_a) && Narrow(right, for_b);
    }
    case ExprOp::kFunction: {
      if (static_cast<Function>(expr.a) != Function::kAbs || !to.HasNumber()) return true;
      if (to.high < 0) return false;
      Interval inner{-to.high, to.high, Interval::kVacant};
      if (!to.HasZero()) inner.flags = 0;
      if (!to.HasZero()) inner.flags |= Interval::kNonZero;
      // One sign is known already: so is the other bound.
      const ExprId argument = module_.Item(expr.b);
      const Interval value = Evaluate(argument);
      if (value.low >= 0) inner.low = to.low;
      if (value.high <= 0) inner.high = -to.low;
      return Narrow(argument, inner);
    }
    default:
      return true;
  }
}

}  // namespace ncport::ir::analysis
