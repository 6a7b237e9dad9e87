#include "app/run_arguments.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/letter_case.h"
#include "base/number_text.h"
#include "dialects/argument_letters.h"
#include "ir/axis_names.h"
#include "ir/length_units.h"

namespace ncport::app {
namespace {

bool Same(std::string_view a, std::string_view b, bool ignore_case) {
  return ignore_case ? EqualIgnoringCase(a, b) : a == b;
}

std::string_view Trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

Status Fail(diag::Sink& sink, std::string_view option, std::string_view why) {
  sink.Report(diag::Code::kBadOption, SourceRange{}, std::string(option), std::string(why));
  return Failure{};
}

struct Constant {
  exec::Value value;
  std::string text;
};

/// A constant as a program writes it. Whole numbers without a point are INT.
std::optional<Constant> ParseConstant(std::string_view text) {
  Constant constant;
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    constant.value.type = ir::Type::kString;
    constant.text = text.substr(1, text.size() - 2);
    return constant;
  }
  if (Same(text, "TRUE", true) || Same(text, "FALSE", true)) {
    constant.value = exec::Value::Bool(text.size() == 4);
    return constant;
  }
  if (const auto axis = text.size() == 1 ? ir::AxisOf(Upper(text[0])) : std::nullopt) {
    constant.value = exec::Value::Axis(*axis);
    return constant;
  }
  const char* p = text.data();
  const char* end = p + text.size();
  DecimalText number;
  if (!ParseDecimal(p, end, number) || p != end || !std::isfinite(number.value)) return std::nullopt;
  constant.value = number.has_point ? exec::Value::Real(number.value) : exec::Value::Int(number.value);
  return constant;
}

/// The constant in the type of the variable that takes it, as an assignment would convert it.
std::optional<Constant> ConvertTo(Constant constant, ir::Type type) {
  const ir::Type from = constant.value.type;
  const bool number = from == ir::Type::kInt || from == ir::Type::kReal || from == ir::Type::kBool;
  switch (type) {
    case ir::Type::kReal:
    case ir::Type::kNumber:
      if (!number) return std::nullopt;
      constant.value = exec::Value::Real(constant.value.number);
      return constant;
    case ir::Type::kInt:
      if (!number) return std::nullopt;
      constant.value = exec::Value::Int(std::round(constant.value.number));
      return constant;
    case ir::Type::kBool:
      if (!number) return std::nullopt;
      constant.value = exec::Value::Bool(constant.value.number != 0);
      return constant;
    case ir::Type::kChar:
      if (from == ir::Type::kString && constant.text.size() == 1) {
        constant.value = exec::Value::Char(static_cast<unsigned char>(constant.text[0]));
        constant.text.clear();
        return constant;
      }
      if (!number) return std::nullopt;
      constant.value = exec::Value::Char(std::round(constant.value.number));
      return constant;
    case ir::Type::kString:
      if (from != ir::Type::kString) return std::nullopt;
      return constant;
    case ir::Type::kAxis:
      if (from != ir::Type::kAxis) return std::nullopt;
      return constant;
    case ir::Type::kAny:
      return constant;
    case ir::Type::kNone:
    case ir::Type::kFrame:
      return std::nullopt;
  }
  return std::nullopt;
}

/// Pieces between commas that stand outside of quotes.
std::vector<std::string_view> SplitArguments(std::string_view text) {
  std::vector<std::string_view> pieces;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '"') quoted = !quoted;
    if (i < text.size() && (quoted || text[i] != ',')) continue;
    pieces.push_back(Trim(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  if (pieces.size() == 1 && pieces[0].empty()) pieces.clear();
  return pieces;
}

}  // namespace

Status ApplyCall(std::string_view call, const ir::Module& module, const dialects::Profile& profile,
                 exec::RunOptions& options, diag::Sink& sink) {
  const std::string_view whole = Trim(call);
  const std::size_t bracket = whole.find('(');
  const std::string_view name = Trim(whole.substr(0, bracket));
  std::string_view inside;
  if (bracket != std::string_view::npos) {
    if (whole.back() != ')') return Fail(sink, "--call", fmt::format("{} has no closing bracket", whole));
    inside = whole.substr(bracket + 1, whole.size() - bracket - 2);
  }
  options.entry = module.FindProgram(name, profile.names.ignore_case.Or(true));
  if (!options.entry.Valid()) return Fail(sink, "--call", fmt::format("there is no program {}", name));
  options.is_call = true;
  const ir::Program& program = module.programs[options.entry];

  std::uint16_t position = 0;
  for (const std::string_view piece : SplitArguments(inside)) {
    const bool letter = piece.size() >= 2 && piece[1] == '=' && Upper(piece[0]) >= 'A' && Upper(piece[0]) <= 'Z';
    exec::EntryArgument argument;
    const std::uint16_t ordinal = position++;
    argument.position = ordinal;
    ir::Type type = ir::Type::kAny;
    if (letter) {
      argument.letter = Upper(piece[0]);
      const std::uint32_t cell = dialects::CellOfArgument(profile, argument.letter);
      if (cell == 0)
        return Fail(sink, "--call", fmt::format("{} is no letter that a call of {} can have", argument.letter, name));
      argument.position = static_cast<std::uint16_t>(cell);
      type = ir::Type::kReal;
    } else if (argument.position >= program.parameters.count) {
      return Fail(sink, "--call", fmt::format("{} takes {} arguments", name, program.parameters.count));
    } else {
      type = module.variables[program.parameters[argument.position]].type;
    }
    const std::string_view text = letter ? Trim(piece.substr(2)) : piece;
    if (!text.empty()) {
      std::optional<Constant> constant = ParseConstant(text);
      if (constant) constant = ConvertTo(*std::move(constant), type);
      if (!constant)
        return Fail(sink, "--call", fmt::format("{} is not a constant for argument {} of {}", text, ordinal + 1, name));
      argument.value = constant->value;
      argument.text = constant->text;
    }
    options.arguments.push_back(std::move(argument));
  }
  return {};
}

Status ApplySet(std::string_view set, const ir::Module& module, bool ignore_case, exec::RunOptions& options,
                diag::Sink& sink) {
  const std::size_t sign = set.find('=');
  if (sign == std::string_view::npos) return Fail(sink, "--set", fmt::format("{} has no =", set));
  const std::string_view name = Trim(set.substr(0, sign));
  const std::string_view text = Trim(set.substr(sign + 1));

  exec::StartValue start;
  ir::Type type = ir::Type::kAny;
  for (const ir::VariableId id : module.variables.Ids()) {
    const ir::Variable& variable = module.variables[id];
    if (!Same(module.View(variable.name), name, ignore_case)) continue;
    const bool visible = variable.owner == options.entry || variable.scope == ir::Scope::kChannel ||
                         variable.scope == ir::Scope::kGlobal;
    if (!visible || variable.dimension_count != 0) continue;
    start.variable = id;
    type = variable.type;
    break;
  }
  if (!start.variable.Valid()) {
    std::size_t digits = name.size();
    while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
    const std::string_view number = name.substr(digits);
    std::uint32_t cell = 0;
    for (const char c : number.substr(0, 9)) cell = cell * 10 + static_cast<std::uint32_t>(c - '0');
    for (const ir::SpaceId id : module.spaces.Ids()) {
      const ir::Space& space = module.spaces[id];
      if (number.empty() || number.size() > 9 || !Same(module.View(space.name), name.substr(0, digits), ignore_case))
        continue;
      if (cell < space.first || cell > space.last) continue;
      start.space = id;
      start.cell = cell;
      type = space.type;
      break;
    }
  }
  if (!start.variable.Valid() && !start.space.Valid())
    return Fail(sink, "--set", fmt::format("there is no variable {}", name));
  std::optional<Constant> constant = ParseConstant(text);
  if (constant) constant = ConvertTo(*std::move(constant), type);
  if (!constant) return Fail(sink, "--set", fmt::format("{} is not a value for {}", text, name));
  start.value = constant->value;
  start.text = constant->text;
  options.start_values.push_back(std::move(start));
  return {};
}

Status ApplyStart(std::string_view start, const dialects::Profile& profile, exec::RunOptions& options,
                  diag::Sink& sink) {
  const bool inch = profile.units.Is(dialects::LengthUnit::kInch);
  const char* p = start.data();
  const char* end = p + start.size();
  while (true) {
    while (p != end && *p == ' ') ++p;
    if (p == end) break;
    const std::optional<std::uint8_t> axis = ir::AxisOf(Upper(*p));
    const char* number_begin = p + 1;
    DecimalText number;
    if (!axis || !ParseDecimal(number_begin, end, number) || !std::isfinite(number.value)) {
      return Fail(sink, "--start", fmt::format("{} is not a position such as X0Y0Z100", start));
    }
    p = number_begin;
    const auto bit = static_cast<std::uint16_t>(1U << *axis);
    if ((options.start_axes & bit) != 0)
      return Fail(sink, "--start", fmt::format("{} stands twice", ir::kAxisLetters[*axis]));
    options.start_axes = static_cast<std::uint16_t>(options.start_axes | bit);
    options.start_position[*axis] = number.value * (inch && !ir::IsRotary(*axis) ? ir::kMmPerInch : 1);
  }
  if (options.start_axes == 0) return Fail(sink, "--start", "no axis is named");
  options.start_position_known = true;
  return {};
}

}  // namespace ncport::app
