// Jumps to block numbers under the search rule of the source become jumps that every search finds: forward or backward
// by where the target stands, with a label of its own where its number stands twice. Computed targets become the text
// "N" << number (for targets whose jumps take text).
#pragma once

#include <string_view>

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// Changes one program; afterwards no jump searches from the program start. Numbers that jumps go to leave structure
/// marks and stand on a block in front of them. A computed jump in a program with doubled numbers is a finding
/// (NC6001); returns false then.
bool ResolveJumps(Module& module, ProgramId program, std::string_view label_prefix, diag::Sink& sink);

}  // namespace ncport::ir::transform
