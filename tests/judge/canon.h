// The canonical calls that rs274 (the stand-alone interpreter of LinuxCNC) prints, as trace events.
#pragma once

#include <string>
#include <string_view>

#include "tests/tools/trace_compare.h"

namespace ncport::tests {

/// Events of the output of `rs274 -g`, in mm and degrees, with all of X Y Z A B C in every move (rs274 starts at 0).
/// Kinds: RAPID, LINE, ARC, THREAD, DWELL, TOOL, SPINDLE, M7, M8, MIST_OFF, FLOOD_OFF, STOP, OPTSTOP, END. A call that
/// is not known comes back in `error`.
ParsedTrace ParseCanon(std::string_view text);

/// What is different between the trace of ncport and what rs274 did; none = they agree. Compared are moves, arcs,
/// threads and dwells with their order, feeds and planes, spindle and coolant at each cut, tools, stops and the end. A
/// move to where the tool stands is no move on either side; axes that ncport has not named must stand at 0 on the
/// other.
std::optional<std::string> CompareWithCanon(const Trace& trace, const Trace& canon);

/// Why rs274 cannot be asked about such a trace ("TAP: ..."); empty: it can.
std::string ReasonNotToAsk(const Trace& trace);

}  // namespace ncport::tests
