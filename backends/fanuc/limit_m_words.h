// M functions in a block: as many as the control takes (fanuc-1, block.max-m).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Splits the blocks with more M functions than `block.max-m`: those that act before the motion go in front, with the
/// T and S they stand behind, those that act after it behind, each group in its order. A number or label stays with the
/// first part, the skip level with all. An open `block.max-m`, or 0, is no limit.
void LimitMWords(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
