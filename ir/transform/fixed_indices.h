// `R[e]` whose index has one value wherever the run comes there becomes the cell itself: one cell can move to another
// number by itself, and what writes and reads it is known.
#pragma once

#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs of the module. Blocks that write and do something else keep theirs.
void FixIndices(Module& module, const Machine& source);

}  // namespace ncport::ir::transform
