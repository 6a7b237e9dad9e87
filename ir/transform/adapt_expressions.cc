#include "ir/transform/adapt_expressions.h"

#include <fmt/format.h>

#include <cmath>

#include "ir/builder.h"
#include "ir/ops/arithmetic.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::ir::transform {

namespace {

class Adapter {
 public:
  Adapter(Module& module, const AdaptExpressionsConfig& config) : module_(module), config_(config), make_(module) {}

  ExprId operator()(ExprId id) {
    Expr expr = module_.exprs[id];
    switch (expr.op) {
      case ExprOp::kFunction:
        return Function(id, expr);
      case ExprOp::kModulo:
      case ExprOp::kDivideInteger:
        if ((expr.flags & Expr::kOperandsToInt) == 0 || config_.modulo_rounds_operands) return id;
        expr.a = Rounded(ExprId{std::size_t{expr.a}}).value;
        expr.b = Rounded(ExprId{std::size_t{expr.b}}).value;
        expr.flags = static_cast<std::uint8_t>(expr.flags & ~Expr::kOperandsToInt);
        return module_.AddExpr(expr);
      case ExprOp::kEqual:
      case ExprOp::kNotEqual:
      case ExprOp::kLess:
      case ExprOp::kLessEqual:
      case ExprOp::kGreater:
      case ExprOp::kGreaterEqual:
        return Comparison(id, expr);
      default:
        return id;
    }
  }

 private:
  /// A difference is compared with 0, from which only 0 itself is no relative step away (sinumerik-4.2).
  ExprId Comparison(ExprId id, Expr expr) {
    if (!config_.relative_comparisons || (expr.flags & Expr::kTolerance) != 0) return id;
    const ExprId left{std::size_t{expr.a}}, right{std::size_t{expr.b}};
    const Type type = module_.exprs[left].type;
    if (type == Type::kString || type == Type::kBool || type == Type::kAxis) return id;
    expr.flags |= Expr::kTolerance;
    if (!IsZero(left) && !IsZero(right) && !(IsWholeLiteral(left) && IsWholeLiteral(right))) {
      expr.a = make_.Binary(ExprOp::kSubtract, left, right).value;
      expr.b = make_.Number("0").value;
    }
    return module_.AddExpr(expr);
  }

  ExprId Function(ExprId id, const Expr& expr) {
    const auto arg = [&](std::uint32_t i) { return module_.Item(expr.b + i); };
    switch (static_cast<ir::Function>(expr.a)) {
      case ir::Function::kAtan:
        if (config_.has_atan) return id;
        return make_.Function(ir::Function::kAtan2, {arg(0), make_.Number("1")});
      case ir::Function::kAtan2Positive:
        if (config_.positive_angles) return id;
        return FromZero(make_.Function(ir::Function::kAtan2, {arg(0), arg(1)}));
      case ir::Function::kAsinPositive:
        if (config_.positive_angles) return id;
        return FromZero(make_.Function(ir::Function::kAsin, {arg(0)}));
      case ir::Function::kRoundAway: {
        if (config_.has_round_away) return id;
        // Upward on both sides of 0.
        const auto side = [&](ExprId value) {
          return make_.Function(ir::Function::kRoundUp,
                                {make_.Function(ir::Function::kMaximum, {value, make_.Number("0")})});
        };
        const ExprId up = side(arg(0));
        const ExprId down = side(make_.Unary(ExprOp::kNegate, arg(0)));
        return make_.Unary(ExprOp::kGroup, make_.Binary(ExprOp::kSubtract, up, down));
      }
      case ir::Function::kRoundToIncrement:
        if (config_.has_round_to_increment) return id;
        return make_.Unary(ExprOp::kGroup, RoundedTo(module_, arg(0), config_.increment));
      default:
        return id;
    }
  }

  /// `angle`, and a turn more where it is negative: a truth value counts as 0 or 1 (sinumerik-3.3, 4.2).
  ExprId FromZero(ExprId angle) {
    Expr less;
    less.op = ExprOp::kLess;
    less.type = Type::kBool;
    less.flags = Expr::kTolerance;
    less.a = angle.value;
    less.b = make_.Number("0").value;
    const ExprId negative = make_.Unary(ExprOp::kGroup, module_.AddExpr(less));
    return make_.Unary(ExprOp::kGroup, make_.Binary(ExprOp::kAdd, angle,
                                                    make_.Binary(ExprOp::kMultiply, make_.Number("360"), negative)));
  }

  ExprId Rounded(ExprId id) {
    if (IsWholeLiteral(id)) return id;
    return make_.Function(ir::Function::kRound, {id});
  }

  [[nodiscard]] bool IsZero(ExprId id) const {
    const Expr& expr = module_.exprs[id];
    return expr.op == ExprOp::kLiteral && expr.number == 0;
  }
  [[nodiscard]] bool IsWholeLiteral(ExprId id) const {
    const Expr& expr = module_.exprs[id];
    return expr.op == ExprOp::kLiteral && expr.number == std::floor(expr.number) && std::fabs(expr.number) < 1e9;
  }

  Module& module_;
  const AdaptExpressionsConfig& config_;
  ExprBuilder make_;
};

}  // namespace

void AdaptExpressions(Module& module, ProgramId program, const AdaptExpressionsConfig& config) {
  Adapter adapter(module, config);
  RewriteProgram(module, program, [&](Module&, ExprId id) { return adapter(id); });
}

ExprId RoundedTo(Module& module, ExprId value, double increment) {
  ExprBuilder make(module);
  const ops::IncrementSteps steps = ops::StepsOf(increment);
  const ExprId counted = make.Binary(ExprOp::kMultiply, value, make.Number(fmt::format("{}", steps.factor)));
  return make.Binary(ExprOp::kDivide, make.Function(Function::kRound, {counted}), make.Literal(steps.per, Type::kInt));
}

}  // namespace ncport::ir::transform
