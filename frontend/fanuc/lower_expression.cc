// Expressions: the stack of values (fanuc-3, fanuc-4).
#include <cmath>

#include "base/result.h"
#include "frontend/fanuc/lower.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using diag::Code;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Type;

namespace {

constexpr std::uint8_t kArithmetic = Expr::kVacantAsZero | Expr::kNumericModel;

}  // namespace

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

// Every number is REAL: 7 and 7. are one value inside macros (fanuc-2.2).
ExprId Lowering::Literal(const Token& token) {
  Expr& expr = module_.EmplaceExpr();
  module_.expr_places.Add(module_.LastExpr(), {token.offset, token.length});
  expr.type = Type::kReal;
  expr.format = token.format;
  expr.number = token.number;
  if ((token.format.flags & ir::NumberFormat::kAsText) != 0) expr.count = texts_.LiteralText(token.Text());
  return module_.LastExpr();
}

/// A number that stands nowhere in the text.
ExprId Lowering::Implied(double number) {
  Expr expr;
  expr.type = Type::kReal;
  expr.flags = Expr::kImplicit;
  expr.format.flags = ir::NumberFormat::kComputed;
  expr.number = number;
  return module_.AddExpr(expr);
}

ExprId Lowering::Text(std::string_view text) {
  Expr expr;
  expr.op = ExprOp::kText;
  expr.type = Type::kString;
  expr.a = module_.strings.Intern(text).value;
  expr.b = 0;
  return module_.AddExpr(expr);
}

ExprId Lowering::List(ExprOp op, std::uint32_t a, std::span<const ExprId> items, Type type, std::uint8_t flags) {
  Expr expr;
  expr.op = op;
  expr.type = type;
  expr.flags = flags;
  expr.count = static_cast<std::uint16_t>(items.size());
  expr.a = a;
  expr.b = static_cast<std::uint32_t>(module_.expr_items.size());
  for (const ExprId item : items) module_.expr_items.push_back(item);
  return module_.AddExpr(expr);
}

ir::SpaceId Lowering::SpaceOf(std::uint32_t number) const {
  for (const ir::SpaceId id : module_.spaces.Ids()) {
    const ir::Space& space = module_.spaces[id];
    if (number >= space.first && number <= space.last && module_.View(space.name) == "#") return id;
  }
  return {};
}

ir::SystemId Lowering::SystemOf(std::uint32_t number, const words::SystemRange& range) {
  const auto known = systems_.find(number);
  if (known != systems_.end()) return known->second;
  ir::System system;
  system.name = module_.strings.Intern("#" + std::to_string(number));
  system.kind = range.kind;
  system.type = range.type;
  system.writable = range.writable;
  system.number = number;
  const ir::SystemId id = module_.systems.Add(system);
  systems_.emplace(number, id);
  return id;
}

// What a system variable is about hangs on its number: the index of its range is made explicit.
bool Lowering::PushSystem(const Token& token, const words::SystemRange& range) {
  const auto number = static_cast<std::uint32_t>(token.number);
  const ir::SystemId system = SystemOf(number, range);
  ExprId index;
  if (range.kind == ir::SystemKind::kProgrammedPosition || range.kind == ir::SystemKind::kMachinePosition) {
    const std::uint32_t axis = number - range.base;
    if (axis == 0 || axis > axis_order_.size())
      return Fail(Code::kOutOfRange, token, nullptr, "the axes of this machine");
    Expr name;
    name.op = ExprOp::kAxisName;
    name.type = Type::kAxis;
    name.flags = Expr::kImplicit;
    name.a = axis_order_[axis - 1];
    name.b = 0;
    index = module_.AddExpr(name);
  } else if (range.kind == ir::SystemKind::kModalGroup) {
    index = Implied(number - range.base);
  }
  const ExprId items[] = {index};
  const ExprId id = List(ExprOp::kSystem, system.value, {items, index.Valid() ? 1U : 0U}, range.type, 0);
  module_.expr_places.Set(id, {token.offset, token.length});
  values_.push_back(id);
  return true;
}

