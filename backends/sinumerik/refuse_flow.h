// Calls, returns and ends that mean something else on the target.
#pragma once

#include "backends/sinumerik/raise.h"

namespace ncport::backends::sinumerik {

/// False after findings, each at its word.
bool RefuseFlow(const RaiseInput& input, const ir::Module& module, diag::Sink& sink);

}  // namespace ncport::backends::sinumerik
