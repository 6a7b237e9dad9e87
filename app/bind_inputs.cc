#include "app/bind_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "dialects/argument_letters.h"
#include "exec/link.h"
#include "ir/analysis/call_graph.h"
#include "ir/analysis/unwritten_cells.h"
#include "ir/ops/text.h"
#include "ir/transform/linear_form.h"

namespace ncport::app {
namespace {

using ir::ops::SameName;

/// The number of a constant, its sign included.
std::optional<double> ConstantOf(const ir::Module& module, ir::ExprId value) {
  double sign = 1;
  while (value.Valid()) {
    const ir::Expr& expr = module.exprs[value];
    if (expr.op == ir::ExprOp::kLiteral) return sign * expr.number;
    if (expr.op == ir::ExprOp::kNegate) sign = -sign;
    if (expr.op != ir::ExprOp::kGroup && expr.op != ir::ExprOp::kNegate && expr.op != ir::ExprOp::kPlus &&
        expr.op != ir::ExprOp::kConvert)
      break;
    value = ir::ExprId{expr.a};
  }
  return std::nullopt;
}

void VisitNodes(const ir::Module& module, ir::ExprId id, const std::function<void(const ir::Expr&)>& visit) {
  if (!id.Valid()) return;
  const ir::Expr& expr = module.exprs[id];
  visit(expr);
  switch (ir::OperandsOf(expr.op)) {
    case ir::Operands::kLeaf:
      return;
    case ir::Operands::kUnary:
      return VisitNodes(module, ir::ExprId{expr.a}, visit);
    case ir::Operands::kBinary:
      VisitNodes(module, ir::ExprId{expr.a}, visit);
      return VisitNodes(module, ir::ExprId{expr.b}, visit);
    case ir::Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) VisitNodes(module, module.Item(expr.b + i), visit);
  }
}

}  // namespace

ir::ProgramId FindByName(const ir::Module& module, std::string_view name) {
  for (const ir::ProgramId id : module.programs.Ids()) {
    const std::string_view known = module.View(module.programs[id].name);
    if (SameName(known, name) ||
        (known.size() > 1 && (known[0] == 'O' || known[0] == 'o') && SameName(known.substr(1), name)))
      return id;
  }
  return {};
}

void Binder::ApplyRange(prove::Input& input) const {
  if (config_ == nullptr) return;
  for (const dialects::ValueRange& range : config_->ranges) {
    if (!SameName(range.name, input.name)) continue;
    if (range.least_of.empty()) input.low = range.least;
    if (range.most_of.empty()) input.high = range.most;
  }
}

std::vector<backends::ProgramName> Binder::PartsOf(ir::ProgramId program) const {
  std::vector<backends::ProgramName> parts;
  for (const backends::ProgramName& name : translation_.programs) {
    if (name.whole == program) parts.push_back(name);
  }
  return parts;
}

std::vector<prove::BoundInput> Binder::Arguments() {
  std::vector<prove::BoundInput> inputs;
  std::set<std::uint32_t> callees;
  if (is_call_) callees.insert(run_.entry.value);
  for (const ir::BlockId block : source_.programs[run_.entry].blocks) {
    for (const ir::WordId id : source_.blocks[block].words) {
      const ir::Word& word = source_.words[id];
      if ((word.op != ir::WordOp::kCall && word.op != ir::WordOp::kModalCall) || !word.Extra<ir::CallId>().Valid())
        continue;
      const ir::Call& call = source_.calls[word.Extra<ir::CallId>()];
      if (!call.program.Valid() || is_call_) continue;
      // The text of a standard cycle is fitted to its calls: what they give is no input.
      if (source_.programs[call.program].library) continue;
      callees.insert(call.program.value);
      calls_.push_back(word.Extra<ir::CallId>());
    }
  }
  for (const std::uint32_t callee : callees) {
    Parameters(ir::ProgramId{callee}, inputs);
    Letters(ir::ProgramId{callee}, inputs);
  }
  return inputs;
}

