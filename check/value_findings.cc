#include "check/value_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ncport::check {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::analysis::CallContext;
using ir::analysis::Interval;

namespace {

constexpr std::size_t kMostNotes = 3;

std::string NumberText(double value) { return fmt::format("{:.10g}", value + 0.0); }

}  // namespace

std::string TextOf(const Interval& values) {
  if (!values.HasNumber()) return "empty";
  if (values.low == values.high) return NumberText(values.low);
  // The range of INT says as little as none.
  constexpr double kLargest = 2147483647.0;
  const bool open_below = values.low <= -kLargest;
  const bool open_above = values.high >= kLargest;
  if (open_below && open_above) return "any number";
  if (open_below) return fmt::format("{} or less", NumberText(values.high));
  if (open_above) return fmt::format("{} or more", NumberText(values.low));
  return fmt::format("{} to {}", NumberText(values.low), NumberText(values.high));
}

bool IsKnown(const Interval& values) {
  constexpr double kLargest = 1073741824.0;
  return !values.Has(Interval::kInput) && values.low > -kLargest && values.high < kLargest;
}

bool ValueFindings::IsNews(diag::Code code, ExprId expr, std::uint32_t part, Certainty certainty) const {
  if (certainty == Certainty::kPossible && !input_.options.all) return false;
  const auto known = findings_.find({code, expr.value, part});
  return known == findings_.end() || known->second.certainty < certainty;
}

void ValueFindings::Add(ExprId expr, std::uint32_t part, ValueFinding finding) {
  const std::tuple key{finding.code, expr.value, part};
  findings_.insert_or_assign(key, std::move(finding));
}

void ValueFindings::Report(diag::Sink& sink) const {
  for (const auto& [key, finding] : findings_) {
    const diag::Severity severity =
        finding.certainty == Certainty::kCertain ? diag::InfoOf(finding.code).severity : diag::Severity::kWarning;
    diag::Diagnostic& out =
        sink.ReportAs(severity, finding.code, finding.at, finding.first, finding.second, finding.third);
    out.notes = finding.notes;
    out.help = finding.help;
    out.control = finding.control;
  }
}

ExprId ValueRule::Bare(ExprId id) const {
  for (;;) {
    const Expr& expr = input_.module.exprs[id];
    const bool wrapped = expr.op == ExprOp::kGroup || expr.op == ExprOp::kConvert || expr.op == ExprOp::kPlus ||
                         expr.op == ExprOp::kNegate;
    if (!wrapped) return id;
    id = ExprId{std::size_t{expr.a}};
  }
}

SourceRange ValueRule::RangeOf(const Site& site, ExprId expr) const {
  const ir::Block& block = input_.module.blocks[site.block];
  if (expr.Valid()) {
    const SourceRange range = input_.module.RangeOf(block, expr);
    if (range.end > range.begin) return range;
  }
  if (site.word.Valid()) return input_.module.RangeOf(block, input_.module.words[site.word]);
  return input_.module.RangeOf(block);
}

std::string ValueRule::TextOf(const Site& site, ExprId id) const {
  const Expr& expr = input_.module.exprs[id];
  if (expr.op == ExprOp::kVariable)
    return std::string(input_.module.View(input_.module.variables[ir::VariableId{std::size_t{expr.a}}].name));
  if (expr.op == ExprOp::kCell)
    return fmt::format("{}{}", input_.module.View(input_.module.spaces[ir::SpaceId{std::size_t{expr.a}}].name), expr.b);
  const SourceRange range = input_.module.RangeOf(input_.module.blocks[site.block], id);
  if (input_.options.files != nullptr && range.Valid() && range.end > range.begin &&
      range.file.value < input_.options.files->Size()) {
    const std::string_view text = input_.options.files->View(range);
    if (!text.empty()) return std::string(text);
  }
  return "the value";
}

std::string ValueRule::ControlAlarm(ir::AlarmClass alarm) const {
  const std::string& code = input_.machine.alarms[static_cast<std::size_t>(alarm)].code;
  if (input_.options.control.empty() || code.empty()) return {};
  return fmt::format("{} {}", input_.options.control, code);
}

namespace {

/// Variables and cells in an expression, in order, each once.
void Leaves(const ir::Module& module, ExprId id, std::vector<ExprId>& leaves) {
  const Expr& expr = module.exprs[id];
  if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kCell) {
    const auto same = [&](ExprId other) {
      const Expr& known = module.exprs[other];
      return known.op == expr.op && known.a == expr.a && (expr.op == ExprOp::kVariable || known.b == expr.b);
    };
    if (std::ranges::none_of(leaves, same)) leaves.push_back(id);
    return;
  }
  switch (ir::OperandsOf(expr.op)) {
    case ir::Operands::kLeaf:
      return;
    case ir::Operands::kUnary:
      return Leaves(module, ExprId{std::size_t{expr.a}}, leaves);
    case ir::Operands::kBinary:
      Leaves(module, ExprId{std::size_t{expr.a}}, leaves);
      return Leaves(module, ExprId{std::size_t{expr.b}}, leaves);
    case ir::Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) Leaves(module, module.Item(expr.b + i), leaves);
      return;
  }
}

