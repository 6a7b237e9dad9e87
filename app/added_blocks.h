// The marks that translations put at blocks of their own (contracts section 6): read back, so that a file compared
// later is compared as it was when it was written.
#pragma once

#include "dialects/language.h"
#include "ir/module.h"

namespace ncport::app {

/// Sets Block::kAdded on the blocks that the comments of the file mark.
void MarkAddedBlocks(ir::Module& module, dialects::Language language);

}  // namespace ncport::app
