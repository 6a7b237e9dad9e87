// The lead of a thread: a word of its own in the source (K), the feed word here (fanuc-8.3). The feed in force is lost
// by it.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Lead words become F, and the F of a changing lead K, which is below 0 where it gets shorter; not where the source
/// has its leads in F already. A feed move behind a thread that relies on the F before it names that again, where it is
/// one number on every way; else it is refused. Run after AbsoluteDimensions.
bool ThreadLeads(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// Start angles, in degrees in the IR, become the counts of 0.001 degree without a point that Q takes (fanuc-8.1); one
/// finer than that is refused.
bool StartAngles(Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
