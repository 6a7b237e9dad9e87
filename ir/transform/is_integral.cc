#include "ir/transform/is_integral.h"

#include <cmath>

#include "ir/transform/conditions.h"

namespace ncport::ir::transform {

bool IsIntegral(const Module& module, ExprId id) {
  const Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
      return expr.number == std::floor(expr.number);
    case ExprOp::kVariable:
    case ExprOp::kElement:
      return expr.type == Type::kInt || expr.type == Type::kBool || expr.type == Type::kChar;
    case ExprOp::kConvert:
      return expr.type == Type::kInt || expr.type == Type::kBool || expr.type == Type::kChar ||
             IsIntegral(module, ExprId{expr.a});
    case ExprOp::kGroup:
    case ExprOp::kNegate:
    case ExprOp::kPlus:
      return IsIntegral(module, ExprId{expr.a});
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kMultiply:
      return IsIntegral(module, ExprId{expr.a}) && IsIntegral(module, ExprId{expr.b});
    case ExprOp::kDivideInteger:
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
    case ExprOp::kBitNot:
      return true;
    case ExprOp::kModulo:
      return IsIntegral(module, ExprId{expr.a}) && IsIntegral(module, ExprId{expr.b});
    case ExprOp::kFunction:
      switch (static_cast<Function>(expr.a)) {
        case Function::kTruncate:
        case Function::kRound:
        case Function::kRoundUp:
        case Function::kRoundAway:
          return true;
        case Function::kAbs:
        case Function::kSquare:
          return IsIntegral(module, module.Item(expr.b));
        default:
          return false;
      }
    default:
      return IsTruth(module, id);
  }
}

}  // namespace ncport::ir::transform
