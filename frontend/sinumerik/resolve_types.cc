// Names of expressions and their types (card 3.4, 4.1, 4.2).
#include <string>

#include "base/result.h"
#include "dialects/finding_alarms.h"
#include "dialects/sinumerik/words.h"
#include "frontend/sinumerik/resolver.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::ExprId;
using ir::ExprOp;
using ir::Type;

namespace {

bool IsNumeric(Type type) {
  return type == Type::kInt || type == Type::kReal || type == Type::kBool || type == Type::kChar ||
         type == Type::kNumber || type == Type::kAny;
}
bool IsWhole(Type type) { return type == Type::kInt || type == Type::kBool || type == Type::kChar; }

/// Type of `+ - * MOD`: REAL as soon as one side is.
Type Sum(Type a, Type b) {
  if (IsWhole(a) && IsWhole(b)) return Type::kInt;
  if (a == Type::kAny || b == Type::kAny) return Type::kAny;
  return Type::kReal;
}

std::string_view Article(Type type) {
  switch (type) {
    case Type::kString:
      return "a text";
    case Type::kAxis:
      return "an axis";
    case Type::kFrame:
      return "a frame";
    case Type::kBool:
      return "a truth value";
    case Type::kChar:
      return "a character";
    case Type::kInt:
      return "a whole number";
    default:
      return "a number";
  }
}

}  // namespace

namespace {

constexpr const char* kAddressHelp =
    "an address holds no value to read: the programmed position of an axis is $P_EP[X], the real one $AA_IM[X] and "
    "$AA_IW[X]";

}  // namespace

bool Resolver::Mismatch(ExprId id, std::string_view what, std::string_view needed, std::string_view help) {
  diag::Diagnostic& finding =
      sink_.Report(Code::kTypeMismatch, module_.RangeOf(module_.blocks[block_], id), what, needed);
  finding.help = help;
  if (help.empty() && module_.exprs[id].op == ExprOp::kAxisName) finding.help = kAddressHelp;
  TellParameter(finding);
  return false;
}

bool Resolver::Name(ExprId id) {
  const ir::Expr name = module_.exprs[id];
  const std::string_view text = module_.View(StringId{std::size_t{name.a}});
  const auto become = [&](ExprOp op, Type type, std::uint32_t a) {
    ir::Expr& expr = module_.exprs[id];
    expr.op = op;
    expr.type = type;
    expr.a = a;
  };
  const ir::VariableId found = FindVariable(text);
  std::uint8_t axis = 0;
  if (!found.Valid()) {
    if (name.count == 0 && FindAxis(text, axis)) {
      become(ExprOp::kAxisName, Type::kAxis, axis);
      return true;
    }
    UnknownName(id, text);
    // No name may be left: the block is refused, what stands here is never looked at.
    module_.exprs[id] = ir::Expr();
    return false;
  }
  const ir::Variable& variable = module_.variables[found];
  if (defined_.Valid() && variable.owner == program_ && found.value >= defined_.value) {
    diag::Diagnostic& finding = sink_.Report(Code::kUnknownName, module_.RangeOf(module_.blocks[block_], id), text);
    finding.notes.push_back(
        {{variable.file, variable.line, variable.begin, variable.begin + variable.length}, "it is declared only here"});
    finding.help = "a start value can use names that were declared before it";
    finding.control = dialects::AlarmFor(profile_, finding.code);
    module_.exprs[id] = ir::Expr();
    return false;
  }
  if (name.count == 0) {
    become(ExprOp::kVariable, variable.type, found.value);
    return true;
  }
  const bool character = variable.type == Type::kString && name.count == variable.dimension_count + 1U;
  become(ExprOp::kElement, character ? Type::kChar : variable.type, found.value);
  if (name.count != variable.dimension_count && !character) {
    return Mismatch(id, variable.dimension_count == 0 ? "an index" : "this number of indices",
                    variable.dimension_count == 0 ? "one value" : "one for each dimension");
  }
  for (std::uint32_t i = 0; i < name.count; ++i) {
    if (!Number(module_.Item(name.b + i))) return false;
  }
  return true;
}

