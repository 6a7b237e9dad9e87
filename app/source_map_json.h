// Where the blocks of a translated program come from, as JSON lines (contracts section 2).
#pragma once

#include "app/ncport.h"
#include "backends/translate.h"

namespace ncport::app {

/// A line for each block that comes from the source: `out` is its line in `output`, a file of the set. Loops and calls
/// are kept, so there are no calls and turns. Blocks that the translator adds have no line.
void AppendSourceMap(const Context& context, const ir::Module& module, const backends::OutputFile& file,
                     OutputSink& sink);

}  // namespace ncport::app
