#include "app/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

#include "dialects/machine.h"
#include "exec/link.h"
#include "frontend/reader.h"

namespace ncport::app {
namespace {

bool SameName(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::toupper(static_cast<unsigned char>(x)) == std::toupper(static_cast<unsigned char>(y));
         });
}

/// The output as a module of the target's language; added lines are marked.
bool ReadBack(const std::vector<backends::OutputFile>& files, const dialects::Profile& target, ir::Module& module,
              std::string& problem) {
  SourceFiles sources;
  diag::Sink sink;
  std::vector<FileId> ids;
  for (const backends::OutputFile& file : files) {
    const FileId id = sources.Add(!file.name.empty()       ? file.name
                                  : !file.reads_as.empty() ? file.reads_as
                                                           : "output",
                                  file.text);
    ids.push_back(id);
    if (!frontend::ReadFile(sources, id, target, {}, module, sink).Ok()) break;
  }
  if (!sink.HasErrors()) frontend::ResolveNames(sources, module, target, sink);
  for (const diag::Diagnostic& finding : sink.All()) {
    if (finding.severity != diag::Severity::kError) continue;
    problem = fmt::format("{} line {}: {}", finding.at.file.Valid() ? sources.Name(finding.at.file) : "output",
                          finding.at.line, finding.message);
    return false;
  }
  for (ir::Block& block : module.blocks.All()) {
    if (!block.origin.Valid()) continue;
    const ir::Origin& origin = module.origins[block.origin];
    const auto file = std::find(ids.begin(), ids.end(), origin.file);
    if (file == ids.end()) continue;
    const std::vector<std::uint32_t>& added = files[static_cast<std::size_t>(file - ids.begin())].added_lines;
    if (std::binary_search(added.begin(), added.end(), origin.line))
      block.flags = static_cast<std::uint8_t>(block.flags | ir::Block::kAdded);
  }
  return true;
}

ir::ProgramId FindByName(const ir::Module& module, std::string_view name) {
  for (const ir::ProgramId id : module.programs.Ids()) {
    const std::string_view known = module.View(module.programs[id].name);
    if (SameName(known, name) ||
        (known.size() > 1 && (known[0] == 'O' || known[0] == 'o') && SameName(known.substr(1), name)))
      return id;
  }
  return {};
}

class Binder {
 public:
  Binder(const ProgramSet& source, const backends::Translation& translation, const ir::Module& target,
         const dialects::Config* config)
      : source_(source.module), translation_(translation), target_(target), config_(config) {}

  std::vector<prove::BoundInput> Arguments(ir::ProgramId entry);
  void Cells(ir::ProgramId entry, const ir::Machine& machine, std::vector<prove::BoundInput>& inputs);
  /// Ends of ranges that are other inputs. A name that is none of them is a finding.
  bool Relate(std::vector<prove::BoundInput>& inputs, diag::Sink& sink) const;

 private:
  void ApplyRange(prove::Input& input) const {
    if (config_ == nullptr) return;
    for (const dialects::ValueRange& range : config_->ranges) {
      if (!SameName(range.name, input.name)) continue;
      if (range.least_of.empty()) input.low = range.least;
      if (range.most_of.empty()) input.high = range.most;
    }
  }

  const ir::Module& source_;
  const backends::Translation& translation_;
  const ir::Module& target_;
  const dialects::Config* config_;
};