void Binder::Parameters(ir::ProgramId callee, std::vector<prove::BoundInput>& inputs) const {
  const ir::Program& program = source_.programs[callee];
  for (std::uint32_t i = 0; i < program.parameters.count; ++i) {
    const ir::Variable& variable = source_.variables[program.parameters[i]];
    if (variable.by_reference || variable.type == ir::Type::kString) continue;
    prove::BoundInput bound;
    bound.input.name = fmt::format("{}.{}", source_.View(program.name), source_.View(variable.name));
    bound.input.integer = variable.type != ir::Type::kReal;
    bound.input.boolean = variable.type == ir::Type::kBool;
    ApplyRange(bound.input);
    for (const ir::CallId id : calls_) {
      if (source_.calls[id].program != callee) continue;
      for (const ir::ArgId arg : source_.calls[id].args) {
        const ir::Arg& given = source_.args[arg];
        if (given.position != i || !given.value.Valid()) continue;
        // The call rounds what a whole parameter gets; a set stands for what arrives.
        if (const auto value = ConstantOf(source_, given.value))
          bound.input.seen.push_back(bound.input.integer ? std::round(*value) : *value);
      }
    }
    prove::InputPlace place;
    place.callee = callee;
    place.position = static_cast<std::uint16_t>(i);
    bound.source.push_back(place);
    if (translation_.keeps_files) {
      prove::InputPlace same = place;
      same.callee = FindByName(target_, source_.View(program.name));
      if (same.callee.Valid()) bound.target.push_back(same);
      inputs.push_back(std::move(bound));
      continue;
    }
    // Every program of the target that got a letter for this parameter: the parts of a split cycle have one each.
    for (const backends::ProgramName& part : PartsOf(callee)) {
      for (const ir::transform::CellMapping& mapping : translation_.cells) {
        if (mapping.letter == 0 || mapping.program != part.program ||
            !SameName(mapping.source, source_.View(variable.name)))
          continue;
        prove::InputPlace there;
        there.callee = FindByName(target_, part.target);
        there.letter = mapping.letter;
        there.position = static_cast<std::uint16_t>(mapping.first);
        if (there.callee.Valid()) bound.target.push_back(there);
      }
    }
    inputs.push_back(std::move(bound));
  }
}

ir::SpaceId Binder::LevelSpace() const {
  for (const ir::SpaceId id : source_.spaces.Ids()) {
    if (source_.spaces[id].visibility == ir::Visibility::kLevel) return id;
  }
  return {};
}

/// The program, and those that run with its locals.
std::vector<ir::ProgramId> Binder::ProgramsOfLevel(ir::ProgramId program) const {
  const ir::analysis::CallGraph graph(source_);
  std::vector<ir::ProgramId> programs{program};
  for (std::size_t i = 0; i < programs.size(); ++i) {
    for (const ir::analysis::CallSite& site : graph.SitesOf(programs[i])) {
      if (!site.callee.Valid() || source_.calls[site.call].new_level) continue;
      if (std::find(programs.begin(), programs.end(), site.callee) == programs.end()) programs.push_back(site.callee);
    }
  }
  return programs;
}

/// Blocks whose condition asks whether the local is empty (`IF [#1 EQ #0]`).
std::vector<ir::BlockId> Binder::EmptinessTests(ir::ProgramId program, std::uint32_t cell) const {
  std::vector<ir::BlockId> tests;
  const ir::SpaceId space = LevelSpace();
  const auto bare = [&](std::uint32_t node) {
    ir::ExprId id{node};
    while (source_.exprs[id].op == ir::ExprOp::kGroup || source_.exprs[id].op == ir::ExprOp::kConvert)
      id = ir::ExprId{source_.exprs[id].a};
    return source_.exprs[id];
  };
  for (const ir::ProgramId id : ProgramsOfLevel(program)) {
    for (const ir::BlockId block : source_.programs[id].blocks) {
      for (const ir::WordId word : source_.blocks[block].words) {
        bool found = false;
        VisitNodes(source_, source_.words[word].value, [&](const ir::Expr& expr) {
          if ((expr.op != ir::ExprOp::kEqual && expr.op != ir::ExprOp::kNotEqual) ||
              (expr.flags & ir::Expr::kVacantDiffers) == 0)
            return;
          const ir::Expr a = bare(expr.a), b = bare(expr.b);
          const auto is_cell = [&](const ir::Expr& side) {
            return side.op == ir::ExprOp::kCell && side.a == space.value && side.b == cell;
          };
          found = found || (is_cell(a) && b.op == ir::ExprOp::kVacant) || (is_cell(b) && a.op == ir::ExprOp::kVacant);
        });
        if (found) tests.push_back(block);
      }
    }
  }
  return tests;
}

