// Fits library programs (standard cycles as text) to the values that their calls give: each set of constant arguments
// gets a text of its own, without the parameters that are constant, the branches that they rule out and what only
// those needed. What is left is what the cycle does for this call.
#pragma once

#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All calls of library programs of the module; arguments that are no constants stay parameters. `entry`: state in
/// which subprograms start that nothing calls. Values are worked out as the source's control does, with the modes that
/// are in force; a value whose digits no text holds is not written as a number. A program whose structure or calls this
/// pass does not follow stays as it is.
void SpecializePrograms(Module& module, const Machine& source, const ModalState& entry);

}  // namespace ncport::ir::transform
