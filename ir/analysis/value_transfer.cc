#include "ir/analysis/value_transfer.h"

#include <algorithm>
#include <cmath>

#include "ir/ops/arithmetic.h"
#include "ir/ops/functions.h"

namespace ncport::ir::analysis {

namespace {

constexpr double kPi = 3.14159265358979323846;

bool IsWhole(Type type) { return type == Type::kInt || type == Type::kBool || type == Type::kChar; }

/// The value can be an operand: failing ones are left out. What a certain failure gives does not matter: the control
/// stops there, and the blocks behind it are looked at as if anything had come out.
Interval OrAnything(const Interval& value, bool integer, const Machine& machine) {
  if (value.HasNumber()) return value;
  return integer ? AllOf(Type::kInt, machine, Interval::kInput) : Interval::Unknown();
}

}  // namespace

Interval AllOf(Type type, const Machine& machine, std::uint8_t flags) {
  Interval result = Interval::Unknown(flags);
  switch (type) {
    case Type::kInt:
      result.low = static_cast<double>(machine.int_min);
      result.high = static_cast<double>(machine.int_max);
      break;
    case Type::kBool:
      result.low = 0;
      result.high = 1;
      break;
    case Type::kChar:
      result.low = 0;
      result.high = 255;
      break;
    case Type::kNumber:
    case Type::kAny:
      result.flags |= Interval::kVacant;
      return result;
    default:
      return result;
  }
  result.flags |= Interval::kWhole | Interval::kInteger;
  return result;
}

Interval ValueTransfer::UnknownOf(const Slot& slot, std::uint8_t flags) const {
  switch (slot.kind) {
    case SlotKind::kCell: {
      const Space& space = module_.spaces[SpaceId{std::size_t{slot.id}}];
      Interval result = AllOf(space.type, machine_, flags);
      if (space.start == StartValue::kVacant) result.flags |= Interval::kVacant;
      return result;
    }
    case SlotKind::kVariable:
      return AllOf(module_.variables[VariableId{std::size_t{slot.id}}].type, machine_, flags);
    case SlotKind::kLoopEnd:
      return Interval::Unknown(flags);
  }
  return Interval::Unknown(flags);
}

Interval ValueTransfer::Load(std::uint32_t slot) const {
  const Slot& record = slots_.At(site_.context->program, slot);
  if (record.changes) return UnknownOf(record, Interval::kInput);
  return state_->cells[slot];
}

Interval ValueTransfer::ValueOf(VariableId variable) const {
  const std::uint32_t slot = slots_.Of(variable);
  return slot == SlotMap::kNone ? Interval::Unknown() : Load(slot);
}

Interval ValueTransfer::ValueOf(SpaceId space, std::uint32_t cell) const {
  const std::uint32_t slot = slots_.Of(space, cell);
  return slot == SlotMap::kNone ? AllOf(module_.spaces[space].type, machine_, Interval::kInput) : Load(slot);
}

Interval ValueTransfer::Evaluate(ExprId expr) {
  RangeObserver* const observer = observer_;
  observer_ = nullptr;
  looks_ = true;
  const Interval value = Eval(expr);
  looks_ = false;
  observer_ = observer;
  return value;
}

Interval ValueTransfer::Operand(const Interval& value, const Expr& expr) const {
  return (expr.flags & Expr::kVacantAsZero) != 0 ? VacantAsZero(value) : WithoutVacant(value);
}

/// What the control does with a result: its digits, the range of INT.
Interval ValueTransfer::Finished(Interval value, const Expr& expr, bool integer) const {
  if (integer) {
    Interval result = Meet(value, {static_cast<double>(machine_.int_min), static_cast<double>(machine_.int_max), 0});
    result.flags |= Interval::kInteger;
    return result;
  }
  value.flags &= static_cast<std::uint8_t>(~Interval::kInteger);
  if ((expr.flags & Expr::kNumericModel) == 0 || machine_.numeric_model != NumericModel::kDecimal8) return value;
  if (value.IsPoint()) {
    Interval exact = Interval::Point(ops::ApplyModel(value.low, machine_.numeric_model));
    exact.flags |= value.flags & Interval::kInput;
    return exact;
  }
  // Eight digits: half a unit of the eighth.
  if (!std::isinf(value.low)) value.low -= std::fabs(value.low) * 1e-7;
  if (!std::isinf(value.high)) value.high += std::fabs(value.high) * 1e-7;
  return value;
}

Interval ValueTransfer::Eval(ExprId id) {
  const Expr& expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral: {
      Interval value = Interval::Point(expr.number);
      if (IsWhole(expr.type)) value.flags |= Interval::kInteger;
      return value;
    }
    case ExprOp::kVacant: {
      Interval value = Interval::None();
      value.flags = Interval::kVacant;
      return value;
    }
    case ExprOp::kVariable: {
      const std::uint32_t slot = slots_.Of(VariableId{std::size_t{expr.a}});
      const Variable& variable = module_.variables[VariableId{std::size_t{expr.a}}];
      if (slot == SlotMap::kNone || (variable.by_reference && shared_references_))
        return AllOf(variable.type, machine_, Interval::kInput);
      return Load(slot);
    }
    case ExprOp::kElement: {
      EvalIndices(id, expr);
      const Variable& variable = module_.variables[VariableId{std::size_t{expr.a}}];
      const std::uint32_t slot = slots_.Of(VariableId{std::size_t{expr.a}});
      if (variable.type == Type::kString) return Interval{0, 255, Interval::kWhole | Interval::kInteger};
      if (slot == SlotMap::kNone || (variable.by_reference && shared_references_))
        return AllOf(variable.type, machine_, Interval::kInput);
      return Load(slot);
    }
    case ExprOp::kCell: {
      const SpaceId space = SpaceOf(SpaceId{std::size_t{expr.a}}, expr.b);
      return space.Valid() ? ValueOf(space, expr.b) : Interval::Unknown(Interval::kInput | Interval::kVacant);
    }
    case ExprOp::kCellAt:
      return EvalCellAt(id, expr);
    case ExprOp::kSystem:
      return EvalSystem(expr);
    case ExprOp::kGroup:
      return Eval(ExprId{std::size_t{expr.a}});
    case ExprOp::kConvert: {
      const Interval value = Eval(ExprId{std::size_t{expr.a}});
      if (expr.type == Type::kInt && (expr.flags & Expr::kRoundCut) != 0) {
        if (observer_ != nullptr) observer_->Conversion(site_, id, Type::kInt, Cut(value), *this);
        return OrAnything(Converted(Cut(VacantAsZero(value)), Type::kInt, machine_), true, machine_);
      }
      Interval result = ConvertedTo(id, expr.type, WithoutVacant(value));
      if (value.Has(Interval::kVacant)) result.flags |= Interval::kVacant;
      return result;
    }
    case ExprOp::kPlus:
      return Operand(Eval(ExprId{std::size_t{expr.a}}), expr);
    case ExprOp::kNegate: {
      const Interval value = Operand(Eval(ExprId{std::size_t{expr.a}}), expr);
      return Operated(id, expr, &value, 1);
    }
    case ExprOp::kNot: {
      const Interval value = Truth(Eval(ExprId{std::size_t{expr.a}}));
      return Bool(value.high == 1, value.low == 0);
    }
    case ExprOp::kBitNot:
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor: {
      Interval operands[2] = {Operand(Eval(ExprId{std::size_t{expr.a}}), expr), Interval::Point(0)};
      if (expr.op != ExprOp::kBitNot) operands[1] = Operand(Eval(ExprId{std::size_t{expr.b}}), expr);
      return Operated(id, expr, operands, expr.op == ExprOp::kBitNot ? 1 : 2);
    }
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kMultiply:
    case ExprOp::kDivide:
    case ExprOp::kDivideInteger:
    case ExprOp::kModulo:
      return EvalBinary(id, expr);
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
      return EvalComparison(expr);
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor: {
      const Interval left = Truth(Eval(ExprId{std::size_t{expr.a}}));
      const Interval right = Truth(Eval(ExprId{std::size_t{expr.b}}));
      if (left.IsNone() || right.IsNone()) return Interval::None();
      const bool left_false = left.low == 0;
      const bool left_true = left.high == 1;
      const bool right_false = right.low == 0;
      const bool right_true = right.high == 1;
      if (expr.op == ExprOp::kAnd) return Bool(left_false || right_false, left_true && right_true);
      if (expr.op == ExprOp::kOr) return Bool(left_false && right_false, left_true || right_true);
      return Bool((left_true && right_true) || (left_false && right_false),
                  (left_true && right_false) || (left_false && right_true));
    }
    case ExprOp::kFunction:
      return EvalFunction(id, expr);
    case ExprOp::kConcat:
      (void)Eval(ExprId{std::size_t{expr.a}});
      (void)Eval(ExprId{std::size_t{expr.b}});
      return Interval::Unknown();
    case ExprOp::kText:
    case ExprOp::kAxisName:
    case ExprOp::kName:
      return Interval::Unknown();
  }
  return Interval::Unknown();
}

