// The expressions of a word and of an expression, for rules that look at their form.
#pragma once

#include "ir/module.h"

namespace ncport::check {

template <class Visit>
void ForOperands(const ir::Module& module, const ir::Expr& expr, Visit visit) {
  switch (ir::OperandsOf(expr.op)) {
    case ir::Operands::kLeaf:
      return;
    case ir::Operands::kUnary:
      visit(ir::ExprId{std::size_t{expr.a}});
      return;
    case ir::Operands::kBinary:
      visit(ir::ExprId{std::size_t{expr.a}});
      visit(ir::ExprId{std::size_t{expr.b}});
      return;
    case ir::Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) visit(module.Item(expr.b + i));
      return;
  }
}

/// The values of a word that are conditions, assigned values or arguments.
template <class Visit>
void ForExpressions(const ir::Module& module, const ir::Word& word, Visit visit) {
  if (word.value.Valid()) visit(word.value);
  if (word.op != ir::WordOp::kCall && word.op != ir::WordOp::kModalCall) return;
  if (!word.Extra<ir::CallId>().Valid()) return;
  for (const ir::ArgId arg : module.calls[word.Extra<ir::CallId>()].args) {
    if (module.args[arg].value.Valid()) visit(module.args[arg].value);
  }
}

}  // namespace ncport::check
