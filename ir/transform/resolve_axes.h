// Axis words whose axis an expression gives (AX[..]) become plain ones where the axis is known from the text: a named
// axis, or an axis of the plane in force ($P_AXN1..3), but in a block that changes the plane.
#pragma once

#include "ir/analysis/modal_state.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs. Words that stay computed are left as they are: a target without them refuses them.
void ResolveAxes(Module& module, const analysis::ModalFlow& flow);

}  // namespace ncport::ir::transform