std::vector<prove::BoundInput> Binder::Arguments(ir::ProgramId entry) {
  std::vector<prove::BoundInput> inputs;
  std::set<std::uint32_t> callees;
  const bool is_call = source_.programs[entry].kind == ir::ProgramKind::kSub;
  if (is_call) callees.insert(entry.value);
  std::vector<ir::CallId> calls;
  for (const ir::BlockId block : source_.programs[entry].blocks) {
    for (const ir::WordId id : source_.blocks[block].words) {
      const ir::Word& word = source_.words[id];
      if (word.op != ir::WordOp::kCall || !word.Extra<ir::CallId>().Valid()) continue;
      const ir::Call& call = source_.calls[word.Extra<ir::CallId>()];
      if (!call.program.Valid() || is_call) continue;
      callees.insert(call.program.value);
      calls.push_back(word.Extra<ir::CallId>());
    }
  }
  for (const std::uint32_t callee_value : callees) {
    const ir::ProgramId callee{callee_value};
    const ir::Program& program = source_.programs[callee];
    for (std::uint32_t i = 0; i < program.parameters.count; ++i) {
      const ir::Variable& variable = source_.variables[program.parameters[i]];
      if (variable.by_reference || variable.type == ir::Type::kString) continue;
      prove::BoundInput bound;
      bound.input.name = fmt::format("{}.{}", source_.View(program.name), source_.View(variable.name));
      bound.input.integer = variable.type != ir::Type::kReal;
      bound.input.boolean = variable.type == ir::Type::kBool;
      ApplyRange(bound.input);
      for (const ir::CallId id : calls) {
        if (source_.calls[id].program != callee) continue;
        for (const ir::ArgId arg : source_.calls[id].args) {
          const ir::Arg& given = source_.args[arg];
          if (given.position != i || !given.value.Valid()) continue;
          ir::ExprId value = given.value;
          double sign = 1;
          while (true) {
            const ir::Expr& expr = source_.exprs[value];
            if (expr.op == ir::ExprOp::kNegate) sign = -sign;
            if (expr.op != ir::ExprOp::kGroup && expr.op != ir::ExprOp::kNegate && expr.op != ir::ExprOp::kPlus &&
                expr.op != ir::ExprOp::kConvert)
              break;
            value = ir::ExprId{expr.a};
          }
          if (source_.exprs[value].op == ir::ExprOp::kLiteral)
            bound.input.seen.push_back(sign * source_.exprs[value].number);
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
      for (const ir::transform::CellMapping& mapping : translation_.cells) {
        if (mapping.letter == 0 || !SameName(mapping.source, source_.View(variable.name))) continue;
        const auto name =
            std::find_if(translation_.programs.begin(), translation_.programs.end(),
                         [&](const backends::ProgramName& known) { return known.program == mapping.program; });
        if (name == translation_.programs.end()) continue;
        const std::string_view whole = source_.View(program.name);
        const bool part = SameName(name->source, whole) ||
                          (name->source.starts_with(whole) && name->source.substr(whole.size()).starts_with('_'));
        if (!part) continue;
        prove::InputPlace there;
        there.callee = FindByName(target_, name->target);
        there.letter = mapping.letter;
        if (there.callee.Valid()) bound.target.push_back(there);
      }
      inputs.push_back(std::move(bound));
    }
  }
  return inputs;
}

/// Cells that the source reads before anything writes them: the operator's inputs.
void Binder::Cells(ir::ProgramId entry, const ir::Machine& machine, std::vector<prove::BoundInput>& inputs) {
  const exec::Linked linked(source_, machine);
  exec::RunOptions options;
  options.entry = entry;
  options.is_call = source_.programs[entry].kind == ir::ProgramKind::kSub;
  options.max_blocks = 1'000'000;
  exec::NoEnvironment environment;
  prove::RecordedTrace trace;
  diag::Sink quiet;
  exec::Coverage coverage;
  exec::Run(linked, options, environment, trace, quiet, &coverage);
  for (const std::uint32_t packed : coverage.cells_read_before_written) {
    const ir::SpaceId space{packed >> 24U};
    const std::uint32_t cell = packed & 0xFFFFFFU;
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

prove::Maps MapsOf(const ir::Module& source, const backends::Translation& translation, bool separate_registers) {
  prove::Maps maps;
  for (const ir::BlockId id : source.blocks.Ids()) {
    const ir::OriginId origin = source.blocks[id].origin;
    if (!origin.Valid()) continue;
    for (const backends::BlockPlace& place : translation.split_rapids) {
      if (source.origins[origin].file == place.file && source.origins[origin].line == place.line)
        maps.split_rapids.push_back(id.value);
    }
  }
  maps.tools_mapped = !translation.tools.empty();
  for (const backends::ToolUse& use : translation.tools) {
    prove::ToolPair pair;
    pair.source_name = use.source_name;
    pair.source_tool = use.source_tool;
    pair.source_edge = use.source_edge;
    pair.target_tool = use.target_tool;
    pair.target_offset = use.target_offset;
    pair.target_radius = use.target_radius;
    pair.source_radius = use.source_radius;
    pair.target_name = use.target_name;
    maps.tools.push_back(pair);
  }
  for (const backends::OffsetUse& use : translation.offsets) {
    maps.work_offsets.push_back({use.source, use.target, use.source_extension, use.target_extension});
  }
  for (const backends::AuxUse& use : translation.aux) maps.aux.push_back({use.source, use.target});
  maps.separate_registers = separate_registers;
  maps.tool_change_added = translation.tool_change_added;
  maps.messages_lost = translation.messages_lost;
  maps.path_lost = translation.path_lost;
  return maps;
}

prove::Precision PrecisionOf(const dialects::Profile& profile, const ir::Machine& machine) {
  prove::Precision precision;
  precision.word_error = machine.word_error;
  precision.increment = profile.increment.Or(machine.increment);
  precision.diameter_axis = machine.transverse_axis;
  return precision;
}

}  // namespace

prove::Verification CompareTranslation(Context& context, const ProgramSet& source, const ir::Machine& source_machine,
                                       ir::ProgramId entry, const dialects::Profile& to,
                                       const backends::Translation& translation,
                                       const std::vector<backends::OutputFile>& files, const dialects::Config* config,
                                       const ComparisonSetup& setup, std::vector<prove::Input>& inputs) {
  const dialects::Profile target = backends::ForReading(to);
  prove::Verification result;
  ir::Module module;
  std::string problem;
  if (!ReadBack(files, target, module, problem)) {
    result.not_compared = "the output could not be read back: " + problem;
    return result;
  }
  const ir::Machine target_machine = dialects::MachineFor(target);
  const std::string_view entry_name = source.module.View(source.module.programs[entry].name);
  ir::ProgramId target_entry;
  for (const backends::ProgramName& name : translation.programs) {
    if (name.source == entry_name) target_entry = FindByName(module, name.target);
  }
  if (!target_entry.Valid()) {
    result.not_compared = "the output has no program for the one that is run";
    return result;
  }
  Binder binder(source, translation, module, config);
  std::vector<prove::BoundInput> bound;
  if (setup.vary_inputs) bound = binder.Arguments(entry);
  binder.Cells(entry, source_machine, bound);
  if (!binder.Relate(bound, context.findings)) {
    result.not_compared = "a range refers to an input that does not exist";
    return result;
  }
  if (!setup.vary_inputs) {
    for (prove::BoundInput& input : bound) input.input.low = input.input.high = 0;
  }
  for (const prove::BoundInput& input : bound) inputs.push_back(input.input);

  prove::VerifyOptions options;
  options.runs = setup.runs;
  options.seed = setup.seed;
  if (!setup.vary_inputs) options.runs = options.least_runs = 1;
  options.max_blocks = setup.max_blocks;
  options.poison_distance = !target.words.absolute.Or("").empty();
  options.compare.source = PrecisionOf(source.profile, source_machine);
  options.compare.target = PrecisionOf(target, target_machine);
  options.compare.maps = MapsOf(source.module, translation, !target.IsLathe());
  if (target.language == dialects::Language::kSinumerik) {
    options.compare.maps.separate_registers = false;
    options.compare.maps.source_registers =
        source.profile.language == dialects::Language::kFanuc && !source.profile.IsLathe();
  }
  options.compare.maps.cross_language = source.profile.language != target.language;
  options.target_skip_shift = static_cast<int>(target.skip.Or(0) - source.profile.skip.Or(0));
  for (const ir::SpaceId space : module.spaces.Ids()) {
    if (module.spaces[space].lifetime == ir::Lifetime::kKept) options.garbage.push_back(space);
  }
  for (const ir::transform::CellMapping& mapping : translation.cells) {
    if (mapping.outlives && mapping.count == 1)
      options.final_values.emplace_back(mapping.source,
                                        mapping.target.empty() ? fmt::format("#{}", mapping.first) : mapping.target);
  }
  prove::Side a{&source.module, &source_machine, entry, source.module.programs[entry].kind == ir::ProgramKind::kSub};
  prove::Side b{&module, &target_machine, target_entry, a.is_call};
  return prove::Verify(a, b, bound, options, context.findings);
}

}  // namespace ncport::app
