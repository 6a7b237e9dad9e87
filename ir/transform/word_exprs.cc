#include "ir/transform/word_exprs.h"

#include "ir/transform/linear_form.h"
#include "ir/word_values.h"

namespace ncport::ir::transform {

void VisitWordExprs(const Module& module, const Word& word, const std::function<void(ExprId root, bool place)>& visit) {
  VisitValues(module, word, [&](ExprId root) {
    if (root.Valid()) visit(root, false);
  });
  VisitPlaces(module, word, [&](ExprId root) {
    if (root.Valid()) visit(root, true);
  });
}

bool ReadsVariable(const Module& module, const Word& word, VariableId variable) {
  bool found = false;
  VisitWordExprs(module, word, [&](ExprId root, bool place) {
    VisitReads(module, root, [&](ExprId id) {
      const Expr& expr = module.exprs[id];
      const bool named = (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) && expr.a == variable.value;
      found = found || (named && !(place && id == root));
    });
  });
  return found;
}

}  // namespace ncport::ir::transform
