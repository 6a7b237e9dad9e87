#include "backends/fanuc/message_text.h"

#include "base/number_text.h"

namespace ncport::backends::fanuc {

namespace {

using ir::ExprId;
using ir::ExprOp;
using ir::Module;

std::string NumberText(double value) {
  TextBuffer text;
  AppendTrimmed(text, value, 6);
  return std::string(text.View());
}

}  // namespace

void AppendMessage(const Module& module, ExprId id, std::string& out) {
  if (!id.Valid()) return;
  const ir::Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kText:
      out += module.View(StringId{expr.a});
      return;
    case ExprOp::kConcat:
      AppendMessage(module, ExprId{expr.a}, out);
      AppendMessage(module, ExprId{expr.b}, out);
      return;
    case ExprOp::kGroup:
    case ExprOp::kConvert:
      return AppendMessage(module, ExprId{expr.a}, out);
    case ExprOp::kVariable:
      out += module.View(module.variables[ir::VariableId{expr.a}].name);
      return;
    case ExprOp::kLiteral:
      out += NumberText(expr.number);
      return;
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
      AppendMessage(module, ExprId{expr.a}, out);
      out += expr.op == ExprOp::kAdd ? "+" : "-";
      AppendMessage(module, ExprId{expr.b}, out);
      return;
    case ExprOp::kCell:
      out += fmt::format("{}{}", module.View(module.spaces[ir::SpaceId{expr.a}].name), expr.b);
      return;
    default:
      out += "..";
  }
}

}  // namespace ncport::backends::fanuc
