// Words that become comments, and motion words that the target must see again.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Messages, blank data and preprocessing stops become comments (contracts section 3, listed losses).
void TextsToComments(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// Motion word where the one in force is not that of the block before (labels, calls).
void NameMotions(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
