#include "check/rules.h"

namespace ncport::check {

namespace {

bool IsLetter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }
bool BeginsWithTwo(std::string_view name) { return name.size() >= 2 && IsLetter(name[0]) && IsLetter(name[1]); }

constexpr std::string_view kWanted = "a name that begins with two letters or _";

/// The second character of names, where the control wants a letter there too (sinumerik-2.4).
void CheckFirstCharacters(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  if (!subject.profile.names.first.Is(dialects::NameStart::kTwoLetters)) return;
  const ir::Module& module = subject.module;
  for (const ir::Variable& variable : module.variables.All()) {
    const std::string_view name = module.View(variable.name);
    if (variable.owner != program || BeginsWithTwo(name)) continue;
    sink.Report(diag::Code::kExpectedText, subject.PlaceOf(variable), kWanted, name);
  }
  for (const ir::BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    if (!block.label.Valid() || BeginsWithTwo(module.View(block.label))) continue;
    sink.ReportAs(diag::Severity::kWarning, diag::Code::kExpectedText, subject.PlaceOfLabel(id), kWanted,
                  module.View(block.label));
  }
}

}  // namespace

// Names of variables are measured where they are declared; these two have no declaration of their own.
void CheckNameLengths(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  // What small controls without declared names read of a name is not sure enough to refuse a program by it.
  if (subject.profile.names.max_length.Or(0) == 0) return;
  CheckFirstCharacters(subject, program, sink);
  const ir::Module& module = subject.module;
  const ir::Program& record = module.programs[program];
  const auto most_program = subject.profile.names.programs.Or(0);
  const bool by_name = subject.profile.names.program_form.Is(dialects::ProgramNaming::kName);
  const std::string_view name = module.View(record.name);
  // The name of a file may be another one on the control; a header is what the control reads.
  if (by_name && most_program > 0 && record.has_header && static_cast<std::int64_t>(name.size()) > most_program) {
    sink.Report(diag::Code::kNameTooLong, {record.file, record.header_line, 0, 0}, name, most_program).help =
        "the control cannot call the program by this name";
  }
  const auto most_label = subject.profile.names.labels.Or(0);
  if (most_label <= 0) return;
  for (const ir::BlockId id : record.blocks) {
    const ir::Block& block = module.blocks[id];
    if (!block.label.Valid()) continue;
    const std::string_view label = module.View(block.label);
    if (static_cast<std::int64_t>(label.size()) > most_label)
      sink.Report(diag::Code::kNameTooLong, subject.PlaceOfLabel(id), label, most_label);
  }
}

}  // namespace ncport::check
