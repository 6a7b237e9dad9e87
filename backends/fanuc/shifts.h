// Programmable shifts (TRANS, ATRANS) as the local coordinate shift G52, which replaces the last one (fanuc-8.4).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// G52 cannot say the frames of the source: they turn, scale or mirror, shift X of a lathe, or add up across programs
/// or under SAVE. They are worked into the coordinates.
bool FramesAreWorkedIn(const RaiseInput& input, const Translation& out);

/// Words that vanish into the coordinates (frames if `frames`, poles) stay as comments where they stood.
void FramesToComments(Translation& out, bool frames);

/// After it each Frame word is kTranslate with every axis that the module shifts at all, in mm. Added shifts are summed
/// up in locals of the main program. Only for modules whose frames are not worked in. Run before AbsoluteDimensions,
/// which drops the units.
bool ShiftsToLocal(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// SETAL -> #3000 with a number of the profile's range; Translation::alarms is the map.
bool MapAlarms(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// Cells that are read before they are written are the operator's: refused until [variables] pins them.
bool RefuseInputs(const RaiseInput& input, const Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
