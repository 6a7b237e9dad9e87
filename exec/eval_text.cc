// Texts: concatenation, string functions, SPRINT, and the functions of axes and names.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "exec/evaluator.h"
#include "ir/axis_names.h"
#include "ir/ops/text.h"

namespace ncport::exec {

using ir::Expr;
using ir::ExprId;
using ir::Function;
using ir::Type;
namespace ops = ir::ops;

Value Evaluator::NewText(std::string_view text) {
  const Value value = texts_.Add(text);
  if (texts_.Full()) session_.Limit("--max-text-bytes", diag::Code::kTextLimit, session_.options.max_text_bytes);
  return value;
}

std::string_view Evaluator::AxisName(std::uint8_t axis) const { return ir::AxisName(module_, axis); }

void Evaluator::AppendText(TextBuffer& buffer, const Value& value) {
  switch (value.type) {
    case Type::kString:
      buffer.Append(texts_.View(value));
      break;
    case Type::kChar:
      ops::AppendCharacter(buffer, value.number);
      break;
    case Type::kAxis:
      buffer.Append(AxisName(static_cast<std::uint8_t>(value.number)));
      break;
    case Type::kNone:
      break;
    default:
      ops::AppendNumberText(buffer, value.number);
      break;
  }
}

Value Evaluator::EvalConcat(const Expr& expr) {
  const Value left = Eval(ExprId{std::size_t{expr.a}});
  const Value right = Eval(ExprId{std::size_t{expr.b}});
  TextBuffer text;
  AppendText(text, left);
  AppendText(text, right);
  if (text.size() > machine_.string_max && ops::Length(text.View()) > machine_.string_max) {
    session_.Alarm(ir::AlarmClass::kRange, "text too long");
    return Value::Text(0);
  }
  return NewText(text.View());
}

Value Evaluator::EvalTextFunction(const Expr& expr) {
  const auto function = static_cast<Function>(expr.a);
  if (function == Function::kFormat) return EvalFormat(expr);
  constexpr std::size_t kMost = 4;
  Value args[kMost];
  const std::size_t count = std::min<std::size_t>(expr.count, kMost);
  for (std::size_t i = 0; i < count; ++i) args[i] = Eval(module_.Item(expr.b + static_cast<std::uint32_t>(i)));
  if (session_.halted) return ZeroOf(expr.type);
  const std::string_view text = texts_.View(args[0]);
  const auto position = [](std::int64_t index) { return Value::Int(static_cast<double>(index)); };
  // A CHAR argument may come as a text of one character.
  const auto character = [&](const Value& value) -> std::uint32_t {
    constexpr std::uint32_t kNoCharacter = 0xFFFFFFFFU;
    if (!value.IsText())
      return value.number >= 0 && value.number < kNoCharacter ? static_cast<std::uint32_t>(value.number) : kNoCharacter;
    const std::string_view view = texts_.View(value);
    return view.empty() ? 0 : ops::CharacterAt(view, 0).code;
  };
  switch (function) {
    case Function::kStringLength:
      return position(static_cast<std::int64_t>(ops::Length(text)));
    case Function::kIndexOf:
      return position(ops::IndexOf(text, character(args[1])));
    case Function::kLastIndexOf:
      return position(ops::LastIndexOf(text, character(args[1])));
    case Function::kIndexOfAny:
      return position(ops::IndexOfAny(text, texts_.View(args[1])));
    case Function::kFind:
      return position(ops::Find(text, texts_.View(args[1])));
    case Function::kSubstring: {
      const double first = std::fmax(0, std::round(ToNumber(args[1])));
      const double length = count > 2 ? std::fmax(0, std::round(ToNumber(args[2]))) : machine_.string_max;
      const std::string part(ops::Substring(text, static_cast<std::size_t>(std::fmin(first, 1e9)),
                                            static_cast<std::size_t>(std::fmin(length, 1e9))));
      return NewText(part);
    }
    case Function::kToUpper:
    case Function::kToLower: {
      TextBuffer changed;
      (function == Function::kToUpper ? ops::AppendUpper : ops::AppendLower)(changed, text);
      return NewText(changed.View());
    }
    case Function::kParseNumber: {
      const ops::Number number = ops::ParseNumber(text);
      session_.Alarm(number.error);
      return Value::Real(number.value);
    }
    case Function::kIsNumber:
      return Value::Bool(ops::ParseNumber(text).Ok());
    case Function::kToText: {
      TextBuffer written;
      AppendText(written, args[0]);
      return NewText(written.View());
    }
    case Function::kFixedText: {
      if (args[0].IsVacant()) {
        session_.Alarm(ir::AlarmClass::kConversion, "an empty variable is printed");
        return Value::Text(0);
      }
      TextBuffer fixed;
      ops::AppendFixedText(fixed, ToNumber(args[0]), static_cast<int>(args[1].number), static_cast<int>(args[2].number),
                           machine_.fixed_text_pads);
      return NewText(fixed.View());
    }
    case Function::kIsVariable:
      return Value::Bool(IsKnownVariable(text));
    case Function::kAxisToText:
      return NewText(AxisName(static_cast<std::uint8_t>(args[0].number)));
    case Function::kAxisFromText:
      for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
        if (!text.empty() && ops::SameName(AxisName(axis), text)) return Value::Axis(axis);
      }
      session_.Alarm(ir::AlarmClass::kConversion, "no axis of that name");
      return Value::Axis(0);
    case Function::kIsAxis: {
      // Geometry axis n, from 1 (sinumerik-4.5).
      const double number = std::round(ToNumber(args[0]));
      return Value::Bool(number >= 1 && number <= 3 &&
                         ((machine_.axes >> static_cast<unsigned>(number - 1)) & 1U) != 0);
    }
    case Function::kParameter: {
      ir::System parameter;
      const std::optional<Value> value = session_.environment.Read(parameter, "parameter", args, count);
      if (value.has_value()) return *value;
      session_.Refuse(diag::Code::kMachineValue, "a machine parameter");
      return Value::Real(0);
    }
    default:
      NCPORT_BUG("{} is not evaluated", ir::NameOf(function));
  }
}