bool IsWritten(const ir::Module& module, ir::ProgramId program, ir::VariableId variable) {
  for (const ir::BlockId block : module.programs[program].blocks) {
    for (const ir::WordId id : module.blocks[block].words) {
      const ir::Word& word = module.words[id];
      if (word.op == ir::WordOp::kCall || word.op == ir::WordOp::kModalCall) {
        if (!word.Extra<ir::CallId>().Valid()) continue;
        for (const ir::ArgId arg : module.calls[word.Extra<ir::CallId>()].args) {
          const ExprId value = module.args[arg].value;
          if (value.Valid() && module.exprs[value].op == ExprOp::kVariable && module.exprs[value].a == variable.value)
            return true;
        }
      }
      if (word.op != ir::WordOp::kAssign) continue;
      const Expr& place = module.exprs[word.Extra<ExprId>()];
      if (place.op == ExprOp::kVariable && place.a == variable.value) return true;
    }
  }
  return false;
}

std::string PlaceOfCall(const ValueRuleInput& input, const CallContext& context) {
  const SourceRange range = input.module.RangeOf(input.module.blocks[context.block]);
  std::string_view name;
  if (input.options.files != nullptr && range.file.value < input.options.files->Size())
    name = input.options.files->Name(range.file);
  return fmt::format("{}:{}", name, range.line);
}

/// What the call gives for a parameter that keeps its value.
std::string Passed(const ValueRuleInput& input, const CallContext& context, std::uint32_t position,
                   const Interval& value) {
  const ir::Call& call = input.module.calls[context.call];
  for (const ir::ArgId id : call.args) {
    const ir::Arg& arg = input.module.args[id];
    if (arg.letter == 0 && arg.position == position && arg.value.Valid())
      return fmt::format("passes {}", check::TextOf(value));
  }
  return fmt::format("leaves it out, so it is {}", check::TextOf(value));
}

}  // namespace

std::vector<diag::Note> ValueRule::Reasons(const Site& site, ExprId expr, Lookup& lookup) const {
  const ir::Module& module = input_.module;
  std::vector<diag::Note> notes;
  std::vector<ExprId> leaves;
  Leaves(module, expr, leaves);
  const CallContext& context = *site.context;
  const bool called = context.caller != nullptr;
  bool call_named = false;
  for (const ExprId leaf : leaves) {
    if (notes.size() >= kMostNotes) break;
    const Expr& place = module.exprs[leaf];
    const Interval value = lookup.Evaluate(leaf);
    const std::string name = TextOf(site, leaf);
    if (place.op == ExprOp::kVariable) {
      const ir::VariableId id{std::size_t{place.a}};
      const IdRange<ir::VariableId> parameters = module.programs[context.program].parameters;
      const bool parameter = id.value >= parameters.begin && id.value < parameters.begin + parameters.count;
      if (parameter && !IsWritten(module, context.program, id)) {
        const std::uint32_t position = id.value - parameters.begin;
        std::string text = fmt::format("{} is parameter {} of {}; ", name, position + 1,
                                       module.View(module.programs[context.program].name));
        if (called) {
          text +=
              fmt::format("the call in {} {}", PlaceOfCall(input_, context), Passed(input_, context, position, value));
          call_named = true;
        } else if (value.Has(Interval::kEntry)) {
          text += "its callers are not known here";
        } else {
          text += fmt::format("it is {} here", check::TextOf(value));
        }
        notes.push_back({{}, std::move(text)});
        continue;
      }
    }
    if (value.Has(Interval::kVacant) && !value.HasNumber()) {
      notes.push_back({{}, fmt::format("{} is empty here", name)});
    } else if (check::TextOf(value) != "any number") {
      notes.push_back({{}, fmt::format("{} is {} here", name, check::TextOf(value))});
    } else if (place.op == ExprOp::kCell && !called && value.Has(Interval::kEntry)) {
      notes.push_back({{}, fmt::format("{} is as the caller gives it, and no caller is known here", name)});
    }
  }
  if (called && !call_named)
    notes.push_back({{}, fmt::format("the call in {} leads here", PlaceOfCall(input_, context))});
  return notes;
}

}  // namespace ncport::check