bool Resolver::Expr(ExprId id) {
  const ir::Expr expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
    case ExprOp::kText:
    case ExprOp::kVacant:
    case ExprOp::kAxisName:
    case ExprOp::kVariable:
    case ExprOp::kCell:
    case ExprOp::kConvert:
      return true;
    case ExprOp::kName:
      return Name(id);
    case ExprOp::kElement:
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        if (!Number(module_.Item(expr.b + i))) return false;
      }
      return true;
    case ExprOp::kCellAt:
      return Number(ExprId{std::size_t{expr.a}});
    case ExprOp::kSystem: {
      const ir::System& system = module_.systems[ir::SystemId{std::size_t{expr.a}}];
      module_.exprs[id].type = system.type;
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        if (!Scalar(module_.Item(expr.b + i))) return false;
      }
      if (!module_.programs[program_].library) SystemVariable(id);
      return true;
    }
    case ExprOp::kGroup: {
      const ExprId inner{std::size_t{expr.a}};
      if (!Scalar(inner)) return false;
      module_.exprs[id].type = module_.exprs[inner].type;
      return true;
    }
    default:
      return Operation(id);
  }
}

// Card 4.3, 4.6: the first argument of functions of texts is a text, all others of calculating functions are numbers.
bool Resolver::FunctionArgument(const ir::Expr& call, std::uint32_t place, ExprId argument) {
  using F = ir::Function;
  const Type type = module_.exprs[argument].type;
  switch (static_cast<F>(call.a)) {
    case F::kStringLength:
    case F::kIndexOf:
    case F::kLastIndexOf:
    case F::kIndexOfAny:
    case F::kFind:
    case F::kSubstring:
    case F::kToUpper:
    case F::kToLower:
    case F::kParseNumber:
    case F::kIsNumber:
    case F::kAxisFromText:
    case F::kFormat: {
      const bool text = type == Type::kString || type == Type::kChar || type == Type::kBool || type == Type::kAny;
      return place != 0 || text || Mismatch(argument, Article(type), "a text");
    }
    case F::kSin:
    case F::kCos:
    case F::kTan:
    case F::kAsin:
    case F::kAcos:
    case F::kAtan2:
    case F::kSqrt:
    case F::kAbs:
    case F::kSquare:
    case F::kTruncate:
    case F::kRound:
    case F::kRoundUp:
    case F::kLn:
    case F::kExp:
    case F::kMinimum:
    case F::kMaximum:
    case F::kBound:
      return IsNumeric(type) || Mismatch(argument, Article(type), "a number");
    default:
      return true;
  }
}

bool Resolver::Operation(ExprId id) {
  const ir::Expr expr = module_.exprs[id];
  const auto set = [&](Type type) {
    module_.exprs[id].type = type;
    return true;
  };
  if (expr.op == ExprOp::kFunction) {
    Type of_arguments = Type::kInt;
    for (std::uint32_t i = 0; i < expr.count; ++i) {
      const ExprId argument = module_.Item(expr.b + i);
      if (!Scalar(argument) || !FunctionArgument(expr, i, argument)) return false;
      of_arguments = Sum(of_arguments, module_.exprs[argument].type);
    }
    return expr.type != Type::kAny || set(of_arguments);
  }
  const ExprId a{std::size_t{expr.a}};
  if (!Scalar(a)) return false;
  const Type left = module_.exprs[a].type;
  if (ir::OperandsOf(expr.op) == ir::Operands::kUnary) {
    if (!IsNumeric(left) && !(expr.op == ExprOp::kNot && left == Type::kString))
      return Mismatch(a, Article(left), "a number");
    if (expr.op == ExprOp::kNot) return set(Type::kBool);
    if (expr.op == ExprOp::kBitNot) {
      return left == Type::kReal ? Mismatch(a, "a REAL value", "an INT or CHAR value") : set(Type::kInt);
    }
    return set(IsWhole(left) ? Type::kInt : left);
  }
  const ExprId b{std::size_t{expr.b}};
  if (!Scalar(b)) return false;
  const Type right = module_.exprs[b].type;
  switch (expr.op) {
    case ExprOp::kConcat:
      if (left == Type::kFrame) return Mismatch(a, Article(left), "a text");
      if (right == Type::kFrame) return Mismatch(b, Article(right), "a text");
      return set(Type::kString);
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual: {
      // A text of one character is also a CHAR constant (card 3.3).
      const bool texts = (left == Type::kString && (right == Type::kString || right == Type::kChar)) ||
                         (left == Type::kChar && right == Type::kString);
      const bool any = left == Type::kAny || right == Type::kAny;
      if (!texts && !any && left != right && !(IsNumeric(left) && IsNumeric(right))) {
        const bool less = left == Type::kString && (expr.op == ExprOp::kLess || expr.op == ExprOp::kLessEqual);
        return Mismatch(b, Article(right), Article(left), less ? "a text goes on with <<" : "");
      }
      return set(Type::kBool);
    }
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor:
      if (left == Type::kAxis || left == Type::kFrame) return Mismatch(a, Article(left), "a truth value");
      if (right == Type::kAxis || right == Type::kFrame) return Mismatch(b, Article(right), "a truth value");
      return set(Type::kBool);
    default:
      break;
  }
  // Card 4.2, 4.6, 8.7: each kind of value has its own sign.
  const auto joined_by = [&](Type type) -> std::string_view {
    if (type == Type::kString) return "texts are joined with <<";
    return type == Type::kFrame ? "frames are chained with :" : "";
  };
  if (!IsNumeric(left)) return Mismatch(a, Article(left), "a number", joined_by(left));
  if (!IsNumeric(right)) return Mismatch(b, Article(right), "a number", joined_by(right));
  switch (expr.op) {
    case ExprOp::kDivide:
      return set(Type::kReal);
    case ExprOp::kDivideInteger:
      return set(Type::kInt);
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
      // Card 4.2: CHAR and INT only.
      if (left == Type::kReal) return Mismatch(a, "a REAL value", "an INT or CHAR value");
      if (right == Type::kReal) return Mismatch(b, "a REAL value", "an INT or CHAR value");
      return set(Type::kInt);
    default:
      return set(Sum(left, right));
  }
}

