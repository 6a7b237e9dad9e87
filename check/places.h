// Variables without an index and cells with a number: places that can be told apart, and what words do to them.
#pragma once

#include <string>

#include "check/word_expressions.h"
#include "ir/module.h"

namespace ncport::check {

inline bool IsPlace(const ir::Expr& expr) { return expr.op == ir::ExprOp::kVariable || expr.op == ir::ExprOp::kCell; }
inline bool SamePlace(const ir::Expr& a, const ir::Expr& b) {
  return IsPlace(a) && a.op == b.op && a.a == b.a && (a.op == ir::ExprOp::kVariable || a.b == b.b);
}

/// "COUNT", "R10".
std::string NameOfPlace(const ir::Module& module, const ir::Expr& place);
/// True if the word surely sets the place.
bool SetsPlace(const ir::Module& module, const ir::Word& word, const ir::Expr& place);
/// True if the word may do with the place what is not known here.
bool MayTouchPlace(const ir::Module& module, const ir::Word& word, const ir::Expr& place);
/// Where the word reads the place, or none.
ir::ExprId ReadOfPlace(const ir::Module& module, const ir::Word& word, const ir::Expr& place);

}  // namespace ncport::check