Interval ValueTransfer::EvalBinary(ExprId id, const Expr& expr) {
  const ExprId left{std::size_t{expr.a}};
  const ExprId right{std::size_t{expr.b}};
  const Interval operands[2] = {Operand(Eval(left), expr), Operand(Eval(right), expr)};
  const Interval result = Operated(id, expr, operands, 2);
  const bool divides = expr.op == ExprOp::kDivide || expr.op == ExprOp::kDivideInteger || expr.op == ExprOp::kModulo;
  // Whoever comes behind the division did not divide by 0.
  if (divides && operands[1].HasZero() && !looks_) {
    if (operands[1].IsZero()) {
      // No run comes behind it: one finding is enough, further ones for the same 0 are none.
      ExprId place = right;
      while (module_.exprs[place].op == ExprOp::kGroup || module_.exprs[place].op == ExprOp::kConvert)
        place = ExprId{std::size_t{module_.exprs[place].a}};
      const ExprOp op = module_.exprs[place].op;
      if (op == ExprOp::kVariable) ForgetPlace(place);
      if (op == ExprOp::kCell) Store(place, Interval::Unknown());
    } else {
      (void)Narrow(right, WithoutZero(operands[1]));
    }
  }
  return result;
}

/// Result of an operation with these operands; failing values are left out.
Interval ValueTransfer::Operated(ExprId id, const Expr& expr, const Interval* operands, std::size_t count) {
  if (observer_ != nullptr) observer_->Operation(site_, id, operands, count, *this);
  for (std::size_t i = 0; i < count; ++i) {
    if (!operands[i].HasNumber()) return OrAnything(Interval::None(), false, machine_);
  }
  const Interval a = operands[0];
  const Interval b = count > 1 ? operands[1] : Interval::Point(0);
  const bool whole = a.Has(Interval::kInteger) && (count == 1 || b.Has(Interval::kInteger));
  bool integer = whole;
  Interval result;
  switch (expr.op) {
    case ExprOp::kNegate:
      result = Negated(a);
      break;
    case ExprOp::kAdd:
      result = Sum(a, b);
      break;
    case ExprOp::kSubtract:
      result = Difference(a, b);
      break;
    case ExprOp::kMultiply:
      result = Product(a, b);
      break;
    case ExprOp::kDivide:
      result = Quotient(a, b);
      integer = false;
      break;
    case ExprOp::kDivideInteger:
    case ExprOp::kModulo: {
      const bool rounds = (expr.flags & Expr::kOperandsToInt) != 0;
      const Interval x = rounds ? Rounded(a) : a;
      const Interval y = rounds ? Rounded(b) : b;
      result = expr.op == ExprOp::kModulo ? Remainder(x, y) : WholeQuotient(x, y);
      integer = whole || rounds;
      break;
    }
    default: {  // bits
      integer = true;
      result = {static_cast<double>(-2147483648LL), 2147483647.0, Interval::kWhole};
      result.flags |= (a.flags | b.flags) & Interval::kInput;
      if (a.IsPoint() && b.IsPoint()) {
        const ops::BitOp op = expr.op == ExprOp::kBitAnd  ? ops::BitOp::kAnd
                              : expr.op == ExprOp::kBitOr ? ops::BitOp::kOr
                                                          : ops::BitOp::kXor;
        const ops::Number bits = expr.op == ExprOp::kBitNot ? ops::BitNot(a.low) : ops::Bits(op, a.low, b.low);
        result = bits.Ok() ? Interval::Point(bits.value) : Interval::None();
      } else if (expr.op == ExprOp::kBitAnd && (a.low >= 0 || b.low >= 0)) {
        result.low = 0;
        if (b.low >= 0) result.high = std::min(result.high, b.high);
        if (a.low >= 0) result.high = std::min(result.high, a.high);
        if (!(result.low <= result.high)) result.high = 2147483647.0;
        result.high = std::ceil(result.high);
      }
      break;
    }
  }
  return OrAnything(Finished(result, expr, integer), integer, machine_);
}

