#include "app/translation_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "app/source_hash.h"
#include "base/letter_case.h"

namespace ncport::app {
namespace {

std::string FileNameOf(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}

/// Name of the source program that a program is, or a part of.
std::string_view WholeOf(const backends::Translation& translation, const backends::ProgramName& part) {
  for (const backends::ProgramName& name : translation.programs) {
    if (name.program == part.whole) return name.source;
  }
  return part.source;
}

std::string RangeOfInput(const std::vector<prove::Input>& inputs, std::string_view program,
                         std::string_view parameter) {
  const std::string name = fmt::format("{}.{}", program, parameter);
  for (const prove::Input& input : inputs) {
    if (EqualIgnoringCase(input.name, name) && input.low && input.high)
      return fmt::format(" {:g} TO {:g}", *input.low, *input.high);
  }
  return {};
}

}  // namespace

std::string SummaryOf(const prove::Verification& verification, const std::vector<prove::Input>& inputs) {
  std::string text;
  if (verification.difference) {
    text = fmt::format("DIFFERENT after {} parameter sets: {}\n", verification.sets_run, verification.difference->what);
  } else if (!verification.compared) {
    text = fmt::format("NOT COMPARED: {}\n", verification.not_compared);
  } else {
    text = "EQUAL: source and translation made the machine do the same.\n";
  }
  text += fmt::format(
      "  {} distinct parameter sets over {} inputs; {} moved and were counted, {} alarmed on both sides before any "
      "motion\n",
      verification.sets_run, inputs.size(), verification.sets_counted, verification.alarms_agreed);
  text += fmt::format("  {} sets aimed at exact multiples; each set once more from a poisoned start\n",
                      verification.exact_multiples);
  text += fmt::format("  {} of {} branches of the source taken; {} events compared, the longest run had {}\n",
                      verification.branches_taken, verification.branches, verification.events_compared,
                      verification.longest_trace);
  if (verification.centers_moved > 0)
    text += fmt::format("  {} times an arc's centre moved along its chord: its rounded words leave two radii\n",
                        verification.centers_moved);
  if (verification.branches_listed > 0)
    text += fmt::format("  {} of the others ask whether a letter is given, which the calls of this program decide\n",
                        verification.branches_listed);
  return text;
}

std::vector<backends::ProgramHeader> HeadersOf(const Context& context, const ProgramSet& source,
                                               const dialects::Profile& target,
                                               const backends::Translation& translation,
                                               const prove::Verification* verification,
                                               const std::vector<prove::Input>& inputs) {
  std::vector<backends::ProgramHeader> headers;
  bool first = true;
  for (const backends::ProgramName& name : translation.programs) {
    backends::ProgramHeader header{name.program, {}};
    std::vector<std::string>& lines = header.lines;
    if (first) {
      lines.push_back(fmt::format("NCPORT {} FROM {} TO {}", Version(), source.profile.name, FileNameOf(target.name)));
      std::string files;
      for (const FileId file : source.inputs) files += " " + FileNameOf(context.files.Name(file));
      lines.push_back(fmt::format("SOURCE{} HASH {:016X}", files, HashOf(context.files, source.module)));
      for (const std::string& required : translation.required) lines.push_back("REQUIRES " + required);
      for (const backends::ProgramName& program : translation.programs)
        lines.push_back(fmt::format("PROGRAM {} = {}", program.source, program.target));
      for (const backends::AlarmUse& alarm : translation.alarms)
        lines.push_back(fmt::format("ALARM {} = {}", alarm.source, alarm.target_words));
      for (const backends::ToolUse& tool : translation.tools)
        lines.push_back(fmt::format("TOOL {} = {}", tool.source_words, tool.target_words));
      for (const backends::OffsetUse& offset : translation.offsets) {
        lines.push_back(fmt::format("WORK OFFSET G{} = G{}{}", offset.source, offset.target,
                                    offset.target_extension == 0 ? "" : fmt::format(" P{}", offset.target_extension)));
      }
      for (const ir::transform::CellMapping& cell : translation.cells) {
        if (cell.common) lines.push_back(fmt::format("{} = {}", cell.target, cell.source));
      }
      if (translation.stopped_blocks != 0)
        lines.push_back(
            fmt::format("NOT COMPLETE: {} BLOCKS ARE ALARMS, SEE -NOT TRANSLATED-", translation.stopped_blocks));
      if (verification == nullptr) {
        lines.emplace_back("NOT COMPARED: --verify WAS NOT ASKED FOR");
      } else {
        lines.push_back(fmt::format("COMPARED: {} PARAMETER SETS, {} OF {} BRANCHES, NO DIFFERENCE",
                                    verification->sets_counted, verification->branches_taken, verification->branches));
      }
      for (const std::string& assumption : translation.assumptions) lines.push_back("ASSUMED: " + assumption);
      std::set<std::string> lost;
      for (const backends::Loss& loss : translation.losses)
        lost.insert(loss.what.substr(0, loss.what.find(' ')) + (loss.left_out ? ", LEFT OUT" : ", KEPT AS COMMENT"));
      for (const std::string& what : lost) lines.push_back("LOST: " + what);
      for (const std::string& added : translation.added) lines.push_back("ADDED: " + added);
    }
    for (const ir::transform::CellMapping& cell : translation.cells) {
      if (cell.program != name.program || cell.common) continue;
      if (cell.letter != 0) {
        lines.push_back(fmt::format("{} = {} = {}{}", cell.letter, cell.target, cell.source,
                                    RangeOfInput(inputs, WholeOf(translation, name), cell.source)));
      } else {
        lines.push_back(fmt::format("{} = {}", cell.target, cell.source));
      }
    }
    first = false;
    headers.push_back(std::move(header));
  }
  return headers;
}

}  // namespace ncport::app
