#include "app/flatten_report.h"

#include <fmt/format.h>

#include <set>

#include "app/source_hash.h"
#include "dialects/machine.h"
#include "ir/analysis/tool_change.h"
#include "ir/axis_names.h"

namespace ncport::app {
namespace {

std::vector<std::string> Required(const dialects::Profile& target) {
  std::vector<std::string> lines;
  const bool inch = target.units.Is(dialects::LengthUnit::kInch);
  lines.push_back(fmt::format("{} as the unit of lengths, absolute dimensions", inch ? "inch" : "millimetre"));
  lines.push_back(fmt::format("numbers with a decimal point count {}, with {} decimals",
                              inch ? "inches" : "millimetres", target.decimals.Or(inch ? 4 : 3)));
  if (target.IsLathe()) {
    lines.push_back(
        fmt::format("words of X are {}", target.diameter.Is(dialects::DiameterRule::kNo) ? "radii" : "diameters"));
  }
  return lines;
}

std::vector<ReportPair> PairsOf(const std::vector<backends::iso::FlatUse>& uses) {
  std::vector<ReportPair> pairs;
  for (const backends::iso::FlatUse& use : uses)
    pairs.push_back({use.source, use.target, use.target.empty() ? "left out" : ""});
  return pairs;
}

std::string AxesText(std::uint16_t axes) {
  std::string text;
  for (std::size_t axis = 0; axis < ir::kAxisLetters.size(); ++axis) {
    if ((axes >> axis & 1U) != 0) text += ir::kAxisLetters[axis];
  }
  return text;
}

}  // namespace

std::string_view RapidWay(const dialects::Profile& profile) {
  switch (profile.rapid.Or(ir::Rapid::kUnknown)) {
    case ir::Rapid::kStraight:
      return "straight";
    case ir::Rapid::kDogleg:
      return "axis by axis";
    case ir::Rapid::kUnknown:
      break;
  }
  return "unknown";
}

bool RapidsMayDiffer(const dialects::Profile& source, const dialects::Profile& target) {
  const ir::Rapid a = source.rapid.Or(ir::Rapid::kUnknown);
  const ir::Rapid b = target.rapid.Or(ir::Rapid::kUnknown);
  return a != b || a == ir::Rapid::kUnknown;
}

Report FlattenReport(const Context& context, const ProgramSet& set, const dialects::Profile& target,
                     const FlattenOptions& options, const backends::iso::FlatRecord& record) {
  Report report;
  report.command = "flatten";
  report.version = std::string(Version());
  report.from = set.profile.name;
  report.to = target.name;
  std::set<std::uint32_t> files;
  for (const ir::Program& program : set.module.programs.All()) {
    if (program.file.Valid() && !program.library && files.insert(program.file.value).second)
      report.sources.emplace_back(context.files.Name(program.file));
  }
  report.source_hash = fmt::format("{:016X}", HashOf(context.files, set.module));
  report.required = Required(target);
  report.tools = PairsOf(record.tools);
  report.offsets = PairsOf(record.offsets);
  report.functions = PairsOf(record.functions);
  const auto output_at = [&](std::uint64_t line) { return ReportPlace{options.output_name, line, 0}; };
  for (const backends::iso::FlatLoss& loss : record.losses)
    report.losses.push_back({loss.what, PlaceForReport(loss.source, context.files), output_at(loss.line)});
  for (const backends::iso::FlatRapid& rapid : record.rapids) {
    ReportPlace source;
    if (rapid.block.Valid()) source = PlaceForReport(set.module.RangeOf(set.module.blocks[rapid.block]), context.files);
    report.rapids.push_back({std::move(source), output_at(rapid.line), AxesText(rapid.axes)});
  }
  report.rapid_paths = fmt::format("{} -> {}", RapidWay(set.profile), RapidWay(target));
  for (const std::string& assumption : record.assumptions) report.assumptions.push_back({assumption, "", {}});
  if (ir::analysis::WhenToolsChange(set.module, dialects::MachineFor(set.profile)) ==
      ir::analysis::ToolChange::kAssumedAtToolWord) {
    report.assumptions.push_back(
        {"the T word of the source changes the tool by itself", "sinumerik-8.8", {"T1", "G4 F1"}});
  }
  report.comparison.emplace_back(
      "the flat program holds one run of the source with the values below; other values need another run");
  if (!options.call.empty()) report.comparison.push_back("call " + options.call);
  for (const std::string& value : options.set) report.comparison.push_back("set " + value);
  if (!options.start.empty()) report.comparison.push_back("start " + options.start);
  return report;
}

}  // namespace ncport::app
