// Controls that round each computed word on its way to the axis, against targets that do not: the rounding is written
// out where it changes what happens. A single absolute word may differ by the error of one word (contracts section 6),
// but increments would drift, an arc could become a full circle, and positions that are read back feed on.
#pragma once

#include "base/diag/sink.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs of the module; afterwards no word has kRoundsValue. A word under a distance mode that is not one value
/// counts as an increment. A word to be rounded whose unit (mm, inch) is not one value is a finding (NC5006), one of a
/// control that cuts instead another (NC6001); returns false then.
bool RoundWords(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink);

}  // namespace ncport::ir::transform