bool Lowering::PushCell(const Token& token, bool written) {
  Expr expr;
  const double number = std::round(token.number);  // #30003.036: as a computed number is rounded (fanuc-3.1)
  if (number == 0 || number == 3100) {
    if (written) return Fail(Code::kReadOnly, token);
    expr.op = ExprOp::kVacant;
    expr.type = Type::kNumber;
    expr.a = 0;
    expr.b = 0;
    PushExpr(expr, token.offset, token.length);
    return true;
  }
  if (!(number < 4e9)) return Fail(Code::kOutOfRange, token, nullptr, "the variables of this control");
  const auto cell = static_cast<std::uint32_t>(number);
  const ir::SpaceId space = SpaceOf(cell);
  if (space.Valid()) {
    expr.op = ExprOp::kCell;
    expr.type = Type::kNumber;
    expr.a = space.value;
    expr.b = cell;
    PushExpr(expr, token.offset, token.length);
    return true;
  }
  const words::SystemRange* range = words::FindSystemVariable(profile_, cell);
  if (range == nullptr) return Fail(Code::kOutOfRange, token, nullptr, "the variables of this control");
  if (written && !range->writable) return Fail(Code::kReadOnly, token);
  if (!written && !range->readable) return Fail(Code::kOutOfRange, token, nullptr, "the variables that can be read");
  return PushSystem(token, *range);
}

bool Lowering::IsCondition(ExprId id) const { return id.Valid() && module_.exprs[id].type == Type::kBool; }

bool Lowering::NeedNumber(ExprId id) {
  if (!IsCondition(id) || profile_.fanuc.truth_values.Or(false)) return true;
  const ir::ExprPlace place = module_.expr_places.Of(id);
  error_ = {.code = Code::kTypeMismatch,
            .begin = place.begin,
            .length = place.length,
            .help = nullptr,
            .detail = "a condition"};
  error_.help = "conditions stand in IF and WHILE only: set the variable with IF[..]THEN";
  return false;
}

bool Lowering::NeedCondition(ExprId id, const Action& action) {
  if (IsCondition(id) || profile_.fanuc.truth_values.Or(false)) return true;
  const Token& from = At(action.first);
  error_ = {.code = Code::kExpectedText,
            .begin = from.offset,
            .length = At(action.last).End() - from.offset,
            .help = nullptr,
            .detail = "a comparison"};
  return false;
}

bool Lowering::Unary(const Action& action) {
  const ExprId operand = Pop();
  if (!NeedNumber(operand)) return false;
  Expr expr;
  expr.op = static_cast<ExprOp>(action.arg);
  expr.type = Type::kNumber;
  // `Y-#1`: a word with a sign vanishes like one without (fanuc-3.2). Elsewhere the sign is an operation.
  const bool of_word =
      word_ != nullptr && index_depth_ == 0 && action.first == static_cast<std::uint16_t>(word_ - tokens_.data()) + 1;
  expr.flags = of_word ? 0 : kArithmetic;
  expr.a = operand.value;
  expr.b = Id<void>::kNone;
  PushExpr(expr, At(action.first).offset, At(action.last).End() - At(action.first).offset);
  return true;
}

bool Lowering::Binary(const Action& action) {
  const ExprId right = Pop();
  const ExprId left = Pop();
  Expr expr;
  expr.op = static_cast<ExprOp>(action.arg);
  expr.type = Type::kReal;
  expr.flags = kArithmetic;
  expr.a = left.value;
  expr.b = right.value;
  const bool conditions = IsCondition(left) && IsCondition(right);
  switch (expr.op) {
    case ExprOp::kAnd:
    case ExprOp::kOr:
      if (!NeedCondition(left, action) || !NeedCondition(right, action)) return false;
      expr.type = Type::kBool;
      expr.flags = 0;
      break;
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
      // Between conditions they join (fanuc-4.1, level 5).
      if (conditions) {
        expr.op = expr.op == ExprOp::kBitAnd ? ExprOp::kAnd : expr.op == ExprOp::kBitOr ? ExprOp::kOr : ExprOp::kXor;
        expr.type = Type::kBool;
        expr.flags = 0;
        break;
      }
      expr.flags = Expr::kVacantAsZero | Expr::kOperandsToInt;
      if (!NeedNumber(left) || !NeedNumber(right)) return false;
      break;
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
      expr.type = Type::kBool;
      expr.flags = Expr::kVacantDiffers;
      if (!NeedNumber(left) || !NeedNumber(right)) return false;
      break;
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
      expr.type = Type::kBool;
      expr.flags = Expr::kVacantAsZero;
      if (!NeedNumber(left) || !NeedNumber(right)) return false;
      break;
    default:
      if (expr.op == ExprOp::kModulo) expr.flags |= Expr::kOperandsToInt;
      if (!NeedNumber(left) || !NeedNumber(right)) return false;
      break;
  }
  PushExpr(expr, At(action.first).offset, At(action.last).End() - At(action.first).offset);
  return true;
}

