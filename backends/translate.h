// The writers of all languages: a module becomes one that the target can say, and text.
#pragma once

#include <string>
#include <vector>

#include "backends/common/machine_sheet.h"
#include "backends/common/translation.h"
#include "base/diag/sink.h"
#include "dialects/config.h"
#include "dialects/profile.h"
#include "ir/machine.h"

namespace ncport::backends {

struct TranslateInput {
  const ir::Module* source = nullptr;  // names resolved
  const dialects::Profile* from = nullptr;
  const ir::Machine* source_machine = nullptr;  // MachineFor(*from)
  const dialects::Profile* to = nullptr;
  const dialects::Config* config = nullptr;  // may be null
  bool keep_increments =
      false;  // increments stay increments where the target has words for them, though it rounds each
};

/// Comment lines that stand behind the title of a program.
struct ProgramHeader {
  ir::ProgramId program;
  std::vector<std::string> lines;
};

/// A file to write.
struct OutputFile {
  std::string name;  // "4001.EIA"; empty: the text has one file only, named by the user
  std::string text;
  std::string reads_as;                    // name under which a text without name is read back; empty: any
  std::vector<std::uint32_t> added_lines;  // 1-based, ascending
  std::vector<ir::BlockId> line_blocks;    // block of Translation::module a line shows; by line - 1, may be invalid
};

/// Number of the alarm that stands for a block that was not translated, as the source would say it.
inline constexpr std::uint32_t kStopAlarm = 900;
/// The words of such a block in the target: an alarm that the operator cannot run past.
std::vector<ir::Word> StopWords(const dialects::Profile& to, ir::Module& module);

/// Rewrites the module for the target. Fails after findings: each place that has no form is one.
bool Raise(const TranslateInput& input, Translation& translation, diag::Sink& sink);
/// For the sheet that goes to the machine with `files`.
MachineSheet SheetOf(const dialects::Profile& to, const std::vector<OutputFile>& files);
/// The profile under which the output is read back. Settings that it leaves open and that the output serves whichever
/// way they are have one of their answers.
dialects::Profile ForReading(const dialects::Profile& to);
/// The raised module as text, with comment lines at the head of its programs.
std::vector<OutputFile> Print(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers);

}  // namespace ncport::backends
