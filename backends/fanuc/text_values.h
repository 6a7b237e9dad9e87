// These controls know numbers only: a value that hangs on a text has no form (fanuc-4.1).
#pragma once

#include "backends/fanuc/raise.h"
#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::backends::fanuc {

/// Behind TextsToComments, which takes the messages. A text that is compared, joined or taken apart, and a function
/// that the target neither has nor gets built, is a finding (NC6001); returns false then. Names of programs and tools
/// and texts of alarms stay.
bool RefuseTexts(const RaiseInput& input, const ir::Module& module, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
