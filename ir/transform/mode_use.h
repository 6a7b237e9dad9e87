// Does anything behind a block still use the value that a modal group has there? A mode that the next blocks set anyway
// need not be put back.
#pragma once

#include "ir/analysis/cfg.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// `group`: the word that sets it (Motion, Plane, Distance, Diameter). True unless every way from behind `block` meets
/// such a word, or the end of the machine's work, before a block whose effect may depend on the mode. Calls, returns to
/// a caller and every word that is not known to be indifferent count as uses.
bool ModeIsUsedBehind(const Module& module, const analysis::FlowGraphs& graphs, ProgramId program, BlockId block,
                      WordOp group);

}  // namespace ncport::ir::transform
