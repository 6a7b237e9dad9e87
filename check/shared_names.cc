#include <string>
#include <unordered_map>

#include "check/rules.h"

namespace ncport::check {

void CheckSharedNames(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  std::unordered_map<std::string, ir::ProgramId> programs;
  for (const ir::ProgramId id : module.programs.Ids()) {
    if (!module.programs[id].library) programs.emplace(subject.KeyOf(module.View(module.programs[id].name)), id);
  }
  ir::ProgramId of_labels;  // whose labels are in the table
  std::unordered_map<std::string, ir::BlockId> labels;
  for (const ir::VariableId id : module.variables.Ids()) {
    const ir::Variable& variable = module.variables[id];
    if (!variable.owner.Valid() || module.programs[variable.owner].library) continue;
    if (of_labels != variable.owner) {
      of_labels = variable.owner;
      labels.clear();
      for (const ir::BlockId block : module.programs[variable.owner].blocks) {
        const StringId label = module.blocks[block].label;
        if (label.Valid()) labels.emplace(subject.KeyOf(module.View(label)), block);
      }
    }
    const std::string key = subject.KeyOf(module.View(variable.name));
    if (const auto label = labels.find(key); label != labels.end()) {
      diag::Diagnostic& finding =
          sink.Report(diag::Code::kSharedName, subject.PlaceOf(variable), module.View(variable.name), "label");
      finding.notes.push_back({subject.PlaceOfLabel(label->second), "the label stands here"});
      finding.help = "a name means one thing only: rename one of them";
    } else if (programs.contains(key)) {
      sink.Report(diag::Code::kSharedName, subject.PlaceOf(variable), module.View(variable.name), "program").help =
          "a name means one thing only: rename one of them";
    }
  }
}

}  // namespace ncport::check