Interval ValueTransfer::EvalComparison(const Expr& expr) {
  const Interval a = Eval(ExprId{std::size_t{expr.a}});
  const Interval b = Eval(ExprId{std::size_t{expr.b}});
  const auto is_text = [&](std::uint32_t side) {
    const Type type = module_.exprs[ExprId{std::size_t{side}}].type;
    const ExprOp op = module_.exprs[ExprId{std::size_t{side}}].op;
    return type == Type::kString || type == Type::kAxis || type == Type::kFrame || op == ExprOp::kText ||
           op == ExprOp::kConcat || op == ExprOp::kAxisName;
  };
  if (is_text(expr.a) || is_text(expr.b)) {
    Interval open = Bool(true, true);
    open.flags |= Interval::kInput;
    return open;
  }
  const double tolerance = (expr.flags & Expr::kTolerance) != 0 ? machine_.compare_tolerance : 0;
  if ((expr.flags & Expr::kVacantDiffers) != 0 && (a.Has(Interval::kVacant) || b.Has(Interval::kVacant))) {
    const bool both_vacant = a.Has(Interval::kVacant) && b.Has(Interval::kVacant);
    const bool one_vacant = (a.Has(Interval::kVacant) && b.HasNumber()) || (b.Has(Interval::kVacant) && a.HasNumber());
    const Interval numbers = Compared(ExprOp::kEqual, WithoutVacant(a), WithoutVacant(b), tolerance);
    const bool same = both_vacant || (numbers.HasNumber() && numbers.high == 1);
    const bool differ = one_vacant || (numbers.HasNumber() && numbers.low == 0);
    Interval result = expr.op == ExprOp::kEqual ? Bool(differ, same) : Bool(same, differ);
    result.flags |= (a.flags | b.flags) & Interval::kInput;
    return result;
  }
  return Compared(expr.op, a, b, tolerance);
}

