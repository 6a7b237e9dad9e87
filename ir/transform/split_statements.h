// One statement a block, for targets whose macro statements stand alone: assignments from left to right, then the NC
// words together, then jumps and calls, then what ends the program. The order of effects stays what the source's phases
// say.
#pragma once

#include "ir/module.h"

namespace ncport::ir::transform {

/// Changes one program. A word whose value a later assignment of the same block would change gets its value held in a
/// local first, since values are taken from left to right.
void SplitStatements(Module& module, ProgramId program);

}  // namespace ncport::ir::transform
