#include "check/structure_rules.h"
#include "check/word_expressions.h"
#include "ir/comparison.h"

namespace ncport::check {

namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

/// AND, OR, XOR or NOT that stands without brackets, past conversions that the compiler made.
ExprOp LogicIn(const ir::Module& module, ExprId id) {
  for (;;) {
    const Expr& expr = module.exprs[id];
    if (expr.op == ExprOp::kConvert) {
      id = ExprId{std::size_t{expr.a}};
      continue;
    }
    const bool logic =
        expr.op == ExprOp::kAnd || expr.op == ExprOp::kOr || expr.op == ExprOp::kXor || expr.op == ExprOp::kNot;
    return logic ? expr.op : ExprOp::kLiteral;
  }
}

/// The first comparison with bare logic beside it.
bool Find(const ir::Module& module, ExprId id, ExprId& found, ExprOp& logic) {
  const Expr& expr = module.exprs[id];
  if (ir::IsComparison(expr.op)) {
    for (const std::uint32_t side : {expr.a, expr.b}) {
      logic = LogicIn(module, ExprId{std::size_t{side}});
      if (logic == ExprOp::kLiteral) continue;
      found = id;
      return true;
    }
  }
  bool hit = false;
  ForOperands(module, expr, [&](ExprId operand) { hit = hit || Find(module, operand, found, logic); });
  return hit;
}

}  // namespace

void CheckComparisons(const ir::Module& module, ir::ProgramId program, diag::Sink& sink) {
  for (const ir::BlockId block_id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[block_id];
    for (const ir::WordId word : block.words) {
      ForExpressions(module, module.words[word], [&](ExprId expr) {
        ExprId found;
        ExprOp logic = ExprOp::kLiteral;
        if (!Find(module, expr, found, logic)) return;
        const std::string_view name = logic == ExprOp::kAnd   ? "AND"
                                      : logic == ExprOp::kOr  ? "OR"
                                      : logic == ExprOp::kXor ? "XOR"
                                                              : "NOT";
        SourceRange at = module.RangeOf(block, found);
        if (at.end <= at.begin) at = module.RangeOf(block, module.words[word]);
        sink.Report(diag::Code::kComparisonBesideLogic, at, name).help =
            logic == ExprOp::kNot ? "put the comparison in brackets: NOT (A==1)"
                                  : "put each comparison in brackets, for example (A==1) AND (B==1)";
      });
    }
  }
}

}  // namespace ncport::check
