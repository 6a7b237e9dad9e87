// `translate --unsupported=stop` (contracts section 3): a block that the target cannot express becomes a comment with
// its text and an alarm that the operator cannot run past.
#pragma once

#include "app/ncport.h"
#include "app/pipeline.h"
#include "backends/translate.h"

namespace ncport::app {

/// Raises `input`; blocks that it refuses are stopped and it is tried again. `running` gets the source with the same
/// stops, for the comparison. The findings of the refused blocks stay errors. False, after a finding: what is refused
/// has no block, or is a jump, loop or call, so that its program, and with it the set, is refused whole.
bool RaiseWithStops(Context& context, const backends::TranslateInput& input, backends::Translation& translation,
                    ir::Module& running);

}  // namespace ncport::app
