#include "ir/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/result.h"
#include "base/text_buffer.h"
#include "ir/dump.h"
#include "ir/verifier.h"
#include "ir/word_shape.h"

namespace ncport::ir {

namespace {

constexpr std::uint64_t kMaxExprNodes = 1U << 20U;  // of one tree; shared nodes count each time

}  // namespace

// --- tables

bool Verifier::Tables() {
  // Ids without a name are of files that hold no program: profiles, settings.
  for (const StringId name : m_.file_names) {
    if (!String(name, "file name")) return false;
  }
  if (!Check(m_.axis_names.size() <= kMaxAxes - kFirstNamedAxis, "too many axis names")) return false;
  for (const StringId name : m_.axis_names) {
    if (!String(name, "axis name", false)) return false;
  }
  if (!Check(!m_.spellings.empty() && m_.spellings.size() <= 0x10000,
             "spellings need entry 0 and at most 65,536 rows")) {
    return false;
  }
  for (std::size_t i = 1; i < m_.spellings.size(); ++i) {
    if (!String(m_.spellings[i].text, "spelling", false) || !String(m_.spellings[i].rule, "rule")) return false;
  }
  for (const Space& space : m_.spaces.All()) {
    const bool ok = String(space.name, "name of a space", false) && Enumerator(space.type, "type") &&
                    Enumerator(space.lifetime, "lifetime") && Enumerator(space.visibility, "visibility") &&
                    Enumerator(space.start, "start value") &&
                    Check(space.first <= space.last, "a space ends before it starts");
    if (!ok) return false;
  }
  for (const System& system : m_.systems.All()) {
    const bool ok = String(system.name, "name of a system variable", false) &&
                    Enumerator(system.kind, "kind of system variable") && Enumerator(system.type, "type");
    if (!ok) return false;
  }
  return true;
}

// --- expressions

bool Verifier::Exprs() {
  const auto& places = m_.expr_places.All();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!Check(m_.exprs.Contains(places[i].expr), "a place of an expression that is not there")) return false;
    if (!Check(i == 0 || places[i - 1].expr.value < places[i].expr.value, "places of expressions out of order"))
      return false;
  }
  depths_.assign(m_.exprs.Size(), 1);
  nodes_.assign(m_.exprs.Size(), 1);
  for (const ExprId id : m_.exprs.Ids()) {
    At("expression", id.value, NameOf(m_.exprs[id].op));
    if (!Expr(id)) return false;
  }
  At({});
  return true;
}

bool Verifier::Child(ExprId parent, ExprId child) {
  if (!child.Valid()) return Fail("an operand is missing");
  if (child >= parent) return Fail("operand {} does not stand before it", child.value);
  depths_[parent.value] = std::max(depths_[parent.value], depths_[child.value] + 1);
  nodes_[parent.value] += nodes_[child.value];
  return Check(depths_[parent.value] <= kMaxExprDepth, "nested too deep") &&
         Check(nodes_[parent.value] <= kMaxExprNodes, "too many nodes");
}

ExprId Verifier::Raw(std::uint32_t value) {
  ExprId id;
  id.value = value;
  return id;
}

bool Verifier::Children(ExprId id, const ir::Expr& expr, std::uint32_t least, std::uint32_t most) {
  if (expr.count < least || expr.count > most) {
    return Fail("{} operands instead of {} to {}", expr.count, least, most);
  }
  if (!Range(expr.b, expr.count, m_.expr_items.size(), "list")) return false;
  for (std::uint32_t i = 0; i < expr.count; ++i) {
    if (!Child(id, m_.expr_items[expr.b + i])) return false;
  }
  return true;
}

