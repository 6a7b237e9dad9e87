// What no program for a Mazak lathe may hold, checked on the raised module: the refusals of mazak-lathe-10.4 that no
// other step makes. The others: spindle and limit words, dwell and class that the profile leaves open, M codes (raise),
// points of numbers (print), depth of brackets and loops (limit_nesting, structure_to_jumps).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Each is a finding (NC6001) at its block; returns false then.
bool CheckMazakLathe(const RaiseInput& input, const Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
