// Expressions: the stack of values.
#include "base/result.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/lower.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Type;

ExprId Lowering::PushExpr(const Expr& expr, std::uint32_t begin, std::uint32_t length) {
  const ExprId id = module_.AddExpr(expr, {begin, length});
  values_.push_back(id);
  return id;
}

ExprId Lowering::Pop() {
  const ExprId id = values_.back();
  values_.pop_back();
  return id;
}

ExprId Lowering::Literal(const Token& token) {
  Expr& expr = module_.EmplaceExpr();
  expr.op = ExprOp::kLiteral;
  expr.type = (token.format.flags & ir::NumberFormat::kPoint) != 0 ? Type::kReal : Type::kInt;
  expr.format = token.format;
  expr.number = token.number;
  if ((token.format.flags & ir::NumberFormat::kAsText) != 0) expr.count = texts_.LiteralText(token.Text());
  return module_.LastExpr();
}

bool Lowering::IsLiteral(ExprId id) const { return id.Valid() && module_.exprs[id].op == ExprOp::kLiteral; }

bool Lowering::LiteralInt(ExprId id, std::uint32_t most, std::uint32_t& value) const {
  if (!IsLiteral(id)) return false;
  const double number = module_.exprs[id].number;
  if (!(number >= 0) || number > most || number != static_cast<double>(static_cast<std::uint32_t>(number)))
    return false;
  value = static_cast<std::uint32_t>(number);
  return true;
}

void Lowering::List(ExprOp op, std::uint32_t a, std::uint16_t count, const Action& action, Type type) {
  Expr expr;
  expr.op = op;
  expr.type = type;
  expr.count = count;
  expr.a = a;
  expr.b = static_cast<std::uint32_t>(module_.expr_items.size());
  for (std::size_t i = values_.size() - count; i < values_.size(); ++i) module_.expr_items.push_back(values_[i]);
  values_.resize(values_.size() - count);
  PushExpr(expr, At(action.first).offset, At(action.last).End() - At(action.first).offset);
}

bool Lowering::AxisOf(const Token& token, std::uint8_t& axis) {
  if (token.sub != kNamedAxis) {
    axis = token.sub;
    return true;
  }
  for (std::size_t i = 0; i < module_.axis_names.size(); ++i) {
    if (module_.axis_names[i] == token.Text()) {
      axis = static_cast<std::uint8_t>(ir::kFirstNamedAxis + i);
      return true;
    }
  }
  if (ir::kFirstNamedAxis + module_.axis_names.size() == ir::kMaxAxes) {
    return Fail(Code::kUnknownAddress, token, "at most seven axes may have names of their own");
  }
  axis = static_cast<std::uint8_t>(ir::kFirstNamedAxis + module_.axis_names.size());
  module_.axis_names.push_back(token.Text());
  return true;
}

// 0: R, 1: RG.
ir::SpaceId Lowering::SpaceOf(std::uint8_t which) {
  if (!spaces_[which].Valid()) {
    const std::string_view name = which == 0 ? "R" : "RG";
    for (const ir::SpaceId id : module_.spaces.Ids()) {
      if (module_.View(module_.spaces[id].name) == name) spaces_[which] = id;
    }
  }
  return spaces_[which];
}

ir::SystemId Lowering::SystemOf(const Token& token) {
  std::string upper(module_.View(token.Text()));
  for (char& c : upper) c = Upper(c);
  const StringId name = module_.strings.Intern("$" + upper);
  const auto it = systems_.find(name.value);
  if (it != systems_.end()) return it->second;
  const dialects::sinumerik::SystemRow* row = dialects::sinumerik::FindSystemVariable(upper);
  if (row == nullptr) return {};
  ir::System system;
  system.name = name;
  system.kind = row->kind;
  system.type = row->type;
  system.writable = row->writable;
  // $P_AXN1 .. 3: which of the three.
  if (row->kind == ir::SystemKind::kPlaneAxis) system.number = static_cast<std::uint32_t>(upper.back() - '0');
  const ir::SystemId id = module_.systems.Add(system);
  systems_[name.value] = id;
  return id;
}

