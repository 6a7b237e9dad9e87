// Codes of the machine: work offsets and M functions. Shop data comes from ncport.toml: what it does not map is a
// finding with the line to add.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// By [offsets]; G54 to G59 are themselves.
bool MapWorkOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// By [mcodes].
bool MapAuxiliaries(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
