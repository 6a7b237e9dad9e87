#include "ir/transform/linear_form.h"

#include <algorithm>
#include <cmath>

#include "ir/builder.h"

namespace ncport::ir::transform {

namespace {

/// Sums of decimals leave noise far below any increment; constants are cut to nine decimals.
double Clean(double value) {
  const double scaled = value * 1e9;
  return std::fabs(scaled) < 9e15 ? std::round(scaled) / 1e9 : value;
}

bool SameList(const Module& module, const Expr& a, const Expr& b) {
  if (a.count != b.count) return false;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    if (!SameExpr(module, module.Item(a.b + i), module.Item(b.b + i))) return false;
  }
  return true;
}

void AddTerm(const Module& module, LinearForm& form, ExprId atom, double coefficient) {
  const auto same = std::find_if(form.terms.begin(), form.terms.end(),
                                 [&](const LinearForm::Term& term) { return SameExpr(module, term.atom, atom); });
  if (same == form.terms.end()) {
    if (coefficient != 0) form.terms.push_back({atom, coefficient});
    return;
  }
  same->coefficient = Clean(same->coefficient + coefficient);
  if (same->coefficient == 0) form.terms.erase(same);
}

void Collect(const Module& module, ExprId id, double factor, LinearForm& form) {
  const Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
      form.constant += factor * expr.number;
      return;
    case ExprOp::kGroup:
    case ExprOp::kPlus:
      return Collect(module, ExprId{expr.a}, factor, form);
    case ExprOp::kNegate:
      return Collect(module, ExprId{expr.a}, -factor, form);
    case ExprOp::kConvert: {
      const Type from = module.exprs[ExprId{expr.a}].type;
      if (expr.type == Type::kReal && (from == Type::kInt || from == Type::kReal))
        return Collect(module, ExprId{expr.a}, factor, form);
      break;
    }
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
      Collect(module, ExprId{expr.a}, factor, form);
      return Collect(module, ExprId{expr.b}, expr.op == ExprOp::kAdd ? factor : -factor, form);
    case ExprOp::kMultiply:
      for (const auto& [number, other] : {std::pair{expr.a, expr.b}, std::pair{expr.b, expr.a}}) {
        const LinearForm left = FormOf(module, ExprId{number});
        if (left.IsConstant()) return Collect(module, ExprId{other}, factor * left.constant, form);
      }
      break;
    case ExprOp::kDivide: {
      // Only halves and the like: they lose nothing in binary, so the sum stays what the source computed.
      const LinearForm right = FormOf(module, ExprId{expr.b});
      int exponent = 0;
      if (right.IsConstant() && right.constant != 0 && std::fabs(std::frexp(right.constant, &exponent)) == 0.5) {
        return Collect(module, ExprId{expr.a}, factor / right.constant, form);
      }
      break;
    }
    default:
      break;
  }
  AddTerm(module, form, id, factor);
}

}  // namespace

bool SameExpr(const Module& module, ExprId a, ExprId b) {
  if (a == b) return true;
  if (!a.Valid() || !b.Valid()) return false;
  const Expr& x = module.exprs[a];
  const Expr& y = module.exprs[b];
  if (x.op == ExprOp::kGroup) return SameExpr(module, ExprId{x.a}, b);
  if (y.op == ExprOp::kGroup) return SameExpr(module, a, ExprId{y.a});
  if (x.op != y.op || x.type != y.type || x.flags != y.flags) return false;
  if (x.op == ExprOp::kLiteral) return x.number == y.number;
  switch (OperandsOf(x.op)) {
    case Operands::kLeaf:
      return x.a == y.a && (x.op != ExprOp::kCell || x.b == y.b);
    case Operands::kUnary:
      return SameExpr(module, ExprId{x.a}, ExprId{y.a}) && (x.op != ExprOp::kCellAt || x.b == y.b);
    case Operands::kBinary:
      return SameExpr(module, ExprId{x.a}, ExprId{y.a}) && SameExpr(module, ExprId{x.b}, ExprId{y.b});
    case Operands::kList:
      return x.a == y.a && SameList(module, x, y);
  }
  return false;
}

LinearForm FormOf(const Module& module, ExprId expr) {
  LinearForm form;
  Collect(module, expr, 1, form);
  return form;
}

LinearForm Sum(const Module& module, const LinearForm& a, const LinearForm& b, double factor) {
  LinearForm sum = a;
  sum.constant = Clean(sum.constant + factor * b.constant);
  for (const LinearForm::Term& term : b.terms) AddTerm(module, sum, term.atom, factor * term.coefficient);
  return sum;
}

bool SameForm(const Module& module, const LinearForm& a, const LinearForm& b) {
  const LinearForm rest = Sum(module, a, b, -1);
  return rest.IsConstant() && rest.constant == 0;
}

ExprId ExprOf(Module& module, const LinearForm& form) {
  ExprBuilder make(module);
  ExprId sum;
  const auto scaled = [&](const LinearForm::Term& term) {
    const double size = std::fabs(term.coefficient);
    return size == 1 ? term.atom : make.Binary(ExprOp::kMultiply, make.Literal(size), term.atom);
  };
  // What adds stands in front of what subtracts, so that no sum starts with a sign without need.
  for (const LinearForm::Term& term : form.terms) {
    if (term.coefficient < 0) continue;
    const ExprId part = scaled(term);
    sum = sum.Valid() ? make.Binary(ExprOp::kAdd, sum, part) : part;
  }
  const double constant = Clean(form.constant);
  if (constant > 0 || (!sum.Valid() && form.terms.empty())) {
    const ExprId part = make.Literal(constant);
    sum = sum.Valid() ? make.Binary(ExprOp::kAdd, sum, part) : part;
  }
  for (const LinearForm::Term& term : form.terms) {
    if (term.coefficient > 0) continue;
    const ExprId part = scaled(term);
    sum = sum.Valid() ? make.Binary(ExprOp::kSubtract, sum, part) : make.Unary(ExprOp::kNegate, part);
  }
  if (constant < 0 && !form.terms.empty()) sum = make.Binary(ExprOp::kSubtract, sum, make.Literal(-constant));
  return sum;
}

void VisitReads(const Module& module, ExprId expr, const std::function<void(ExprId)>& visit) {
  if (!expr.Valid()) return;
  const Expr& node = module.exprs[expr];
  switch (node.op) {
    case ExprOp::kVariable:
    case ExprOp::kElement:
    case ExprOp::kCell:
    case ExprOp::kCellAt:
    case ExprOp::kSystem:
      visit(expr);
      break;
    default:
      break;
  }
  switch (OperandsOf(node.op)) {
    case Operands::kLeaf:
      return;
    case Operands::kUnary:
      return VisitReads(module, ExprId{node.a}, visit);
    case Operands::kBinary:
      VisitReads(module, ExprId{node.a}, visit);
      return VisitReads(module, ExprId{node.b}, visit);
    case Operands::kList:
      for (std::uint32_t i = 0; i < node.count; ++i) VisitReads(module, module.Item(node.b + i), visit);
      return;
  }
}

}  // namespace ncport::ir::transform
