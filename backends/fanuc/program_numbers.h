// Numbers for programs that have names.
#pragma once

#include "backends/fanuc/raise.h"
#include "ir/transform/split_at_tool_change.h"

namespace ncport::backends::fanuc {

/// Those of [programs], the source's own where its name is a number, else free ones; fills Translation::programs.
/// `split`: programs that were cut at their tool changes, each part with a number of its own.
bool NumberPrograms(const RaiseInput& input, const ir::transform::SplitResult& split, Translation& out,
                    diag::Sink& sink);

}  // namespace ncport::backends::fanuc
