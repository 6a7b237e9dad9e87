#include "backends/fanuc/print_expr.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/result.h"
#include "dialects/fanuc/words.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Function;

/// How tight an operation binds; higher is tighter. Functions and operands: kOperand.
constexpr int kCondition = 1, kSum = 2, kProduct = 3, kSign = 4, kOperand = 5;

int LevelOf(ExprOp op) {
  switch (op) {
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
      return kCondition;
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
    case ExprOp::kOr:
    case ExprOp::kXor:
      return kSum;
    case ExprOp::kMultiply:
    case ExprOp::kDivide:
    case ExprOp::kModulo:
    case ExprOp::kBitAnd:
    case ExprOp::kAnd:
      return kProduct;
    case ExprOp::kNegate:
      return kSign;
    default:
      return kOperand;
  }
}

bool IsLogic(ExprOp op) {
  return op == ExprOp::kBitAnd || op == ExprOp::kBitOr || op == ExprOp::kBitXor || op == ExprOp::kAnd ||
         op == ExprOp::kOr || op == ExprOp::kXor;
}

/// Below what prints nothing.
ExprId Bare(const ir::Module& module, ExprId id) {
  while (true) {
    const Expr& expr = module.exprs[id];
    const bool silent = expr.op == ExprOp::kGroup || expr.op == ExprOp::kPlus ||
                        (expr.op == ExprOp::kConvert && (expr.flags & Expr::kImplicit) != 0);
    if (!silent) return id;
    id = ExprId{expr.a};
  }
}

bool TwoArguments(const Expr& expr) {
  return expr.op == ExprOp::kFunction && (static_cast<Function>(expr.a) == Function::kAtan2 ||
                                          static_cast<Function>(expr.a) == Function::kAtan2Positive);
}

/// Is the operand of an operation put in brackets? `right`: it stands behind the operator.
bool NeedsBrackets(const ir::Module& module, ExprId operand, ExprOp parent, bool right) {
  const Expr& expr = module.exprs[Bare(module, operand)];
  const int inner = LevelOf(expr.op), outer = LevelOf(parent);
  // Two signs in a row are doubtful (fanuc-4.1); a number below zero prints as a sign and a number does.
  if (expr.op == ExprOp::kLiteral) return expr.number < 0 && (right || outer > kSum);
  if (TwoArguments(expr)) return true;  // ATAN[a]/[b]: a quotient would run on
  if (IsLogic(expr.op) || (IsLogic(parent) && LevelOf(expr.op) < kSign)) return true;
  if (expr.op == ExprOp::kNegate) return right || outer > kSum;
  return right ? inner <= outer : inner < outer;
}

}  // namespace

void ExprPrinter::PrintLiteral(const Expr& expr, NumberPlace place, bool inside) {
  const double value = expr.number;
  const bool whole = value == std::floor(value) && std::fabs(value) < 1e15;
  if (place == NumberPlace::kInteger) {
    NCPORT_CHECK(whole, "a fraction {} at an address that takes whole numbers", value);
    return AppendInteger(out_, static_cast<std::int64_t>(value));
  }
  const bool written = (expr.format.flags & (ir::NumberFormat::kComputed | ir::NumberFormat::kAsText)) == 0 &&
                       (expr.format.int_digits != 0 || expr.format.decimals != 0);
  const bool point = place == NumberPlace::kWord || expr.format.decimals > 0;
  if (written) {
    return AppendNumber(out_, value, std::max<std::uint8_t>(expr.format.int_digits, 1), expr.format.decimals,
                        point || (expr.format.flags & ir::NumberFormat::kPoint) != 0);
  }
  // A computed number: in a word of its own it has the target's decimals, inside an expression all that it has.
  const int decimals = inside || place == NumberPlace::kMacro ? 9 : static_cast<int>(profile_.decimals.Or(3));
  const std::size_t before = out_.size();
  AppendTrimmed(out_, value, decimals);
  if (place == NumberPlace::kWord && out_.View().substr(before).find('.') == std::string_view::npos) out_.Append('.');
}

void ExprPrinter::PrintFunction(const Expr& expr, NumberPlace place) {
  const auto function = static_cast<Function>(expr.a);
  const dialects::fanuc::FunctionRow* row = dialects::fanuc::FindFunction(function);
  NCPORT_CHECK(row != nullptr, "function {} reached the printer", ir::NameOf(function));
  out_.Append(row->text);
  const NumberPlace inside = place == NumberPlace::kInteger ? NumberPlace::kMacro : place;
  const auto argument = [&](std::uint32_t i) {
    out_.Append('[');
    Print(module_.Item(expr.b + i), 0, inside);
    out_.Append(']');
  };
  if (row->form == dialects::fanuc::FunctionForm::kList) {
    // POW[a,b] (fanuc-4.3)
    out_.Append('[');
    for (std::uint32_t i = 0; i < expr.count; ++i) {
      if (i != 0) out_.Append(',');
      Print(module_.Item(expr.b + i), 0, inside);
    }
    return out_.Append(']');
  }
  argument(0);
  if (expr.count == 2 && TwoArguments(expr)) {
    out_.Append('/');
    argument(1);
  }
}

