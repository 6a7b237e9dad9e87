// Calls of Fanuc programs, once the set of files is complete (fanuc-7.2).
#pragma once

#include "base/diag/sink.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::frontend::fanuc {

/// Finds the called programs. P with more than four digits and no L names a program of that number if there is one,
/// else the digits above the last four are the passes.
void ResolveNames(ir::Module& module, const dialects::Profile& profile, diag::Sink& sink);

}  // namespace ncport::frontend::fanuc