bool Lowering::DoValue(const Action& action) {
  const Token& token = At(action.first);
  Expr expr;
  switch (static_cast<Step>(action.op)) {
    case Step::kNumber:
      values_.push_back(Literal(token));
      module_.expr_places.Add(values_.back(), {token.offset, token.length});
      return true;
    case Step::kText:
      expr.op = ExprOp::kText;
      expr.type = Type::kString;
      expr.a = token.data;
      PushExpr(expr, token.offset, token.length);
      return true;
    case Step::kBoolean:
      expr.type = Type::kBool;
      expr.number = token.number;
      expr.format = {.int_digits = 1};
      PushExpr(expr, token.offset, token.length);
      return true;
    case Step::kAxisName: {
      Token name = token;
      if (token.kind == static_cast<std::uint16_t>(TokenKind::kAxisValue)) {
        // `=X1` at the end of a block: digits behind the letter are part of the name, nothing else is.
        const std::string_view text = TextOf(token);
        std::string axis;
        for (const char c : text) {
          if (IsLetter(c) || (IsDigit(c) && !(axis.size() == 1 && c == '0'))) {
            axis.push_back(Upper(c));
          } else if (c == '-' || c == '+' || c == '.') {
            return Fail(Code::kUnexpectedText, token,
                        "an address holds no value to read: the programmed position of an axis is $P_EP[X]");
          }
        }
        name.sub = kNamedAxis;
        name.data = module_.strings.Intern(axis).value;
      }
      std::uint8_t axis = 0;
      if (!AxisOf(name, axis)) return false;
      expr.op = ExprOp::kAxisName;
      expr.type = Type::kAxis;
      expr.a = axis;
      expr.b = 0;
      PushExpr(expr, token.offset, token.length);
      return true;
    }
    case Step::kCell:
    case Step::kCellAt: {
      const ir::SpaceId space = SpaceOf(token.sub);
      if (!space.Valid()) return Fail(Code::kNotSupported, token);  // RG (card 3.1)
      expr.type = Type::kReal;
      if (static_cast<Step>(action.op) == Step::kCell) {
        expr.op = ExprOp::kCell;
        expr.a = space.value;
        expr.b = static_cast<std::uint32_t>(token.number);
      } else {
        expr.op = ExprOp::kCellAt;
        expr.a = Pop().value;
        expr.b = space.value;
      }
      PushExpr(expr, token.offset, At(action.last).End() - token.offset);
      return true;
    }
    case Step::kName:
      List(ExprOp::kName, token.data, action.count, action);
      return true;
    case Step::kSystem: {
      const ir::SystemId system = SystemOf(token);
      if (!system.Valid()) return Fail(Code::kUnknownName, token);
      List(ExprOp::kSystem, system.value, action.count, action, module_.systems[system].type);
      return true;
    }
    case Step::kGroup:
    case Step::kUnary: {
      expr.op = static_cast<Step>(action.op) == Step::kGroup ? ExprOp::kGroup : static_cast<ExprOp>(action.arg);
      if (static_cast<Step>(action.op) == Step::kUnary && action.arg == kToText) {
        List(ExprOp::kFunction, static_cast<std::uint32_t>(ir::Function::kToText), 1, action, Type::kString);
        return true;
      }
      const ExprId operand = Pop();
      expr.a = operand.value;
      expr.b = Id<void>::kNone;
      PushExpr(expr, token.offset, At(action.last).End() - token.offset);
      return true;
    }
    case Step::kBinary: {
      const ExprId right = Pop();
      const ExprId left = Pop();
      expr.op = static_cast<ExprOp>(action.arg);
      expr.a = left.value;
      expr.b = right.value;
      // Card 4.2: equality is relative and holds for all six operators.
      if (expr.op >= ExprOp::kEqual && expr.op <= ExprOp::kGreaterEqual) expr.flags = Expr::kTolerance;
      PushExpr(expr, token.offset, At(action.last).End() - token.offset);
      return true;
    }
    case Step::kFunction: {
      const auto& row = dialects::sinumerik::Functions()[token.data];
      const ir::Arity arity = ir::ArityOf(row.function);
      if (action.count < arity.least || action.count > arity.most) {
        error_ = {.code = Code::kArgumentCount,
                  .begin = token.offset,
                  .length = token.length,
                  .limit = action.count,
                  .other_begin = arity.least,
                  .other_length = arity.most};
        return false;
      }
      List(ExprOp::kFunction, static_cast<std::uint32_t>(row.function), action.count, action, row.result);
      return true;
    }
    case Step::kMissing:
      values_.emplace_back();
      return true;
    default:
      NCPORT_BUG("step {} is no value", action.op);
  }
}

}  // namespace ncport::frontend::sinumerik
