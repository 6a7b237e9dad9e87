// Blocks that a translation adds around the source's own: the safety line of a main program, its end, the way out to a
// tool change, the guards of a macro. All carry Block::kAdded: they are listed and left out of the comparison.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// What the profile must answer before blocks can be framed; each open answer is a finding with the line to add.
bool NeedFrame(const RaiseInput& input, diag::Sink& sink);
/// Head and ends of main programs: every modal group that a program can rely on is written.
void FrameMainPrograms(const RaiseInput& input, Translation& out);
/// Machines whose tools change at a position: the way there in front of each tool call, but where the head alone lies
/// before it on every way; behind each what the change undoes. A cut behind one before X and Z were both named again is
/// a finding (NC6001): it would start there.
bool FrameToolChanges(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// Alarm when a letter that the macro needs is missing: the source takes 0 there, the target nothing (hazards#6).
void GuardMacros(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
