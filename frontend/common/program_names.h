// Programs of a module by name. Searching them one by one for each call makes a folder of programs quadratic.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "ir/module.h"

namespace ncport::frontend {

class ProgramNames {
 public:
  /// Of the programs that the module holds now.
  explicit ProgramNames(const ir::Module& module);
  /// The first program of that name without regard to case, as Module::FindProgram gives it; invalid = none.
  [[nodiscard]] ir::ProgramId Find(std::string_view name) const;

 private:
  std::unordered_map<std::string, ir::ProgramId> by_name_;  // upper case
};

}  // namespace ncport::frontend
