// A program that puts the modal state of its caller back when it returns (SAVE) becomes one that does not, with the
// words that put it back behind each of its calls, or, where it is called modally, in front of its returns: few
// languages have SAVE. Only groups that the program or what it calls can change.
#pragma once

#include "base/diag/sink.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// All programs of the module. A group whose state before the call is not one value is a finding (NC5006) at the call;
/// returns false then. Words made here carry Word::kAdded.
bool SaveToRestores(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink);

}  // namespace ncport::ir::transform