Interval ValueTransfer::EvalFunction(ExprId id, const Expr& expr) {
  const auto function = static_cast<Function>(expr.a);
  constexpr std::size_t kMost = 3;
  Interval args[kMost];
  for (std::uint32_t i = 0; i < expr.count; ++i) {
    const Interval value = Operand(Eval(module_.Item(expr.b + i)), expr);
    if (i < kMost) args[i] = value;
  }
  if (!ops::IsNumeric(function)) {
    switch (function) {
      case Function::kIsNumber:
      case Function::kIsVariable:
      case Function::kIsAxis:
        return Interval{0, 1, Interval::kWhole | Interval::kInteger | Interval::kInput};
      case Function::kStringLength:
        return Interval{0, kInfinity, Interval::kWhole | Interval::kInteger | Interval::kInput};
      case Function::kIndexOf:
      case Function::kLastIndexOf:
      case Function::kIndexOfAny:
      case Function::kFind:
        return Interval{-1, kInfinity, Interval::kWhole | Interval::kInteger | Interval::kInput};
      default:
        return Interval::Unknown();
    }
  }
  if (observer_ != nullptr) observer_->Operation(site_, id, args, expr.count, *this);
  Interval result = Apply(function, args, expr.count, machine_);
  const bool integer = result.Has(Interval::kInteger) || expr.type == Type::kInt;
  result = Finished(result, expr, integer);
  // Values behind the function are those of its domain.
  if (result.HasNumber() && expr.count == 1 && !looks_) {
    const ExprId argument = module_.Item(expr.b);
    if (function == Function::kSqrt && args[0].low < 0) (void)Narrow(argument, {0, kInfinity, Interval::kVacant});
    if (function == Function::kLn && args[0].low <= 0) (void)Narrow(argument, {0, kInfinity, Interval::kNonZero});
    if ((function == Function::kAsin || function == Function::kAcos) && (args[0].low < -1 || args[0].high > 1))
      (void)Narrow(argument, {-1, 1, Interval::kVacant});
  }
  return OrAnything(result, integer, machine_);
}

