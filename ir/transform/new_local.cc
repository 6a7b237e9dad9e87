#include "ir/transform/new_local.h"

#include <fmt/format.h>

#include <string>

namespace ncport::ir::transform {

namespace {

bool IsKnown(const Module& module, ProgramId program, std::string_view name) {
  for (const Variable& variable : module.variables.All()) {
    if (module.View(variable.name) != name) continue;
    if (!variable.owner.Valid() || variable.owner == program) return true;
  }
  return false;
}

}  // namespace

VariableId NewLocal(Module& module, ProgramId program, std::string_view name, Type type) {
  std::string wanted(name);
  for (int n = 2; IsKnown(module, program, wanted); ++n) wanted = fmt::format("{}_{}", name, n);
  Variable variable;
  variable.name = module.strings.Intern(wanted);
  variable.type = type;
  variable.scope = Scope::kLocal;
  variable.owner = program;
  variable.file = module.programs[program].file;
  return module.variables.Add(variable);
}

}  // namespace ncport::ir::transform
