#include "app/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/bind_inputs.h"
#include "dialects/machine.h"
#include "frontend/reader.h"

namespace ncport::app {
namespace {

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

prove::Maps MapsOf(const ir::Module& source, const backends::Translation& translation) {
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
    pair.target_suffix = use.target_suffix;
    pair.target_offset = use.target_offset;
    pair.target_radius = use.target_radius;
    pair.source_radius = use.source_radius;
    pair.target_name = use.target_name;
    maps.offset_words = maps.offset_words || use.offset_only;
    maps.tools.push_back(pair);
  }
  for (const backends::OffsetUse& use : translation.offsets) {
    maps.work_offsets.push_back({use.source, use.target, use.source_extension, use.target_extension});
  }
  for (const backends::AuxUse& use : translation.aux) maps.aux.push_back({use.source, use.target});
  maps.tool_change_added = translation.tool_change_added;
  maps.messages_lost = translation.messages_lost;
  maps.path_lost = translation.path_lost;
  return maps;
}

/// A computed S that the control rounds to a whole number: half of one is its error.
bool RoundsSpeeds(const ir::Module& module) {
  return std::ranges::any_of(module.words.All(), [](const ir::Word& word) {
    return word.op == ir::WordOp::kSpeed && (word.flags & ir::Word::kRoundsValue) != 0;
  });
}

prove::Precision PrecisionOf(const dialects::Profile& profile, const ir::Machine& machine) {
  prove::Precision precision;
  precision.word_error = machine.word_error;
  precision.increment = profile.increment.Or(machine.increment);
  precision.diameter_axis = machine.transverse_axis;
  if (machine.arc_center_corrected) precision.center_moves = machine.circle_tolerance;
  return precision;
}

}  // namespace

prove::Verification CompareTranslation(Context& context, const ProgramSet& source, const ir::Machine& source_machine,
                                       const exec::RunOptions& run, const dialects::Profile& to,
                                       const backends::Translation& translation,
                                       const std::vector<backends::OutputFile>& files, const dialects::Config* config,
                                       const ComparisonSetup& setup, std::vector<prove::Input>& inputs) {
  const dialects::Profile target = backends::ForReading(to);
  const ir::ProgramId entry = run.entry;
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
  Binder binder(source, translation, module, target, config, run);
  std::vector<prove::BoundInput> bound;
  if (setup.vary_inputs) bound = binder.Arguments();
  binder.Cells(source_machine, bound);
  if (!binder.Relate(bound, context.findings)) {
    result.not_compared = "a range refers to an input that does not exist";
    return result;
  }
  if (!setup.vary_inputs) {
    for (prove::BoundInput& input : bound) input.input.low = input.input.high = 0;
  }
  for (const prove::BoundInput& input : bound) inputs.push_back(input.input);

  prove::VerifyOptions options;
  options.listed_branches = binder.DecidedBranches();
  options.runs = setup.runs;
  options.seed = setup.seed;
  if (!setup.vary_inputs) options.runs = options.least_runs = 1;
  options.max_blocks = setup.max_blocks;
  options.poison_distance = !target.words.absolute.Or("").empty();
  options.compare.tolerance = setup.tolerance;
  options.compare.source = PrecisionOf(source.profile, source_machine);
  options.compare.target = PrecisionOf(target, target_machine);
  if (RoundsSpeeds(module)) options.compare.target.speed_error = 0.5;
  // A computed word is written with fewer decimals where the increment of the machine is not sure (mazak-lathe-7).
  const double last = std::pow(10.0, -static_cast<double>(target.decimals.Or(3)));
  options.compare.target.increment = std::max(options.compare.target.increment, last);
  options.compare.maps = MapsOf(source.module, translation);
  const dialects::ToolAddressing tools = target.Tools();
  options.compare.maps.separate_registers = tools == dialects::ToolAddressing::kRegisters;
  options.compare.maps.source_registers =
      tools == dialects::ToolAddressing::kEdges && source.profile.Tools() == dialects::ToolAddressing::kRegisters;
  options.compare.maps.cross_language = source.profile.language != target.language;
  options.target_skip_shift = static_cast<int>(target.skip.Or(0) - source.profile.skip.Or(0));
  for (const ir::SpaceId space : module.spaces.Ids()) {
    if (module.spaces[space].lifetime == ir::Lifetime::kKept) options.garbage.push_back(space);
  }
  for (const ir::transform::CellMapping& mapping : translation.cells) {
    if (mapping.outlives && mapping.count == 1) options.final_values.emplace_back(mapping.source, mapping.target);
  }
  prove::Side a;
  a.module = &source.module;
  a.machine = &source_machine;
  a.entry = entry;
  a.is_call = source.module.programs[entry].kind == ir::ProgramKind::kSub;
  if (run.start_position_known) {
    a.start_axes = run.start_axes;
    std::copy(std::begin(run.start_position), std::end(run.start_position), a.start_position);
  } else if (a.is_call && !source.profile.IsLathe()) {
    // A subprogram without its callers: the tool stands somewhere, and moves and cycles may start from there.
    constexpr std::uint16_t kXYZ = 7;
    constexpr double kAbove = 100;
    a.start_axes = kXYZ;
    a.start_position[2] = kAbove;
  }
  if (config != nullptr) a.entry_state = config->entry;
  prove::Side b = a;
  b.module = &module;
  b.machine = &target_machine;
  b.entry = target_entry;
  return prove::Verify(a, b, bound, options, context.findings);
}

}  // namespace ncport::app