/// Locals with a letter that a program without callers reads as its caller left them.
std::vector<std::uint32_t> Binder::CellsReadAtEntry(ir::ProgramId program) const {
  const ir::SpaceId space = LevelSpace();
  std::set<std::uint32_t> unwritten, read;
  const ir::analysis::FlowGraphs graphs(source_);
  const ir::analysis::CallGraph calls(source_);
  for (const ir::analysis::UnwrittenRead& found : ir::analysis::UnwrittenCells(source_, graphs, calls)) {
    if (found.space == space && found.cell != ir::analysis::UnwrittenRead::kComputed) unwritten.insert(found.cell);
  }
  for (const ir::ProgramId id : ProgramsOfLevel(program)) {
    for (const ir::BlockId block : source_.programs[id].blocks) {
      const auto look = [&](ir::ExprId value) {
        ir::transform::VisitReads(source_, value, [&](ir::ExprId node) {
          const ir::Expr& expr = source_.exprs[node];
          if (expr.op == ir::ExprOp::kCell && expr.a == space.value) read.insert(expr.b);
        });
      };
      for (const ir::WordId word_id : source_.blocks[block].words) {
        const ir::Word& word = source_.words[word_id];
        look(word.value);
        if ((word.op != ir::WordOp::kCall && word.op != ir::WordOp::kModalCall) || !word.Extra<ir::CallId>().Valid())
          continue;
        for (const ir::ArgId arg : source_.calls[word.Extra<ir::CallId>()].args) look(source_.args[arg].value);
      }
    }
  }
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t cell : unwritten) {
    if (read.contains(cell) && dialects::LetterOfArgument(profile_, cell) != 0) cells.push_back(cell);
  }
  return cells;
}

bool Binder::LetterPlaces(ir::ProgramId callee, const prove::InputPlace& source, std::vector<prove::InputPlace>& places,
                          bool& may_miss) const {
  if (translation_.keeps_files || target_profile_.language == profile_.language) {
    for (const backends::ProgramName& part : PartsOf(callee)) {
      prove::InputPlace same = source;
      same.callee = FindByName(target_, part.target);
      if (same.callee.Valid()) places.push_back(same);
    }
    return !places.empty();
  }
  bool truth = false;
  for (const backends::ProgramName& part : PartsOf(callee)) {
    const IdRange<ir::VariableId> parameters = translation_.module.programs[part.program].parameters;
    for (std::uint32_t i = 0; i < parameters.count; ++i) {
      const ir::Variable& variable = translation_.module.variables[parameters[i]];
      const auto mapping =
          std::find_if(translation_.cells.begin(), translation_.cells.end(),
                       [&](const ir::transform::CellMapping& known) { return known.variable == parameters[i]; });
      if (mapping == translation_.cells.end() || mapping->first != source.position) continue;
      if (variable.by_reference) return false;  // the value goes through a variable of the caller
      prove::InputPlace there;
      there.callee = FindByName(target_, part.target);
      there.position = static_cast<std::uint16_t>(i);
      there.truth = variable.type == ir::Type::kBool;
      truth = truth || there.truth;
      if (there.callee.Valid()) places.push_back(there);
    }
  }
  may_miss = may_miss && truth;
  return !places.empty();
}