void ExprPrinter::Print(ExprId id, int level, NumberPlace place) {
  id = Bare(module_, id);
  const Expr& expr = module_.exprs[id];
  const auto operand = [&](std::uint32_t child, bool right) {
    const bool brackets = NeedsBrackets(module_, ExprId{child}, expr.op, right);
    if (brackets) out_.Append('[');
    Print(ExprId{child}, brackets ? 0 : LevelOf(expr.op), place);
    if (brackets) out_.Append(']');
  };
  switch (expr.op) {
    case ExprOp::kLiteral:
      return PrintLiteral(expr, place, true);
    case ExprOp::kVacant:
      return out_.Append("#0");
    case ExprOp::kCell:
      out_.Append('#');
      return AppendInteger(out_, expr.b);
    case ExprOp::kCellAt:
      out_.Append("#[");
      Print(ExprId{expr.a}, 0, NumberPlace::kMacro);
      return out_.Append(']');
    case ExprOp::kFunction:
      return PrintFunction(expr, place);
    case ExprOp::kNegate:
      out_.Append('-');
      return operand(expr.a, true);
    case ExprOp::kConvert:
      return Print(ExprId{expr.a}, level, place);
    default:
      break;
  }
  NCPORT_CHECK(ir::OperandsOf(expr.op) == ir::Operands::kBinary, "operation {} reached the printer",
               ir::NameOf(expr.op));
  const dialects::fanuc::OperatorRow* row = dialects::fanuc::FindOperator(expr.op);
  NCPORT_CHECK(row != nullptr, "operation {} reached the printer", ir::NameOf(expr.op));
  const bool word = row->text.front() >= 'A' && row->text.front() <= 'Z';
  operand(expr.a, false);
  if (word) out_.Append(' ');
  out_.Append(row->text);
  if (word) out_.Append(' ');
  operand(expr.b, true);
}

void ExprPrinter::WordValue(ExprId id, NumberPlace place) {
  id = Bare(module_, id);
  const Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kLiteral) return PrintLiteral(expr, place, false);
  if (expr.op == ExprOp::kCell || expr.op == ExprOp::kCellAt || expr.op == ExprOp::kVacant) return Print(id, 0, place);
  if (expr.op == ExprOp::kNegate) {
    const Expr& inner = module_.exprs[Bare(module_, ExprId{expr.a})];
    if (inner.op == ExprOp::kCell || inner.op == ExprOp::kCellAt) {
      out_.Append('-');
      return Print(ExprId{expr.a}, 0, place);
    }
    if (inner.op == ExprOp::kLiteral && inner.number >= 0) {
      out_.Append('-');
      return PrintLiteral(inner, place, false);
    }
  }
  out_.Append('[');
  Print(id, 0, place == NumberPlace::kInteger ? NumberPlace::kMacro : place);
  out_.Append(']');
}

namespace {

int Depth(const ir::Module& module, ExprId id) {
  id = Bare(module, id);
  const Expr& expr = module.exprs[id];
  switch (ir::OperandsOf(expr.op)) {
    case ir::Operands::kLeaf:
      return 0;
    case ir::Operands::kUnary:
      if (expr.op == ExprOp::kCellAt) return 1 + Depth(module, ExprId{expr.a});
      return (expr.op == ExprOp::kNegate && NeedsBrackets(module, ExprId{expr.a}, expr.op, true) ? 1 : 0) +
             Depth(module, ExprId{expr.a});
    case ir::Operands::kBinary: {
      const int left = Depth(module, ExprId{expr.a}) + (NeedsBrackets(module, ExprId{expr.a}, expr.op, false) ? 1 : 0);
      const int right = Depth(module, ExprId{expr.b}) + (NeedsBrackets(module, ExprId{expr.b}, expr.op, true) ? 1 : 0);
      return std::max(left, right);
    }
    case ir::Operands::kList: {
      int deepest = 0;
      for (std::uint32_t i = 0; i < expr.count; ++i)
        deepest = std::max(deepest, Depth(module, module.Item(expr.b + i)));
      return deepest + 1;
    }
  }
  return 0;
}

}  // namespace

int BracketDepth(const ir::Module& module, ExprId expr, bool in_word) {
  const ExprId bare = Bare(module, expr);
  const ExprOp op = module.exprs[bare].op;
  const bool plain = op == ExprOp::kLiteral || op == ExprOp::kCell || op == ExprOp::kCellAt;
  return Depth(module, bare) + (in_word && !plain ? 1 : 0);
}

}  // namespace ncport::backends::fanuc
