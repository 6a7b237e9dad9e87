// Programs of one name.
#include <map>
#include <string>
#include <utility>

#include "check/rules.h"

namespace ncport::check {

void CheckDoublePrograms(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  // A main program and a subprogram may share a name where names tell programs; a number is one program.
  const bool by_name = subject.profile.names.program_form.Is(dialects::ProgramNaming::kName);
  std::map<std::pair<std::string, bool>, ir::ProgramId> first;
  for (const ir::ProgramId id : module.programs.Ids()) {
    const ir::Program& program = module.programs[id];
    const std::string_view name = module.View(program.name);
    if (program.library || name.empty()) continue;
    const bool main = by_name && program.kind == ir::ProgramKind::kMain;
    const auto [known, added] = first.emplace(std::pair{subject.KeyOf(name), main}, id);
    // An archive holds several folders.
    if (added || (by_name && module.programs[known->second].file == program.file)) continue;
    const auto place = [&](ir::ProgramId of) {
      const ir::Program& record = module.programs[of];
      return SourceRange{record.file, record.header_line != 0 ? record.header_line : 1, 0, 0};
    };
    diag::Diagnostic& finding =
        sink.ReportAs(diag::Severity::kWarning, diag::Code::kDoubleName, place(id), "program " + std::string(name));
    finding.notes.push_back({place(known->second), "it begins here too; calls take one of them"});
    finding.help = "give the files of one machine only";
  }
}

}  // namespace ncport::check
