// Functions of expressions that the control does not have (fanuc-4.3, 13; mazak-lathe-6.4).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Functions that no word of the family says, and those that the profile lists as missing. False after findings.
bool RefuseFunctions(const RaiseInput& input, const ir::Module& module, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