Interval ValueTransfer::EvalSystem(const Expr& expr) {
  for (std::uint32_t i = 0; i < expr.count; ++i) (void)Eval(module_.Item(expr.b + i));
  const System& system = module_.systems[SystemId{std::size_t{expr.a}}];
  switch (system.kind) {
    case SystemKind::kPi:
      return Interval::Point(kPi);
    case SystemKind::kWasProgrammed:
    case SystemKind::kModalCallActive:
      return AllOf(Type::kBool, machine_, Interval::kInput);
    default:
      // Read as vacant by some controls when nothing was set.
      return Interval::Unknown(Interval::kInput | Interval::kVacant);
  }
}

/// The space of that name that holds the number.
SpaceId ValueTransfer::SpaceOf(SpaceId any, double number) const {
  const Space& space = module_.spaces[any];
  if (number >= space.first && number <= space.last) return any;
  for (const SpaceId other : module_.spaces.Ids()) {
    const Space& candidate = module_.spaces[other];
    if (candidate.name == space.name && number >= candidate.first && number <= candidate.last) return other;
  }
  return {};
}

Interval ValueTransfer::EvalCellAt(ExprId id, const Expr& expr) {
  const Interval index = Rounded(Eval(ExprId{std::size_t{expr.a}}));
  const SpaceId named{std::size_t{expr.b}};
  CheckCell(id, named, index);
  if (index.IsPoint()) {
    const SpaceId space = SpaceOf(named, index.low);
    if (space.Valid()) return ValueOf(space, static_cast<std::uint32_t>(index.low));
  }
  return Interval::Unknown(Interval::kInput | Interval::kVacant);
}

/// Numbers of cells that do not exist. Where the machine has variables of its own beside the cells, only it knows.
void ValueTransfer::CheckCell(ExprId id, SpaceId named, const Interval& index) {
  if (observer_ == nullptr || !machine_.numbered_systems.empty()) return;
  std::uint32_t size = 0;
  for (const SpaceId other : module_.spaces.Ids()) {
    if (module_.spaces[other].name == module_.spaces[named].name) size = std::max(size, module_.spaces[other].last + 1);
  }
  observer_->Index(site_, id, 0, index, size, *this);
}

void ValueTransfer::EvalIndices(ExprId id, const Expr& expr) {
  const Variable& variable = module_.variables[VariableId{std::size_t{expr.a}}];
  for (std::uint32_t i = 0; i < expr.count; ++i) {
    const Interval index = Rounded(Operand(Eval(module_.Item(expr.b + i)), expr));
    std::uint32_t size = 0;
    if (i < variable.dimension_count) {
      size = variable.dimensions[i];
    } else if (variable.type == Type::kString) {
      size = variable.string_length == 0 ? machine_.string_max : variable.string_length;
    }
    if (size != 0 && observer_ != nullptr) observer_->Index(site_, id, i, index, size, *this);
  }
}

Interval ValueTransfer::ConvertedTo(ExprId expr, Type type, const Interval& value) {
  const bool number = type == Type::kInt || type == Type::kChar || type == Type::kBool || type == Type::kReal;
  if (!number) return type == Type::kNumber || type == Type::kAny || type == Type::kNone ? value : Interval::Unknown();
  if (observer_ != nullptr && (type == Type::kInt || type == Type::kChar))
    observer_->Conversion(site_, expr, type, value, *this);
  return OrAnything(Converted(value, type, machine_), type != Type::kReal, machine_);
}

}  // namespace ncport::ir::analysis
