// Expressions, with the brackets that were written and those that the order of operators demands.
#include "backends/sinumerik/printer.h"
#include "base/number_text.h"
#include "base/result.h"
#include "dialects/sinumerik/words.h"
#include "ir/axis_names.h"

namespace ncport::backends::sinumerik {

using ir::ExprOp;

std::string_view Printer::OperatorOf(ExprOp op) {
  switch (op) {
    case ExprOp::kPlus:
    case ExprOp::kAdd:
      return "+";
    case ExprOp::kNegate:
    case ExprOp::kSubtract:
      return "-";
    case ExprOp::kNot:
      return "NOT ";
    case ExprOp::kBitNot:
      return "B_NOT ";
    case ExprOp::kMultiply:
      return "*";
    case ExprOp::kDivide:
      return "/";
    case ExprOp::kDivideInteger:
      return " DIV ";
    case ExprOp::kModulo:
      return " MOD ";
    case ExprOp::kBitAnd:
      return " B_AND ";
    case ExprOp::kBitXor:
      return " B_XOR ";
    case ExprOp::kBitOr:
      return " B_OR ";
    case ExprOp::kAnd:
      return " AND ";
    case ExprOp::kXor:
      return " XOR ";
    case ExprOp::kOr:
      return " OR ";
    case ExprOp::kConcat:
      return "<<";
    case ExprOp::kEqual:
      return "==";
    case ExprOp::kNotEqual:
      return "<>";
    case ExprOp::kLess:
      return "<";
    case ExprOp::kLessEqual:
      return "<=";
    case ExprOp::kGreater:
      return ">";
    case ExprOp::kGreaterEqual:
      return ">=";
    default:
      NCPORT_BUG("{} is no operator of SINUMERIK", ir::NameOf(op));
  }
}

int Printer::StrengthOf(const ir::Expr& expr) {
  switch (expr.op) {
    case ExprOp::kPlus:
    case ExprOp::kNegate:
    case ExprOp::kNot:
    case ExprOp::kBitNot:
      return kUnary;
    case ExprOp::kMultiply:
    case ExprOp::kDivide:
    case ExprOp::kDivideInteger:
    case ExprOp::kModulo:
      return 2;
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
      return kSum;
    case ExprOp::kBitAnd:
      return 4;
    case ExprOp::kBitXor:
      return 5;
    case ExprOp::kBitOr:
      return 6;
    case ExprOp::kAnd:
      return 7;
    case ExprOp::kXor:
      return 8;
    case ExprOp::kOr:
      return 9;
    case ExprOp::kConcat:
      return kConcat;
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
      return 12;
    case ExprOp::kFunction:
      return static_cast<ir::Function>(expr.a) == ir::Function::kToText ? kToText : kPrimary;
    // A negative number reads back as the minus of a number.
    case ExprOp::kLiteral:
      return expr.number < 0 ? kUnary : kPrimary;
    default:
      return kPrimary;
  }
}

/// A sign or a number, which may have one: behind another operator it needs brackets or a check.
bool Printer::IsSigned(ir::ExprId id) const {
  const ir::Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kConvert) return IsSigned(ir::ExprId{expr.a});
  return expr.op == ExprOp::kNegate || expr.op == ExprOp::kPlus || expr.op == ExprOp::kLiteral;
}

void Printer::Expr(ir::ExprId id, int in) {
  const ir::Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kConvert || (expr.flags & ir::Expr::kImplicit) != 0) {
    Expr(ir::ExprId{expr.a}, in);
    return;
  }
  const bool brackets = StrengthOf(expr) > in;
  if (brackets) out_.Append('(');
  Operand(expr);
  if (brackets) out_.Append(')');
}

