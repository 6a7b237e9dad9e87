// What the target has no form for, when all passes have run.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Each word that is left is one that the printer can write; what is not is a finding.
bool CheckLegal(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
