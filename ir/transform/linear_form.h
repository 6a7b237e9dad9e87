// A value as a sum: constant + coefficient * atom + ..., where atoms are expressions that no sum takes apart. Positions
// that increments lead to are kept this way, so that a step away and back cancels to what it was.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ir/module.h"

namespace ncport::ir::transform {

struct LinearForm {
  struct Term {
    ExprId atom;
    double coefficient = 1;
  };
  double constant = 0;
  std::vector<Term> terms;  // no two atoms are the same, no coefficient is 0

  [[nodiscard]] bool IsConstant() const { return terms.empty(); }
};

/// Same operations on the same operands; literals by value, names by what they name.
bool SameExpr(const Module& module, ExprId a, ExprId b);

LinearForm FormOf(const Module& module, ExprId expr);
/// a + factor * b. Atoms that cancel vanish; constants lose the noise of sums of decimals.
LinearForm Sum(const Module& module, const LinearForm& a, const LinearForm& b, double factor = 1);
bool SameForm(const Module& module, const LinearForm& a, const LinearForm& b);
/// The form as an expression: `atom - 2*atom + constant`.
ExprId ExprOf(Module& module, const LinearForm& form);

/// Calls `visit` for every Variable, Element, Cell, CellAt and System node below `expr`, itself included.
void VisitReads(const Module& module, ExprId expr, const std::function<void(ExprId)>& visit);

}  // namespace ncport::ir::transform
