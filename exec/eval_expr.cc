// Numbers, truth and bits.
#include <algorithm>
#include <cmath>

#include "base/result.h"
#include "exec/evaluator.h"
#include "ir/length_units.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/convert.h"
#include "ir/ops/functions.h"
#include "ir/ops/text.h"

namespace ncport::exec {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Type;
namespace ops = ir::ops;

namespace {

constexpr bool IsWhole(Type type) { return type == Type::kInt || type == Type::kBool || type == Type::kChar; }

}  // namespace

Evaluator::Evaluator(Session& session, Memory& memory, Texts& texts, const Channel& channel, const CallFacts& facts)
    : session_(session),
      module_(session.module),
      machine_(session.machine),
      memory_(memory),
      texts_(texts),
      channel_(channel),
      facts_(facts) {}

Value Evaluator::Eval(ExprId id) {
  const Expr& expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
      return LiteralOf(expr);
    case ExprOp::kText: {
      StringId text;
      text.value = expr.a;
      return Texts::Constant(text);
    }
    case ExprOp::kVacant:
      return Value::Vacant();
    case ExprOp::kAxisName:
      return Value::Axis(static_cast<std::uint8_t>(expr.a));
    case ExprOp::kVariable:
    case ExprOp::kElement:
    case ExprOp::kCell:
    case ExprOp::kCellAt:
      return EvalStored(id, expr);
    case ExprOp::kSystem:
      return EvalSystem(expr);
    case ExprOp::kName:
      session_.Refuse(diag::Code::kUnknownName, module_.View(StringId{std::size_t{expr.a}}));
      return Value::Vacant();
    case ExprOp::kGroup:
      return Eval(ExprId{std::size_t{expr.a}});
    case ExprOp::kConvert:
    case ExprOp::kPlus:
    case ExprOp::kNegate:
    case ExprOp::kNot:
    case ExprOp::kBitNot:
      return EvalUnary(expr);
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kMultiply:
    case ExprOp::kDivide:
    case ExprOp::kDivideInteger:
    case ExprOp::kModulo:
      return EvalArithmetic(id, expr);
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
      // Both sides are evaluated: no short circuit is documented (sinumerik-4.2).
      const bool left = Truth(ExprId{std::size_t{expr.a}});
      const bool right = Truth(ExprId{std::size_t{expr.b}});
      return Value::Bool(expr.op == ExprOp::kAnd  ? left && right
                         : expr.op == ExprOp::kOr ? left || right
                                                  : left != right);
    }
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
      return EvalBits(expr);
    case ExprOp::kConcat:
      return EvalConcat(expr);
    case ExprOp::kFunction:
      return EvalFunction(expr);
  }
  NCPORT_BUG("expression {} has no operation", id.value);
}

/// Cells and scalars that hold a value are read at once; all else goes by its place.
Value Evaluator::EvalStored(ExprId id, const Expr& expr) {
  if (expr.op == ExprOp::kCell) {
    const SpaceSlot& slot = session_.linked.SlotOf(ir::SpaceId{std::size_t{expr.a}});
    const ir::Space& space = module_.spaces[ir::SpaceId{std::size_t{expr.a}}];
    if (!slot.per_level && expr.b >= space.first && expr.b <= space.last) {
      const Value& value = memory_[slot.offset + expr.b - space.first];
      if (!value.IsVacant()) return value;
    }
  } else if (expr.op == ExprOp::kVariable) {
    const ir::VariableId variable{std::size_t{expr.a}};
    const VariableSlot& slot = session_.linked.SlotOf(variable);
    const ir::Variable& record = module_.variables[variable];
    if (slot.in_frame && record.owner == facts_.program && !record.by_reference) {
      const Value& value = memory_[facts_.frame + slot.offset];
      if (!value.IsVacant()) return value;
    }
  }
  return Load(PlaceOf(id));
}

bool Evaluator::ToTruth(const Value& value) const {
  return value.IsText() ? !texts_.View(value).empty() : value.number != 0;
}

double Evaluator::ToNumber(const Value& value) {
  if (value.IsText()) {
    session_.Alarm(ir::AlarmClass::kConversion, "text where a number is needed");
    return 0;
  }
  return value.number;  // 0 when vacant
}

/// Operand of arithmetic. A vacant one is 0 where the language says so; elsewhere nothing vacant can come up.
double Evaluator::Operand(const Value& value, const Expr& expr) {
  if (value.IsVacant() && (expr.flags & Expr::kVacantAsZero) == 0)
    session_.Refuse(diag::Code::kCannotRun, "an empty value in arithmetic");
  return ToNumber(value);
}

