// Tools of lathes and turning centres, whose tool word brings its offset along: T0101, T01.01 M6.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Tool, edge and offset words -> the words that [tools] gives, in a block of their own; work offset again behind it.
bool MapTurretTools(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
