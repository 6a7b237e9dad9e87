// A variable that takes the active feed (`NCP_FEED=$P_F`) takes its number instead, where the feed word in force is one
// number on every way: targets have no such value, or change it with the lead of a thread.
#pragma once

#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs of the module. A feed that the program puts back from such a variable is followed.
void FeedsToNumbers(Module& module, const Machine& source, const ModalState& sub_entry);

}  // namespace ncport::ir::transform
