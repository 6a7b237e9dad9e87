// Tools of the source and their offset registers as tools and edges (sinumerik-8.8): T M6, H and D of a mill, T0101 of
// a lathe, by [tools].
#pragma once

#include "backends/sinumerik/raise.h"

namespace ncport::backends::sinumerik {

/// A length register that is in force is the edge of the tool that is in force on every way there; without one the edge
/// is off (D0). Keys of [tools] are the words of the source: "T5 H5 D25", "T5 H5", "T5"; "T0101" on a lathe.
bool MapTools(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::sinumerik
