// Modal calls (G66, G67) where the source has one at most and the target keeps them on a stack.
#pragma once

#include "backends/fanuc/raise.h"
#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::backends::fanuc {

/// Run while the source's calls still stand. A modal call that replaces another one ends that one first; an end where
/// none is active goes (fanuc-7.4: PS1100). Where the ways to a block differ in what is active, both are findings.
/// A parameter that its program changes is copied at its start: G66 keeps what a run left in the letter (fanuc-7.4).
bool MapModalCalls(const RaiseInput& input, ir::Module& module, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