/// Result of an operation: error, numeric model and type applied. Whole results keep the INT range.
Value Evaluator::Finished(ops::Number number, const Expr& expr, bool integer) {
  if (!number.Ok()) [[unlikely]] {
    session_.Alarm(number.error);
    return Value::Real(0);
  }
  if (integer) {
    if (number.value > static_cast<double>(machine_.int_max) || number.value < static_cast<double>(machine_.int_min))
        [[unlikely]] {
      session_.Alarm(ops::Error::kOverflow);
      return Value::Int(0);
    }
    return Value::Int(number.value);
  }
  if ((expr.flags & Expr::kNumericModel) != 0)
    return Value::Real(ops::ApplyModel(number.value, machine_.numeric_model));
  return Value::Real(number.value);
}

Value Evaluator::EvalUnary(const Expr& expr) {
  const Value value = Eval(ExprId{std::size_t{expr.a}});
  switch (expr.op) {
    case ExprOp::kConvert:
      if (expr.type == Type::kInt && (expr.flags & Expr::kRoundCut) != 0) {
        const ops::Number cut = ops::ToIntCut(ToNumber(value), machine_);
        session_.Alarm(cut.error);
        return Value::Int(cut.value);
      }
      if (value.IsVacant()) return value;
      return Converted(value, expr.type);
    case ExprOp::kNot:
      return Value::Bool(!ToTruth(value));
    case ExprOp::kBitNot:
      return Finished(ops::BitNot(Operand(value, expr)), expr, true);
    case ExprOp::kNegate: {
      const double number = Operand(value, expr);
      return Finished({0.0 - number, ops::Error::kNone}, expr, IsWhole(value.type));
    }
    default: {
      const double number = Operand(value, expr);
      return IsWhole(value.type) ? Value::Int(number) : Value::Real(number);
    }
  }
}

void Evaluator::NoteQuotient(ExprId id, double numerator, double denominator) {
  Coverage* const coverage = session_.coverage;
  if (coverage == nullptr || coverage->quotients.size() >= Coverage::kMaxQuotients) return;
  coverage->quotients.push_back({id, numerator, denominator});
}

Value Evaluator::EvalArithmetic(ExprId id, const Expr& expr) {
  const Value left = Eval(ExprId{std::size_t{expr.a}});
  const Value right = Eval(ExprId{std::size_t{expr.b}});
  double a = Operand(left, expr);
  double b = Operand(right, expr);
  const bool whole = IsWhole(left.type) && IsWhole(right.type);
  switch (expr.op) {
    case ExprOp::kAdd:
      return Finished(ops::Add(a, b), expr, whole);
    case ExprOp::kSubtract:
      return Finished(ops::Subtract(a, b), expr, whole);
    case ExprOp::kMultiply:
      return Finished(ops::Multiply(a, b), expr, whole);
    case ExprOp::kDivide:
      NoteQuotient(id, a, b);
      return Finished(ops::Divide(a, b), expr, false);
    default:
      break;
  }
  if ((expr.flags & Expr::kOperandsToInt) != 0) {
    a = ops::Round(a);
    b = ops::Round(b);
  }
  NoteQuotient(id, a, b);
  return Finished(expr.op == ExprOp::kModulo ? ops::Modulo(a, b) : ops::DivideInteger(a, b), expr,
                  whole || (expr.flags & Expr::kOperandsToInt) != 0);
}

Value Evaluator::EvalComparison(const Expr& expr) {
  const Value left = Eval(ExprId{std::size_t{expr.a}});
  const Value right = Eval(ExprId{std::size_t{expr.b}});
  if (left.IsText() || right.IsText()) {
    if (!left.IsText() || !right.IsText()) {
      session_.Alarm(ir::AlarmClass::kConversion, "text compared with a number");
      return Value::Bool(false);
    }
    const int order = texts_.View(left).compare(texts_.View(right));  // by code
    switch (expr.op) {
      case ExprOp::kEqual:
        return Value::Bool(order == 0);
      case ExprOp::kNotEqual:
        return Value::Bool(order != 0);
      case ExprOp::kLess:
        return Value::Bool(order < 0);
      case ExprOp::kLessEqual:
        return Value::Bool(order <= 0);
      case ExprOp::kGreater:
        return Value::Bool(order > 0);
      default:
        return Value::Bool(order >= 0);
    }
  }
  if ((expr.flags & Expr::kVacantDiffers) != 0 && (left.IsVacant() || right.IsVacant())) {
    const bool same = left.IsVacant() && right.IsVacant();
    return Value::Bool((expr.op == ExprOp::kEqual) == same);
  }
  const double a = left.number;
  const double b = right.number;
  const double tolerance = (expr.flags & Expr::kTolerance) != 0 ? machine_.compare_tolerance : 0;
  switch (expr.op) {
    case ExprOp::kEqual:
      return Value::Bool(ops::Equal(a, b, tolerance));
    case ExprOp::kNotEqual:
      return Value::Bool(!ops::Equal(a, b, tolerance));
    case ExprOp::kLess:
      return Value::Bool(ops::Less(a, b, tolerance));
    case ExprOp::kLessEqual:
      return Value::Bool(!ops::Less(b, a, tolerance));
    case ExprOp::kGreater:
      return Value::Bool(ops::Less(b, a, tolerance));
    default:
      return Value::Bool(!ops::Less(a, b, tolerance));
  }
}

