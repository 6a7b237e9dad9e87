// Blocks whose rest runs under a condition (`IF [..] THEN ..`, kWhen) become IF .. ENDIF around blocks of their own,
// for targets that have no such form. A block with a skip level becomes jumps over its parts: structure marks must not
// be skipped.
#pragma once

#include <string_view>

#include "ir/module.h"

namespace ncport::ir::transform {

/// Changes one program; a second condition inside one block stays. Run before SplitStatements. Labels of jumps that it
/// makes begin with `label_prefix` and stand nowhere else in the program.
void ConditionalBlocks(Module& module, ProgramId program, std::string_view label_prefix);

}  // namespace ncport::ir::transform