bool Lowering::CallFunction(const Action& action) {
  const Token& token = At(action.first);
  const words::FunctionRow& row = words::Functions()[token.data];
  const auto& missing = profile_.fanuc.missing_functions;
  if (missing.Known()) {
    for (const std::string& name : *missing) {
      if (name == row.text) return Fail(Code::kNotSupported, token, "this control does not have the function");
    }
  }
  ir::Function function = row.function;
  const bool quotient = action.arg == 1;
  const auto kind = static_cast<TokenKind>(token.kind);
  if (kind == TokenKind::kAtan) {
    const bool two = action.count == 2;
    if (!two && action.last + 1U < tokens_.size() &&
        static_cast<TokenKind>(At(action.last + 1U).kind) == TokenKind::kSlash) {
      return Fail(Code::kExpectedText, At(action.last + 2U < tokens_.size() ? action.last + 2U : action.last + 1U),
                  "ATAN[a]/[b] has two arguments; a quotient is written [ATAN[a]]/b", "[");
    }
    if (two) function = ir::Function::kAtan2Positive;
  } else if (kind == TokenKind::kParameter) {
    return Fail(Code::kNotSupported, token, "parameters of the machine are not known here");
  } else if (function == ir::Function::kAddDecimalPoint) {
    return Fail(Code::kNotSupported, token, "write arguments with a decimal point instead");
  } else {
    const std::uint16_t wanted = ir::ArityOf(function).most;
    if (quotient || action.count != wanted) {
      error_ = {.code = Code::kArgumentCount,
                .begin = token.offset,
                .length = token.length,
                .limit = action.count,
                .other_begin = wanted,
                .other_length = wanted};
      return false;
    }
  }
  if (row.angle_range || function == ir::Function::kAtan2Positive) {
    // 6004#0 NAT (fanuc-4.3).
    const auto& range = profile_.fanuc.atan_range;
    if (!range.Known())
      return Fail(Code::kNotSupported, token, "the profile leaves fanuc.atan-range open: positive or signed");
    const bool positive = *range == dialects::FanucSettings::AtanRange::kPositive;
    if (function == ir::Function::kAtan2Positive && !positive) function = ir::Function::kAtan2;
    if (function == ir::Function::kAsin && positive) function = ir::Function::kAsinPositive;
  }
  // ROUND in the value of a word whose number has decimals (fanuc-4.4); arguments of G65 are no words.
  if (function == ir::Function::kRound && word_ != nullptr && index_depth_ == 0 && !macro_block_) {
    const words::AddressRow* address = words::FindAddress(system_, static_cast<char>(word_->sub));
    const bool whole = address != nullptr &&
                       (address->form == words::NumberForm::kInteger || address->form == words::NumberForm::kCode);
    if (!whole) function = ir::Function::kRoundToIncrement;
  }
  const std::size_t first = values_.size() - action.count;
  for (std::size_t i = first; i < values_.size(); ++i) {
    if (!NeedNumber(values_[i])) return false;
  }
  const std::vector<ExprId> arguments(values_.begin() + static_cast<std::ptrdiff_t>(first), values_.end());
  values_.resize(first);
  const ExprId id = List(ExprOp::kFunction, static_cast<std::uint32_t>(function), arguments, Type::kReal, kArithmetic);
  module_.expr_places.Set(id, {token.offset, At(action.last).End() - token.offset});
  values_.push_back(id);
  return true;
}

bool Lowering::DoValue(const Action& action) {
  const Token& token = At(action.first);
  Expr expr;
  switch (static_cast<Step>(action.op)) {
    case Step::kNumber:
      values_.push_back(Literal(token));
      return true;
    case Step::kCell:
      return PushCell(token, action.arg == 1);
    case Step::kIndex:
      ++index_depth_;
      return true;
    case Step::kCellAt: {
      --index_depth_;
      const ExprId index = Pop();
      if (!NeedNumber(index)) return false;
      // The space is found by the number at run time; the record names the one that programs reach most.
      ir::SpaceId space = SpaceOf(100);
      if (!space.Valid()) space = SpaceOf(1);
      if (!space.Valid()) return Fail(Code::kOutOfRange, token, nullptr, "the variables of this control");
      expr.op = ExprOp::kCellAt;
      expr.type = Type::kNumber;
      expr.a = index.value;
      expr.b = space.value;
      PushExpr(expr, token.offset, At(action.last).End() - token.offset);
      return true;
    }
    case Step::kGroup: {
      const ExprId operand = Pop();
      expr.op = ExprOp::kGroup;
      expr.type = module_.exprs[operand].type;
      expr.a = operand.value;
      expr.b = Id<void>::kNone;
      PushExpr(expr, token.offset, At(action.last).End() - token.offset);
      return true;
    }
    case Step::kUnary:
      return Unary(action);
    case Step::kBinary:
      return Binary(action);
    case Step::kFunction:
      return CallFunction(action);
    default:
      NCPORT_BUG("step {} is no value", action.op);
  }
}

}  // namespace ncport::frontend::fanuc
