// The words of --call, --set and --start, turned into what a run starts from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "dialects/profile.h"
#include "exec/run.h"
#include "ir/module.h"

namespace ncport::app {

/// `RING(10,,2.5)`, `O4001(A=1.5,B=2)`, `RING`: sets entry, arguments, is_call. Text in double quotes, TRUE, FALSE and
/// axis letters are constants too. A program that is not in the module, a constant that cannot be read, and an argument
/// that the program does not have are findings. A letter fills the local variable that the profile's language gives it.
Status ApplyCall(std::string_view call, const ir::Module& module, const dialects::Profile& profile,
                 exec::RunOptions& options, diag::Sink& sink);

/// `R1=5`, `#100=2.5`, `NAME=VALUE`: adds a start value. `options.entry` must be set.
Status ApplySet(std::string_view set, const ir::Module& module, bool ignore_case, exec::RunOptions& options,
                diag::Sink& sink);

/// `X0Y0Z100.5`: sets the start position. Lengths in the profile's unit.
Status ApplyStart(std::string_view start, const dialects::Profile& profile, exec::RunOptions& options,
                  diag::Sink& sink);

}  // namespace ncport::app