Value Evaluator::EvalBits(const Expr& expr) {
  const double a = Operand(Eval(ExprId{std::size_t{expr.a}}), expr);
  const double b = Operand(Eval(ExprId{std::size_t{expr.b}}), expr);
  const ops::BitOp op = expr.op == ExprOp::kBitAnd  ? ops::BitOp::kAnd
                        : expr.op == ExprOp::kBitOr ? ops::BitOp::kOr
                                                    : ops::BitOp::kXor;
  return Finished(ops::Bits(op, a, b), expr, true);
}

Value Evaluator::EvalFunction(const Expr& expr) {
  const auto function = static_cast<ir::Function>(expr.a);
  if (!ops::IsNumeric(function)) return EvalTextFunction(expr);
  constexpr std::size_t kMost = 3;
  NCPORT_CHECK(expr.count <= kMost, "{} with {} arguments", ir::NameOf(function), expr.count);
  double args[kMost] = {};
  bool whole = true;
  for (std::uint32_t i = 0; i < expr.count; ++i) {
    const Value value = Eval(module_.Item(expr.b + i));
    args[i] = Operand(value, expr);
    whole = whole && IsWhole(value.type);
  }
  if (session_.halted) return Value::Real(0);
  if (function == ir::Function::kRoundToIncrement)
    return Finished({ops::RoundToIncrement(args[0], WordIncrement())}, expr, false);
  // These keep the type of what they choose from; others give REAL unless the language types them INT.
  const bool keeps = function == ir::Function::kAbs || function == ir::Function::kMinimum ||
                     function == ir::Function::kMaximum || function == ir::Function::kBound;
  return Finished(ops::Apply(function, args, expr.count, machine_), expr, (keeps && whole) || expr.type == Type::kInt);
}

/// The least increment of the word whose value is being worked out; its block may settle the unit itself (fanuc-4.4).
double Evaluator::WordIncrement() const {
  ir::Units units = channel_.modal.units;
  for (const ir::WordId id : module_.blocks[session_.block].words) {
    const ir::Word& word = module_.words[id];
    if (word.op == ir::WordOp::kUnits) units = static_cast<ir::Units>(word.index);
  }
  const ir::Word* word = session_.word;
  const bool angle = word != nullptr && ((word->op == ir::WordOp::kAxis && ir::IsRotary(word->index)) ||
                                         word->op == ir::WordOp::kFrameAngle || word->op == ir::WordOp::kContourAngle);
  return angle || !ir::LengthsAreInches(units) ? machine_.increment : machine_.increment / 10;
}

Value Evaluator::Converted(const Value& value, Type type, std::uint32_t string_length) {
  if (value.type == type && type != Type::kString) return value;
  switch (type) {
    case Type::kNone:
    case Type::kAny:
    case Type::kNumber:
      return value;
    case Type::kReal:
      return Value::Real(ToNumber(value));
    case Type::kInt:
    case Type::kBool:
    case Type::kChar: {
      if (value.IsText()) {
        const std::string_view text = texts_.View(value);
        if (type == Type::kBool) return Value::Bool(!text.empty());
        if (type == Type::kChar && ops::Length(text) == 1) return Value::Char(ops::CharacterAt(text, 0).code);
        session_.Alarm(ops::Error::kConversion);
        return {type, 0, 0};
      }
      const ops::Number number = ops::Convert(value.number, type, machine_);
      session_.Alarm(number.error);
      return {type, 0, number.value};
    }
    case Type::kString: {
      const std::uint32_t most =
          string_length == 0 ? machine_.string_max : std::min(string_length, machine_.string_max);
      if (value.IsText()) {
        const std::string_view text = texts_.View(value);
        if (text.size() <= most || ops::Length(text) <= most) return value;
        TextBuffer cut;  // longer than its variable: cut (sinumerik-4.6)
        cut.Append(ops::Substring(text, 0, most));
        return NewText(cut.View());
      }
      if (value.type != Type::kChar && value.type != Type::kBool) {
        session_.Alarm(ops::Error::kConversion);
        return Value::Text(0);
      }
      TextBuffer text;
      AppendText(text, value);
      return NewText(text.View());
    }
    case Type::kAxis:
    case Type::kFrame:
      session_.Alarm(ops::Error::kConversion);
      return {type, 0, 0};
  }
  return value;
}

}  // namespace ncport::exec
