#include "ir/literal_value.h"

#include <cmath>

namespace ncport::ir {

std::optional<double> LiteralValue(const Module& module, ExprId id) {
  if (!id.Valid()) return std::nullopt;
  const Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
      return expr.number;
    case ExprOp::kGroup:
    case ExprOp::kPlus:
      return LiteralValue(module, ExprId{expr.a});
    case ExprOp::kNegate: {
      const auto value = LiteralValue(module, ExprId{expr.a});
      return value ? std::optional(0.0 - *value) : std::nullopt;
    }
    case ExprOp::kConvert:
      return expr.type == Type::kReal ? LiteralValue(module, ExprId{expr.a}) : std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<std::uint32_t> WholeNumber(const Module& module, ExprId id, std::uint32_t most) {
  if (!id.Valid()) return std::nullopt;
  const Expr& expr = module.exprs[id];
  if (expr.op == ExprOp::kGroup || expr.op == ExprOp::kConvert) return WholeNumber(module, ExprId{expr.a}, most);
  if (expr.op != ExprOp::kLiteral || expr.number < 0 || expr.number != std::floor(expr.number) || expr.number > most)
    return std::nullopt;
  return static_cast<std::uint32_t>(expr.number);
}

}  // namespace ncport::ir
