#include "ir/never_alarms.h"

#include <algorithm>

namespace ncport::ir {

namespace {

bool IsHarmless(ExprOp op) {
  switch (op) {
    case ExprOp::kLiteral:
    case ExprOp::kVariable:
    case ExprOp::kCell:
    case ExprOp::kAxisName:
    case ExprOp::kGroup:
    case ExprOp::kPlus:
    case ExprOp::kNegate:
    case ExprOp::kNot:
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kMultiply:
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor:
      return true;
    default:
      return false;
  }
}

}  // namespace

bool NeverAlarms(const Module& module, ExprId id, std::span<const ExprOp> also) {
  const Expr& expr = module.exprs[id];
  if (!IsHarmless(expr.op) && std::ranges::find(also, expr.op) == also.end()) return false;
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return true;
    case Operands::kUnary:
      return NeverAlarms(module, ExprId{std::size_t{expr.a}}, also);
    case Operands::kBinary:
      return NeverAlarms(module, ExprId{std::size_t{expr.a}}, also) &&
             NeverAlarms(module, ExprId{std::size_t{expr.b}}, also);
    case Operands::kList:
      return false;
  }
  return false;
}

}  // namespace ncport::ir
