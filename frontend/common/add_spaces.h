// The numbered variable spaces of a profile as records of the module.
#pragma once

#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::frontend {

/// Adds those that the module does not hold yet.
void AddSpaces(const dialects::Profile& profile, ir::Module& module);

}  // namespace ncport::frontend
