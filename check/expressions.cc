#include "check/expressions.h"

namespace ncport::check {

using ir::ExprId;
using ir::ExprOp;

ExprId Plain(const ir::Module& module, ExprId expr) {
  while (expr.Valid()) {
    const ir::Expr& record = module.exprs[expr];
    if (record.op != ExprOp::kGroup && record.op != ExprOp::kConvert) break;
    expr = ExprId{std::size_t{record.a}};
  }
  return expr;
}

std::optional<double> LiteralValue(const ir::Module& module, ExprId expr) {
  double sign = 1;
  for (ExprId at = Plain(module, expr); at.Valid();) {
    const ir::Expr& record = module.exprs[at];
    if (record.op == ExprOp::kLiteral) return sign * record.number;
    if (record.op == ExprOp::kNegate) {
      sign = -sign;
    } else if (record.op != ExprOp::kPlus) {
      break;
    }
    at = Plain(module, ExprId{std::size_t{record.a}});
  }
  return std::nullopt;
}

}  // namespace ncport::check
