#include <fmt/format.h>

#include <cmath>

#include "check/expressions.h"
#include "check/rules.h"
#include "check/word_expressions.h"

namespace ncport::check {
namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

/// A fraction that binary numbers do not hold exactly; halves, quarters and so on they do.
bool IsFraction(const std::optional<double>& value) { return value && *value * 1024 != std::trunc(*value * 1024); }

/// The first comparison for equality of a computed value with such a fraction.
bool Find(const ir::Module& module, ExprId id, ExprId& found, double& fraction) {
  const Expr& expr = module.exprs[id];
  const bool equality = expr.op == ExprOp::kEqual || expr.op == ExprOp::kNotEqual;
  if (equality && (expr.flags & Expr::kTolerance) == 0) {
    const std::optional<double> left = LiteralValue(module, ExprId{std::size_t{expr.a}});
    const std::optional<double> right = LiteralValue(module, ExprId{std::size_t{expr.b}});
    if (left.has_value() != right.has_value() && (IsFraction(left) || IsFraction(right))) {
      found = id;
      fraction = left ? *left : *right;
      return true;
    }
  }
  bool hit = false;
  ForOperands(module, expr, [&](ExprId operand) { hit = hit || Find(module, operand, found, fraction); });
  return hit;
}

}  // namespace

void CheckExactComparisons(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  for (const ir::BlockId block_id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[block_id];
    for (const ir::WordId word : block.words) {
      ForExpressions(module, module.words[word], [&](ExprId expr) {
        ExprId found;
        double fraction = 0;
        if (!Find(module, expr, found, fraction)) return;
        SourceRange at = module.RangeOf(block, found);
        if (at.end <= at.begin) at = module.RangeOf(block, module.words[word]);
        const bool unequal = module.exprs[found].op == ExprOp::kNotEqual;
        sink.Report(diag::Code::kExactComparison, at, unequal ? "false" : "true", fmt::format("{:.10g}", fraction))
            .help = "compare with a band, for example ABS of the difference below 0.001";
      });
    }
  }
}

}  // namespace ncport::check
