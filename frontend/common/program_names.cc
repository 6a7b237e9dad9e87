#include "frontend/common/program_names.h"

#include "base/letter_case.h"

namespace ncport::frontend {

ProgramNames::ProgramNames(const ir::Module& module) {
  by_name_.reserve(module.programs.Size());
  for (const ir::ProgramId id : module.programs.Ids())
    by_name_.emplace(UpperOf(module.View(module.programs[id].name)), id);
}

ir::ProgramId ProgramNames::Find(std::string_view name) const {
  const auto found = by_name_.find(UpperOf(name));
  return found == by_name_.end() ? ir::ProgramId{} : found->second;
}

}  // namespace ncport::frontend
