// Literals with more digits than the arithmetic of the control keeps.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "check/places.h"
#include "check/rules.h"
#include "ir/ops/arithmetic.h"

namespace ncport::check {
namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

class LostDigits {
 public:
  LostDigits(const ir::Module& module, int digits, diag::Sink& sink) : module_(module), digits_(digits), sink_(sink) {}

  void Look(const ir::Block& block, ExprId id) {
    const Expr& expr = module_.exprs[id];
    const bool written = expr.op == ExprOp::kLiteral && (expr.flags & Expr::kImplicit) == 0 &&
                         (expr.format.flags & ir::NumberFormat::kComputed) == 0;
    if (written && expr.format.int_digits + expr.format.decimals > digits_ && std::isfinite(expr.number) &&
        Kept(expr.number) != expr.number) {
      const SourceRange at = module_.RangeOf(block, id);
      sink_.Report(diag::Code::kLostDigits, at, fmt::format("{:.15g}", expr.number)).help =
          fmt::format("it counts as {:.{}g}", Kept(expr.number), digits_);
    }
    ForOperands(module_, expr, [&](ExprId operand) { Look(block, operand); });
  }

 private:
  /// The number that is left of it.
  [[nodiscard]] double Kept(double number) const { return std::stod(fmt::format("{:.{}e}", number, digits_ - 1)); }

  const ir::Module& module_;
  int digits_;
  diag::Sink& sink_;
};

}  // namespace

void CheckLostDigits(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const int digits = ir::ops::ResultDigits(subject.machine.numeric_model);
  if (digits == 0) return;
  const ir::Module& module = subject.module;
  LostDigits rule(module, digits, sink);
  for (const ir::BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = module.words[word_id];
      // Words with a literal alone have their own limit of digits.
      const bool computes = word.op == ir::WordOp::kAssign || word.op == ir::WordOp::kCall ||
                            ir::IsStructureMark(word.op) ||
                            (word.value.Valid() && module.exprs[word.value].op != ExprOp::kLiteral);
      if (computes) ForExpressions(module, word, [&](ExprId value) { rule.Look(block, value); });
    }
  }
}

}  // namespace ncport::check
