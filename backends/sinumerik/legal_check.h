// The last look before printing: what is left must have a form in the target.
#pragma once

#include "backends/sinumerik/raise.h"

namespace ncport::backends::sinumerik {

/// Every word without a form is a finding at its place; false then. `expressions`: those too, once the passes are done.
bool CheckLegal(const RaiseInput& input, const ir::Module& module, bool expressions, diag::Sink& sink);

}  // namespace ncport::backends::sinumerik
