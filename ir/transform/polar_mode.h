// Words of the plane as radius and angle while a mode is on (G16), as coordinates: for targets that have no such mode.
// Which words are meant so, and which radius or angle an earlier block gave, follows from the flow.
//
// Run after LowerVacantValues (a word is there or not) and before ExpandCycles. Afterwards no PolarMode word is left.
#pragma once

#include "base/diag/sink.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs of the module. Words whose radius, angle or mode the text does not tell, increments and words in inches
/// are findings (NC6001); returns false then.
bool LowerPolarMode(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink);

}  // namespace ncport::ir::transform
