#include "check/places.h"

#include <fmt/format.h>

namespace ncport::check {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

namespace {

ExprId ReadIn(const ir::Module& module, ExprId id, const Expr& place) {
  const Expr& expr = module.exprs[id];
  if (SamePlace(expr, place)) return id;
  ExprId found;
  ForOperands(module, expr, [&](ExprId operand) {
    if (!found.Valid()) found = ReadIn(module, operand, place);
  });
  return found;
}

}  // namespace

std::string NameOfPlace(const ir::Module& module, const Expr& place) {
  if (place.op == ExprOp::kVariable)
    return std::string(module.View(module.variables[ir::VariableId{std::size_t{place.a}}].name));
  return fmt::format("{}{}", module.View(module.spaces[ir::SpaceId{std::size_t{place.a}}].name), place.b);
}

bool SetsPlace(const ir::Module& module, const ir::Word& word, const Expr& place) {
  if (word.op == WordOp::kAssign) return SamePlace(module.exprs[word.Extra<ExprId>()], place);
  if (word.op != WordOp::kFor) return false;
  const ExprId counter = module.fors[word.Extra<ir::ForId>()].variable;
  return counter.Valid() && SamePlace(module.exprs[counter], place);
}

bool MayTouchPlace(const ir::Module& module, const ir::Word& word, const Expr& place) {
  switch (word.op) {
    case WordOp::kVerbatim:
    case WordOp::kAssignList:
      return true;
    case WordOp::kAssign:
      return module.exprs[word.Extra<ExprId>()].op == ExprOp::kCellAt && place.op == ExprOp::kCell;
    case WordOp::kCall:
    case WordOp::kModalCall: {
      if (place.op == ExprOp::kCell) return true;
      const auto scope = module.variables[ir::VariableId{std::size_t{place.a}}].scope;
      if (scope != ir::Scope::kLocal && scope != ir::Scope::kParameter && scope != ir::Scope::kProgram) return true;
      bool argument = false;
      ForExpressions(module, word, [&](ExprId id) { argument = argument || SamePlace(module.exprs[id], place); });
      return argument;
    }
    default:
      return false;
  }
}

ExprId ReadOfPlace(const ir::Module& module, const ir::Word& word, const Expr& place) {
  ExprId found;
  const auto look = [&](ExprId id) {
    if (!found.Valid() && id.Valid()) found = ReadIn(module, id, place);
  };
  ForExpressions(module, word, look);
  if (word.op == WordOp::kFor) look(module.fors[word.Extra<ir::ForId>()].end);
  if (word.op == WordOp::kAssign && !SamePlace(module.exprs[word.Extra<ExprId>()], place)) look(word.Extra<ExprId>());
  return found;
}

}  // namespace ncport::check
