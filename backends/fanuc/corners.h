// Chamfers and roundings at the end of a move: words of the target where its corner has the same two sides, else a
// finding (fanuc-8.10).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Run while the modes of the source still stand in the blocks. Returns false after a finding (NC6001) at the word.
bool MapCorners(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
