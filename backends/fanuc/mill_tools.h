// Tools of a machining centre: `T1 M6`, the length register with the first Z word behind it (G43 H), the radius
// register in the blocks that switch compensation on (D). The source's edge D is both at once (sinumerik-8.8,
// hazards#2).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Which tool and edge are in force at a block is followed over blocks and calls: one on every way is known, anything
/// else is refused where a register has to be named. Run after NameMotions, before AbsoluteDimensions.
bool MapMillTools(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