void Binder::Letters(ir::ProgramId callee, std::vector<prove::BoundInput>& inputs) {
  if (!LevelSpace().Valid()) return;
  struct Given {
    char letter = 0;
    std::vector<double> seen;
  };
  std::map<std::uint32_t, Given> letters;  // by cell
  for (const ir::CallId id : calls_) {
    if (source_.calls[id].program != callee) continue;
    for (const ir::ArgId arg : source_.calls[id].args) {
      const ir::Arg& argument = source_.args[arg];
      if (argument.letter == 0) continue;
      Given& given = letters[argument.position];
      given.letter = argument.letter;
      const auto value = ConstantOf(source_, argument.value);
      if (value) given.seen.push_back(argument.increments ? *value * profile_.increment.Or(0.001) : *value);
    }
  }
  const bool keeps_letters = target_profile_.language == profile_.language;
  for (const std::uint32_t cell : CellsReadAtEntry(callee)) {
    if (letters.contains(cell)) continue;
    const std::vector<ir::BlockId> tests = EmptinessTests(callee, cell);
    if (is_call_ || (keeps_letters && !tests.empty())) {
      letters[cell].letter = dialects::LetterOfArgument(profile_, cell);
    } else {
      decided_.insert(decided_.end(), tests.begin(), tests.end());  // no call gives it
    }
  }
  if (is_call_) {
    for (const exec::EntryArgument& argument : run_.arguments) {
      if (argument.letter == 0) continue;
      Given& given = letters[argument.position];
      given.letter = argument.letter;
      if (!argument.value.IsVacant()) given.seen.push_back(argument.value.number);
    }
  }
  for (const auto& [cell, given] : letters) {
    prove::BoundInput bound;
    const char name = dialects::LetterOfArgument(profile_, cell);
    const std::string_view program = source_.View(source_.programs[callee].name);
    bound.input.name = name != 0 ? fmt::format("{}.{}", program, name) : fmt::format("{}.#{}", program, cell);
    ApplyRange(bound.input);
    bound.input.seen = given.seen;
    prove::InputPlace place;
    place.callee = callee;
    place.letter = given.letter;
    place.position = static_cast<std::uint16_t>(cell);
    bound.source.push_back(place);
    const std::vector<ir::BlockId> tests = EmptinessTests(callee, cell);
    bound.input.may_miss = !tests.empty();
    if (!LetterPlaces(callee, place, bound.target, bound.input.may_miss)) continue;
    if (!bound.input.may_miss) decided_.insert(decided_.end(), tests.begin(), tests.end());
    inputs.push_back(std::move(bound));
  }
}

void Binder::Cells(const ir::Machine& machine, std::vector<prove::BoundInput>& inputs) {
  const exec::Linked linked(source_, machine);
  exec::RunOptions options;
  options.entry = run_.entry;
  options.is_call = is_call_;
  options.max_blocks = 1'000'000;
  exec::NoEnvironment environment;
  prove::RecordedTrace trace;
  diag::Sink quiet;
  exec::Coverage coverage;
  exec::Run(linked, options, environment, trace, quiet, &coverage);
  for (const std::uint32_t packed : coverage.cells_read_before_written) {
    const ir::SpaceId space{packed >> 24U};
    const std::uint32_t cell = packed & 0xFFFFFFU;
    if (source_.spaces[space].visibility == ir::Visibility::kLevel) continue;  // letters, or empty
    prove::BoundInput bound;
    bound.input.name = fmt::format("{}{}", source_.View(source_.spaces[space].name), cell);
    ApplyRange(bound.input);
    prove::InputPlace place;
    place.space = space;
    place.cell = cell;
    bound.source.push_back(place);
    for (const ir::transform::CellMapping& mapping : translation_.cells) {
      if (mapping.source_space != space || cell < mapping.source_cell || cell >= mapping.source_cell + mapping.count)
        continue;
      const std::uint32_t home = mapping.first + cell - mapping.source_cell;
      for (const ir::SpaceId id : target_.spaces.Ids()) {
        const ir::Space& cells = target_.spaces[id];
        if (home < cells.first || home > cells.last) continue;
        prove::InputPlace there;
        there.space = id;
        there.cell = home;
        bound.target.push_back(there);
      }
    }
    inputs.push_back(std::move(bound));
  }
}

bool Binder::Relate(std::vector<prove::BoundInput>& inputs, diag::Sink& sink) const {
  if (config_ == nullptr) return true;
  bool ok = true;
  for (prove::BoundInput& bound : inputs) {
    const std::string_view name = bound.input.name;
    const std::size_t dot = name.find('.');
    const std::string_view program = dot == std::string_view::npos ? std::string_view{} : name.substr(0, dot + 1);
    const auto end = [&](const dialects::ValueRange& range, const std::string& of,
                         double added) -> std::optional<prove::RelatedEnd> {
      if (of.empty()) return std::nullopt;
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        const std::string_view other = inputs[i].input.name;
        if (&inputs[i] == &bound) continue;
        if (SameName(other, of) || SameName(other, std::string(program) + of)) return prove::RelatedEnd{i, added};
      }
      ok = false;
      sink.Report(diag::Code::kUnknownKey, range.at, of).help =
          fmt::format("{} takes its range from an input that this comparison has not", name);
      return std::nullopt;
    };
    for (const dialects::ValueRange& range : config_->ranges) {
      if (!SameName(range.name, name)) continue;
      bound.input.low_of = end(range, range.least_of, range.least);
      bound.input.high_of = end(range, range.most_of, range.most);
    }
  }
  return ok;
}

}  // namespace ncport::app
