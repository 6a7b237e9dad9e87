// Words of the machine: tools, work offsets, spindle, M functions, and those that become comments. Shop data comes from
// ncport.toml: what it does not map is a finding with the line to add.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Messages, blank data and preprocessing stops become comments (contracts section 3, listed losses).
void TextsToComments(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// Tool, edge and offset words -> the words that [tools] gives, in a block of their own; work offset again behind it.
bool MapTools(const RaiseInput& input, Translation& out, diag::Sink& sink);
bool MapWorkOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink);
bool MapAuxiliaries(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// Speed limit in a block in front, speed mode with every speed, feed mode that constant surface speed brings along.
bool ArrangeSpindle(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// Motion word where the one in force is not that of the block before (labels, calls).
void NameMotions(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
