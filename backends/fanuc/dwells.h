// Dwells: seconds everywhere, turns of the spindle where the target counts them (fanuc-8.1, mazak-lathe-2.6).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// The target counts seconds under feed per minute, and under feed per revolution what the profile says
/// (fanuc.dwell): where that is not what the source counts, the feed mode is switched around the dwell. A dwell in
/// turns that no mode of the target counts is a finding (NC6001) with the reason.
bool MapDwells(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