void Printer::Operand(const ir::Expr& expr) {
  switch (expr.op) {
    case ExprOp::kLiteral:
      return Literal(expr);
    case ExprOp::kText:
      return Text(module_.View(StringId{expr.a}));
    case ExprOp::kAxisName:
      return AxisName(static_cast<std::uint8_t>(expr.a));
    case ExprOp::kVariable:
      out_.Append(module_.View(module_.variables[ir::VariableId{expr.a}].name));
      return;
    case ExprOp::kElement:
      out_.Append(module_.View(module_.variables[ir::VariableId{expr.a}].name));
      out_.Append('[');
      List(expr.b, expr.count);
      out_.Append(']');
      return;
    case ExprOp::kName:
    case ExprOp::kSystem:
      out_.Append(expr.op == ExprOp::kName ? module_.View(StringId{expr.a})
                                           : module_.View(module_.systems[ir::SystemId{expr.a}].name));
      if (expr.count == 0) return;
      out_.Append('[');
      List(expr.b, expr.count);
      out_.Append(']');
      return;
    case ExprOp::kCell:
      out_.Append(module_.View(module_.spaces[ir::SpaceId{expr.a}].name));
      AppendInteger(out_, expr.b);
      return;
    case ExprOp::kCellAt:
      out_.Append(module_.View(module_.spaces[ir::SpaceId{expr.b}].name));
      out_.Append('[');
      Expr(ir::ExprId{expr.a});
      out_.Append(']');
      return;
    case ExprOp::kGroup:
      out_.Append('(');
      Expr(ir::ExprId{expr.a});
      out_.Append(')');
      return;
    case ExprOp::kFunction: {
      const auto function = static_cast<ir::Function>(expr.a);
      if (function == ir::Function::kToText) {
        out_.Append("<<");
        Expr(module_.Item(expr.b), kToText);
        return;
      }
      const auto* row = dialects::sinumerik::FindFunction(function);
      NCPORT_CHECK(row != nullptr, "SINUMERIK has no function {}", ir::NameOf(function));
      out_.Append(row->text);
      out_.Append('(');
      List(expr.b, expr.count);
      out_.Append(')');
      return;
    }
    default:
      break;
  }
  const int strength = StrengthOf(expr);
  if (ir::OperandsOf(expr.op) == ir::Operands::kUnary) {
    out_.Append(OperatorOf(expr.op));
    // A sign of its own would stand as a doubled sign.
    Expr(ir::ExprId{expr.a}, IsSigned(ir::ExprId{expr.a}) ? kPrimary : strength);
    return;
  }
  NCPORT_CHECK(ir::OperandsOf(expr.op) == ir::Operands::kBinary, "SINUMERIK has no expression {}", ir::NameOf(expr.op));
  // Operators of one strength bind from the left: the right side binds tighter or has brackets.
  Expr(ir::ExprId{expr.a}, strength);
  out_.Append(OperatorOf(expr.op));
  const bool arithmetic = strength <= kSum;
  const bool literal = module_.exprs[ir::ExprId{expr.b}].op == ExprOp::kLiteral;
  Expr(ir::ExprId{expr.b}, literal || (arithmetic && IsSigned(ir::ExprId{expr.b})) ? kPrimary : strength - 1);
}

void Printer::Literal(const ir::Expr& expr) {
  if (expr.type == ir::Type::kBool) {
    out_.Append(expr.number != 0 ? "TRUE" : "FALSE");
    return;
  }
  const ir::NumberFormat& format = expr.format;
  if ((format.flags & ir::NumberFormat::kAsText) != 0) {
    out_.Append(module_.View(module_.literal_texts[expr.count]));
    return;
  }
  if ((format.flags & ir::NumberFormat::kComputed) != 0) {
    const std::size_t begin = out_.size();
    AppendTrimmed(out_, expr.number, static_cast<int>(profile_.decimals.Or(6)));
    // Without a point it would read back as INT.
    const bool point = out_.View().substr(begin).find('.') != std::string_view::npos;
    if (expr.type != ir::Type::kInt && expr.type != ir::Type::kChar && !point) out_.Append('.');
    return;
  }
  if ((format.flags & ir::NumberFormat::kPlusSign) != 0) out_.Append('+');
  AppendNumber(out_, expr.number, format.int_digits, format.decimals, (format.flags & ir::NumberFormat::kPoint) != 0);
}

void Printer::Text(std::string_view text) {
  out_.Append('"');
  for (const char c : text) {
    // Card 2.5: a quote inside stands between single quotes.
    if (c == '"') {
      out_.Append("'\"'");
    } else {
      out_.Append(c);
    }
  }
  out_.Append('"');
}

void Printer::List(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i != 0) out_.Append(',');
    const ir::ExprId item = module_.Item(first + i);
    if (item.Valid()) Expr(item);
  }
}

void Printer::AxisName(std::uint8_t axis) { out_.Append(ir::AxisName(module_, axis)); }

}  // namespace ncport::backends::sinumerik