bool Verifier::Expr(ExprId id) {
  const ir::Expr& expr = m_.exprs[id];
  if (!Enumerator(expr.op, "operation") || !Enumerator(expr.type, "type")) return false;
  if (!Check((expr.flags & 0x80U) == 0, "unknown flag")) return false;
  VariableId variable;
  variable.value = expr.a;
  SystemId system;
  system.value = expr.a;
  SpaceId space;
  space.value = expr.op == ExprOp::kCell ? expr.a : expr.b;
  StringId string;
  string.value = expr.a;
  // An array of strings takes an index for the character besides.
  constexpr std::uint32_t kMostIndices = 4;
  switch (expr.op) {
    case ExprOp::kLiteral:
      return Literal(expr);
    case ExprOp::kText:
      return String(string, "text", false);
    case ExprOp::kVacant:
      return true;
    case ExprOp::kAxisName:
      return Axis(expr.a);
    case ExprOp::kVariable:
      return Record(m_.variables, variable, "variable");
    case ExprOp::kElement:
      return Record(m_.variables, variable, "variable") && Children(id, expr, 1, kMostIndices);
    case ExprOp::kCell:
      return Record(m_.spaces, space, "space");
    case ExprOp::kCellAt:
      return Record(m_.spaces, space, "space") && Child(id, Raw(expr.a));
    case ExprOp::kSystem:
      return Record(m_.systems, system, "system variable") && Children(id, expr, 0, kMostIndices);
    case ExprOp::kName:
      return Check(!options_.names_resolved, "a name is left after resolution") && String(string, "name", false) &&
             Children(id, expr, 0, 0xFFFF);
    case ExprOp::kFunction: {
      if (!Check(expr.a < 256 && IsKnown(static_cast<Function>(expr.a)), "unknown function")) return false;
      const Arity arity = ArityOf(static_cast<Function>(expr.a));
      return Children(id, expr, arity.least, arity.most);
    }
    case ExprOp::kConvert:
      return Check(expr.type != Type::kNone, "conversion to no type") && Child(id, Raw(expr.a));
    default:
      break;
  }
  if (!Child(id, Raw(expr.a))) return false;
  return OperandsOf(expr.op) != Operands::kBinary || Child(id, Raw(expr.b));
}

bool Verifier::Literal(const ir::Expr& expr) {
  if (!Check(std::isfinite(expr.number), "not finite")) return false;
  if (!Check((expr.format.flags & 0xF0U) == 0, "unknown flag of the number format")) return false;
  const bool as_text = (expr.format.flags & NumberFormat::kAsText) != 0;
  if (as_text != (expr.count != 0)) return Fail("spelling and kAsText do not agree");
  if (!as_text) return true;
  if (expr.count >= m_.literal_texts.size()) return Fail("spelling {} of {}", expr.count, m_.literal_texts.size());
  return String(m_.literal_texts[expr.count], "spelling", false);
}

// --- records that words lead to

bool Verifier::Lists() {
  At("expression lists");
  // Entries of assignment lists may be missing, so only their range is checked here.
  for (const ExprId item : m_.expr_items) {
    if (!Operand(item, "entry")) return false;
  }
  At({});
  return true;
}

bool Verifier::TargetOk(const Target& target) {
  if (!Enumerator(target.kind, "kind of target") || !String(target.label, "label") || !Operand(target.expr, "target")) {
    return false;
  }
  return true;
}

bool Verifier::Records() {
  At("jump");
  for (const Jump& jump : m_.jumps.All()) {
    if (!Enumerator(jump.search, "search") || !TargetOk(jump.target)) return false;
  }
  At("switch");
  for (const Switch& record : m_.switches.All()) {
    if (!Range(record.first_arm, record.arm_count, m_.switch_arms.size(), "arms")) return false;
    for (std::uint32_t i = 0; i < record.arm_count; ++i) {
      const SwitchArm& arm = m_.switch_arms[record.first_arm + i];
      if (!Operand(arm.value, "value of an arm") || !Record(m_.jumps, arm.jump, "jump of an arm")) return false;
      if (!arm.value.Valid() && i + 1 != record.arm_count) return Fail("the default arm is not the last one");
    }
  }
  At("call");
  for (const Call& call : m_.calls.All()) {
    const bool ok = Enumerator(call.form, "form") && String(call.name, "name") &&
                    Record(m_.programs, call.program, "program", true) && Operand(call.name_expr, "name") &&
                    Operand(call.passes, "passes") && TargetOk(call.from) && TargetOk(call.to) &&
                    Range(call.args.begin, call.args.count, m_.args.Size(), "arguments");
    if (!ok) return false;
  }
  for (const Arg& arg : m_.args.All()) {
    if (!Operand(arg.value, "argument")) return false;
  }
  At("part");
  for (const Part& part : m_.parts.All()) {
    if (!TargetOk(part.first) || !TargetOk(part.last)) return false;
    if (!Check(!part.single || !part.has_last, "a single block with an end")) return false;
  }
  At("for");
  for (const For& loop : m_.fors.All()) {
    if (!Place(loop.variable, "variable") || !Operand(loop.end, "end") || !Operand(loop.step, "step")) return false;
  }
  At("extern");
  for (const Extern& record : m_.externs.All()) {
    if (!String(record.name, "name", false) ||
        !Range(record.first_param, record.param_count, m_.extern_params.size(), "parameters")) {
      return false;
    }
  }
  for (const ExternParam& param : m_.extern_params) {
    if (!Enumerator(param.type, "type") || !Dimensions(param.dimension_count, param.dimensions)) return false;
  }
  At("assignment list");
  for (const AssignList& list : m_.assign_lists.All()) {
    if (!Place(list.place, "place") || !Operand(list.count, "count") ||
        !Range(list.values.begin, list.values.count, m_.expr_items.size(), "values")) {
      return false;
    }
  }
  At({});
  return true;
}

