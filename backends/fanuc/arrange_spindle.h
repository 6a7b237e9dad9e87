// Speeds and the sense of the spindle, as the target reads them.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Speed limit in a block in front, speed mode with every speed, feed mode that constant surface speed brings along.
bool ArrangeSpindle(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
