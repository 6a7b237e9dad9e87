// Literals with more digits than the arithmetic of the control keeps.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "check/places.h"
#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

constexpr int kDecimalDigits = 8;  // of controls that compute with eight digits (fanuc-3.4)

/// The number that is left of it.
double Kept(double number) { return std::stod(fmt::format("{:.{}e}", number, kDecimalDigits - 1)); }

class LostDigits {
 public:
  LostDigits(const ir::Module& module, diag::Sink& sink) : module_(module), sink_(sink) {}

  void Look(const ir::Block& block, ExprId id) {
    const Expr& expr = module_.exprs[id];
    const bool written = expr.op == ExprOp::kLiteral && (expr.flags & Expr::kImplicit) == 0 &&
                         (expr.format.flags & ir::NumberFormat::kComputed) == 0;
    if (written && expr.format.int_digits + expr.format.decimals > kDecimalDigits && std::isfinite(expr.number) &&
        Kept(expr.number) != expr.number) {
      const SourceRange at = module_.RangeOf(block, id);
      sink_.Report(diag::Code::kLostDigits, at, fmt::format("{:.15g}", expr.number)).help =
          fmt::format("it counts as {:.8g}", Kept(expr.number));
    }
    ForOperands(module_, expr, [&](ExprId operand) { Look(block, operand); });
  }

 private:
  const ir::Module& module_;
  diag::Sink& sink_;
};

}  // namespace

void CheckLostDigits(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  if (subject.machine.numeric_model != ir::NumericModel::kDecimal8) return;
  const ir::Module& module = subject.module;
  LostDigits rule(module, sink);
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