bool Verifier::Dimensions(std::uint8_t count, const std::uint32_t (&dimensions)[3]) {
  if (!Check(count <= 3, "more than three dimensions")) return false;
  for (std::uint32_t i = count; i < 3; ++i) {
    if (!Check(dimensions[i] == 0, "size of a dimension that is not there")) return false;
  }
  return true;
}

bool Verifier::Variables() {
  for (const VariableId id : m_.variables.Ids()) {
    const Variable& variable = m_.variables[id];
    At("variable", id.value);
    const bool ok = String(variable.name, "name", false) && Enumerator(variable.type, "type") &&
                    Enumerator(variable.scope, "scope") && Dimensions(variable.dimension_count, variable.dimensions) &&
                    Record(m_.programs, variable.owner, "owner", true) && Operand(variable.initial, "initial value") &&
                    Record(m_.assign_lists, variable.initial_list, "initial list", true) &&
                    Operand(variable.lower_limit, "lower limit") && Operand(variable.upper_limit, "upper limit") &&
                    File(variable.file);
    if (!ok) return false;
    const bool needs_owner = variable.scope == Scope::kLocal || variable.scope == Scope::kParameter;
    if (!Check(variable.owner.Valid() || !needs_owner, "a local of no program")) return false;
  }
  At({});
  return true;
}

bool Verifier::Origins() {
  std::vector<std::uint32_t> depths(m_.origins.Size(), 1);
  for (const OriginId id : m_.origins.Ids()) {
    const Origin& origin = m_.origins[id];
    At("origin", id.value);
    if (!File(origin.file) || !String(origin.pass, "pass")) return false;
    if (!origin.via.Valid()) continue;
    if (!Check(origin.via < id, "leads to one that does not stand before it")) return false;
    depths[id.value] = depths[origin.via.value] + 1;
    if (!Check(depths[id.value] <= kMaxOriginDepth, "chain too long")) return false;
  }
  At({});
  return true;
}

namespace {

std::string PlaceOf(const Module& module, BlockId block) {
  if (!block.Valid() || !module.blocks.Contains(block) || !module.origins.Contains(module.blocks[block].origin))
    return {};
  const Origin& origin = module.origins[module.blocks[block].origin];
  std::string_view name = "-";
  if (origin.file.value < module.file_names.size()) {
    const StringId text = module.file_names[origin.file.value];
    if (text.value < module.strings.Size()) name = module.strings.View(text);
  }
  return fmt::format("{}:{}: ", name, origin.line);
}

}  // namespace

std::optional<std::string> FindViolation(const Module& module, const VerifyOptions& options) {
  const std::optional<Violation> violation = Verifier{module, options}.Run();
  if (!violation) return std::nullopt;
  return PlaceOf(module, violation->block) + violation->text;
}

bool Verify(const Module& module, std::string_view when, const VerifyOptions& options) {
  const std::optional<Violation> violation = Verifier{module, options}.Run();
  if (!violation) return true;
  TextBuffer dump;
  DumpOptions dump_options;
  dump_options.marked = violation->block;
  dump_options.mark = violation->text;
  Dump(module, dump, dump_options);
  // The lines around the mark tell more than the whole of a large module.
  constexpr std::size_t kAround = 4000;
  std::string_view shown = dump.View();
  const std::size_t mark = violation->block.Valid() ? shown.find("\n  // ^ ") : std::string_view::npos;
  const std::size_t middle = mark == std::string_view::npos ? 0 : mark;
  const std::size_t begin = middle > kAround ? shown.rfind('\n', middle - kAround) + 1 : 0;
  shown = shown.substr(begin, middle - begin + kAround);
  fmt::print(stderr, "{}\n", shown);
  NCPORT_BUG("the program in neutral form is broken {}: {}{}", when, PlaceOf(module, violation->block),
             violation->text);
}

}  // namespace ncport::ir
