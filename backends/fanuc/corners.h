// Chamfers and roundings at the end of a move: words of the target where its corner has the same two sides, else a
// finding (fanuc-8.10).
#pragma once

#include "backends/fanuc/raise.h"
#include "ir/transform/absolute_dimensions.h"

namespace ncport::backends::fanuc {

using Corners = ir::transform::AbsoluteDimensionsConfig::Corners;
/// Corners that become moves of their own: all where the target has no words for them (,C ,R); on a lathe those by the
/// length of the chamfer, whose leg would be rounded in a diameter.
Corners CornersToMoves(const dialects::Profile& profile);

/// Run while the modes of the source still stand in the blocks. Returns false after a finding (NC6001) at the word.
bool MapCorners(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
