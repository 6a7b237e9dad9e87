// Jumps and repeated parts whose labels do not exist.
#pragma once

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::check {

/// Reports each label or block number that a jump, a switch or a repeated part of the program names and that its search
/// does not find (card rule: the control stops there, SINUMERIK alarm 14080). Computed targets are left to the run, and
/// so are targets that a refused block may carry. `ignore_case`: labels compare without regard to case.
void CheckLabels(const ir::Module& module, ir::ProgramId program, bool ignore_case, diag::Sink& sink);

}  // namespace ncport::check
