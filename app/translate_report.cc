#include "app/translate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/source_hash.h"
#include "app/translation_header.h"
#include "base/letter_case.h"

namespace ncport::app {
namespace {

std::vector<std::string> Required(const TranslateReportInput& input, const backends::MachineSheet& sheet) {
  const dialects::Profile& target = input.target;
  std::vector<std::string> lines = sheet.required;
  lines.push_back(fmt::format("lengths in {}, written with a decimal point, computed ones with {} decimals",
                              target.units.Is(dialects::LengthUnit::kInch) ? "inch" : "mm", target.decimals.Or(3)));
  if (target.increment.Known()) lines.push_back(fmt::format("least input increment {:g}", *target.increment));
  if (target.IsLathe())
    lines.push_back(
        fmt::format("words of X are {}", target.diameter.Is(dialects::DiameterRule::kNo) ? "radii" : "diameters"));
  for (const std::string& required : input.translation.required) lines.push_back(required);
  return lines;
}

/// An end of a declared range as it was written: `20`, `EXTD-1`.
std::string RangeEnd(double value, const std::string& of) {
  if (of.empty()) return fmt::format("{:g}", value);
  return value == 0 ? of : fmt::format("{}{:+g}", of, value);
}

void AddCells(const TranslateReportInput& input, Report& report) {
  for (const ir::transform::CellMapping& cell : input.translation.cells) {
    const auto program = std::find_if(input.translation.programs.begin(), input.translation.programs.end(),
                                      [&](const backends::ProgramName& name) { return name.program == cell.program; });
    const std::string owner = program == input.translation.programs.end() ? std::string() : program->target;
    const std::string& place = cell.target;
    if (cell.letter == 0) {
      report.variables.push_back(
          {cell.source, place, cell.common ? "common to all programs" : fmt::format("local of {}", owner)});
      continue;
    }
    ReportParameter parameter;
    parameter.program = owner;
    parameter.letter = fmt::format("{} ({})", cell.letter, place);
    parameter.source = cell.source;
    for (const dialects::ValueRange& range : input.config.ranges) {
      const std::string_view name = std::string_view(range.name).substr(std::string_view(range.name).rfind('.') + 1);
      if (!EqualIgnoringCase(name, cell.source)) continue;
      parameter.low = RangeEnd(range.least, range.least_of);
      parameter.high = RangeEnd(range.most, range.most_of);
    }
    report.parameters.push_back(std::move(parameter));
  }
}

}  // namespace

Report TranslateReport(const TranslateReportInput& input) {
  const backends::Translation& translation = input.translation;
  Report report;
  report.command = "translate";
  report.version = std::string(Version());
  report.from = input.source.profile.name;
  report.to = input.target.name;
  std::set<std::uint32_t> files;
  for (const ir::Program& program : input.source.module.programs.All()) {
    if (program.file.Valid() && !program.library && files.insert(program.file.value).second)
      report.sources.emplace_back(input.context.files.Name(program.file));
  }
  report.source_hash = fmt::format("{:016X}", HashOf(input.context.files, input.source.module));
  const backends::MachineSheet sheet = backends::SheetOf(input.target, input.files);
  report.required = Required(input, sheet);
  for (const backends::ProgramName& name : translation.programs)
    report.programs.push_back({name.source, name.target, name.main ? "main program" : "called"});
  AddCells(input, report);
  for (const backends::ToolUse& tool : translation.tools)
    report.tools.push_back({tool.source_words, tool.target_words, ""});
  for (const backends::OffsetUse& offset : translation.offsets)
    report.offsets.push_back(
        {fmt::format("G{}", offset.source),
         fmt::format("G{}{}", offset.target,
                     offset.target_extension == 0 ? "" : fmt::format(" P{}", offset.target_extension)),
         ""});
  for (const backends::AuxUse& aux : translation.aux)
    report.functions.push_back({fmt::format("M{}", aux.source), aux.target ? fmt::format("M{}", *aux.target) : "",
                                aux.target ? "" : "left out, as [mcodes] says"});
  for (const backends::AlarmUse& alarm : translation.alarms)
    report.alarms.push_back({fmt::format("{}", alarm.source), fmt::format("{}", alarm.target), ""});
  if (input.verification == nullptr) {
    report.comparison.emplace_back("NOT COMPARED: --verify was not asked for");
  } else {
    const std::string summary = SummaryOf(*input.verification, input.inputs);
    for (std::size_t at = 0; at < summary.size();) {
      const std::size_t end = std::min(summary.find('\n', at), summary.size());
      std::string line = summary.substr(at, end - at);
      line.erase(0, line.find_first_not_of(' '));
      if (!line.empty()) report.comparison.push_back(std::move(line));
      at = end + 1;
    }
  }
  if (translation.stopped_blocks != 0)
    report.comparison.push_back(
        fmt::format("NOT COMPLETE: {} blocks of the source are alarms in the output", translation.stopped_blocks));
  for (const backends::Loss& loss : translation.losses)
    report.losses.push_back({loss.what, PlaceForReport(loss.at, input.context.files), {}});
  report.added = translation.added;
  for (const std::string& assumption : translation.assumptions) report.assumptions.push_back({assumption, "", {}});
  for (const backends::MachineTest& test : sheet.tests)
    report.assumptions.push_back({test.text, test.rule, test.blocks});
  return report;
}

}  // namespace ncport::app
