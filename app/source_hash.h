// One figure for the texts that a result was made from.
#pragma once

#include <cstdint>

#include "base/source_files.h"
#include "ir/module.h"

namespace ncport::app {

/// FNV-1a over the texts of the module's programs: the same sources give the same figure.
std::uint64_t HashOf(const SourceFiles& files, const ir::Module& module);

}  // namespace ncport::app
