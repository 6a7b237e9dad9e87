// Passes over single words: texts, codes, offsets, M functions, modes. Each is one line in the list of raise.cc.
#pragma once

#include "backends/sinumerik/raise.h"

namespace ncport::backends::sinumerik {

/// Printed texts become comments (listed losses, contracts section 3), messages that stop lose their number, alarms get
/// numbers of the user range (sinumerik-8.11); comments in front of words move to the end of their block; marks of the
/// file and words without effect go.
bool ArrangeTexts(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// What the language reads from its words one by one becomes what SINUMERIK reads: the lead of a thread as K or I,
/// dwell in a block of its own, modes that would end another one (groups 13 to 15).
bool ArrangeWords(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// Radius before centre; words of an arc where none is certain to be in force are refused. Behind LowerVacantValues,
/// which decides which words are there, and ExpandCycles: beside a drilling mode R is a level.
bool SettleArcs(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// Work offsets by [offsets]; G54 to G57 are themselves.
bool MapOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// M functions of the machine builder by [mcodes].
bool MapAuxiliaries(const RaiseInput& input, Translation& out, diag::Sink& sink);

/// Words are printed by the table of the target from here on, not as the source wrote them.
void DropSpellings(Translation& out);

/// A main program writes every modal group it relies on: all that its control promises at the start, or,
/// `only_relied_on`, those that decide what a word means before the program sets them.
void WriteStartModes(const RaiseInput& input, Translation& out, bool only_relied_on);

}  // namespace ncport::backends::sinumerik