bool Resolver::Scalar(ExprId id) {
  if (!Expr(id)) return false;
  const ir::Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kVariable && module_.variables[ir::VariableId{std::size_t{expr.a}}].dimension_count != 0) {
    return Mismatch(id, "a whole array", "one of its elements");
  }
  return true;
}

bool Resolver::ScalarOrText(ExprId id) {
  text_likely_ = module_.exprs[id].op == ExprOp::kName && module_.exprs[id].count == 0;
  const bool ok = Scalar(id);
  text_likely_ = false;
  return ok;
}

bool Resolver::Place(ExprId id) {
  if (!Scalar(id)) return false;
  const ir::Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kSystem) {
    const ir::System& system = module_.systems[ir::SystemId{std::size_t{expr.a}}];
    if (!system.writable) {
      // Card 9: machine data can be set, but not by a program that another machine takes.
      const bool data = dialects::sinumerik::IsMachineData(module_.View(system.name));
      return Fail(data ? Code::kNotSupported : Code::kReadOnly, id, module_.View(system.name));
    }
  }
  if (expr.op == ExprOp::kAxisName) return Fail(Code::kReadOnly, id, "an axis in brackets");
  return true;
}

bool Resolver::Condition(ExprId id) {
  if (!Scalar(id)) return false;
  const Type type = module_.exprs[id].type;
  return (type != Type::kAxis && type != Type::kFrame) || Mismatch(id, Article(type), "a condition");
}

bool Resolver::Number(ExprId id) {
  if (!Scalar(id)) return false;
  const Type type = module_.exprs[id].type;
  return IsNumeric(type) || Mismatch(id, Article(type), "a number");
}

bool Resolver::Converted(ExprId& id, Type type) { return Scalar(id) && Fits(id, type); }

// The table of card 3.4.
bool Resolver::Fits(ExprId& id, Type type) {
  const ir::Expr& expr = module_.exprs[id];
  const Type from = expr.type;
  if (from == type || from == Type::kAny || type == Type::kAny || from == Type::kNone || type == Type::kNone)
    return true;
  const bool numeric = IsNumeric(from);
  bool possible = false;
  switch (type) {
    case Type::kInt:
    case Type::kReal:
    case Type::kNumber:
      possible = numeric;
      break;
    case Type::kBool:
    case Type::kChar:
      possible = numeric || from == Type::kString;
      break;
    case Type::kString:
      possible = from == Type::kBool || from == Type::kChar;
      break;
    default:
      break;
  }
  if (!possible) {
    diag::Diagnostic& finding =
        sink_.Report(Code::kTypeMismatch, module_.RangeOf(module_.blocks[block_], id), Article(from), Article(type));
    if (type == Type::kString && numeric && !parameter_.Valid()) finding.help = "write << in front of it";
    if (from == Type::kAxis && module_.exprs[id].op == ExprOp::kAxisName) finding.help = kAddressHelp;
    TellParameter(finding);
    return false;
  }
  // A whole number is a REAL as it is, and a literal that is whole fits INT as it is.
  if (type == Type::kReal || type == Type::kNumber) return true;
  if (type == Type::kInt && IsWhole(from)) return true;
  ir::Expr convert;
  convert.op = ExprOp::kConvert;
  convert.type = type;
  convert.flags = ir::Expr::kImplicit;
  convert.a = id.value;
  convert.b = Id<void>::kNone;
  id = module_.AddExpr(convert, module_.expr_places.Of(id));
  return true;
}

}  // namespace ncport::frontend::sinumerik
