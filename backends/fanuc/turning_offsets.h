// Tool offsets of turning tools on multi-tasking machines (mazak-lathe-4.3, 10.3): the T word selects none there; the
// first rapid in Z behind a tool change names it (`G43 P1 Z50. H#3020`).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// For profiles with fanuc.ix-offset G43P1. Run when the tools are mapped and all dimensions are absolute. The first
/// block behind a tool change that names Z must be a rapid: it is written as X (and Y0. where there is a Y axis), then
/// Z with the offset, which is listed. A way on which a tool change may or may not lie behind the tool, and a first
/// move of Z under feed, are refused.
bool NameTurningOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