Value Evaluator::EvalFormat(const Expr& expr) {
  constexpr std::size_t kMost = 16;
  ops::FormatValue values[kMost];
  const Value format = Eval(module_.Item(expr.b));
  const std::size_t count = std::min<std::size_t>(expr.count - 1U, kMost);
  Value evaluated[kMost];
  for (std::size_t i = 0; i < count; ++i) evaluated[i] = Eval(module_.Item(expr.b + 1 + static_cast<std::uint32_t>(i)));
  // Views only after all values are made: the pool grows meanwhile.
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = {evaluated[i].IsText(), evaluated[i].number, texts_.View(evaluated[i])};
  }
  TextBuffer text;
  session_.Alarm(ops::Format(text, texts_.View(format), {values, count}));
  if (ops::Length(text.View()) > machine_.string_max) session_.Alarm(ir::AlarmClass::kRange, "text too long");
  return session_.halted ? Value::Text(0) : NewText(text.View());
}

/// A numbered cell inside its space, a variable of the running program or the channel, or a system variable.
bool Evaluator::IsKnownVariable(std::string_view name) const {
  name = name.substr(0, name.find('['));
  for (const ir::VariableId id : module_.variables.Ids()) {
    const ir::Variable& variable = module_.variables[id];
    const bool visible = variable.owner == facts_.program || !session_.linked.SlotOf(id).in_frame;
    if (visible && ops::SameName(module_.View(variable.name), name)) return true;
  }
  for (const ir::System& system : module_.systems.All()) {
    if (ops::SameName(module_.View(system.name), name)) return true;
  }
  for (const ir::Space& space : module_.spaces.All()) {
    const std::string_view prefix = module_.View(space.name);
    if (name.size() < prefix.size() || !ops::SameName(name.substr(0, prefix.size()), prefix)) continue;
    const std::string_view digits = name.substr(prefix.size());
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = digits.empty() || (error == std::errc{} && stop == digits.data() + digits.size());
    if (whole && (digits.empty() || (number >= space.first && number <= space.last))) return true;
  }
  return false;
}

}  // namespace ncport::exec
