// Numbers that count increments of the machine (`X100` = 0.1 mm, `P1500` = 1.5 s) become values in the unit of their
// word, for targets that read every number as it stands (calculator point).
#pragma once

#include "base/diag/sink.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs of the module; afterwards no word and no argument of a call has kIncrements (data of the control, G10,
/// stay as written: no target has them). Where the unit is not one value on all ways (inch or mm, feed per minute or
/// per revolution) that is a finding (NC5006); returns false then.
bool ResolveIncrements(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink);

}  // namespace ncport::ir::transform
