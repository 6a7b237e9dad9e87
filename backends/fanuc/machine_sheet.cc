#include "backends/fanuc/machine_sheet.h"

#include <fmt/format.h>

#include "dialects/fanuc/mdi_tests.h"

namespace ncport::backends::fanuc {
namespace {

std::vector<std::string> Required(const dialects::Profile& profile) {
  static constexpr std::string_view kSeries[] = {"", "A", "B", "C", "M", "T"};
  std::vector<std::string> lines;
  if (profile.series.Known() && *profile.series != dialects::Series::kNone)
    lines.push_back(fmt::format("G codes of {} {}", profile.IsMazakLathe() ? "series" : "system",
                                kSeries[static_cast<std::size_t>(*profile.series)]));
  lines.emplace_back("the option custom macro (G65, variables, IF, GOTO)");
  if (profile.IsMazakLathe())
    lines.emplace_back(
        "main program and macros in the standard program area; run from memory, not from card or network");
  if (!profile.fanuc.control.Or("").empty()) lines.push_back("control " + *profile.fanuc.control);
  return lines;
}

/// Output without comments, one blank between the lines: what the machine reads.
std::string WordsOf(const std::vector<OutputFile>& files) {
  std::string words = " ";
  for (const OutputFile& file : files) {
    int depth = 0;
    for (const char c : file.text) {
      if (c == '(') ++depth;
      if (depth == 0) words.push_back(c == '\n' ? ' ' : c);
      if (c == ')' && depth > 0) --depth;
    }
  }
  return words;
}

}  // namespace

MachineSheet SheetOf(const dialects::Profile& profile, const std::vector<OutputFile>& files) {
  MachineSheet sheet;
  sheet.required = Required(profile);
  if (!profile.IsMazakLathe()) return sheet;
  const std::string words = WordsOf(files);
  const bool series_t = profile.series.Is(dialects::Series::kT);
  for (const dialects::fanuc::MdiTest& test : dialects::fanuc::MdiTests()) {
    if (series_t ? !test.series_t : !test.series_m) continue;
    if (words.find(test.marker) == std::string::npos) continue;
    MachineTest made;
    made.text = fmt::format("{}. Answer: {}", test.question, test.result);
    made.rule = fmt::format("mazak-lathe-11 {}, profile key {}", test.id, test.key);
    made.blocks.emplace_back(test.first);
    if (!test.second.empty()) made.blocks.emplace_back(test.second);
    sheet.tests.push_back(std::move(made));
  }
  return sheet;
}

}  // namespace ncport::backends::fanuc
