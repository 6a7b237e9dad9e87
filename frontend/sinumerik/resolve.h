// Names, calls and types of SINUMERIK programs, once the set of files is complete (card 3.3 to 3.7, 7).
#pragma once

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

void ResolveNames(SourceFiles& files, ir::Module& module, const dialects::Profile& profile, diag::Sink& sink);

/// Program that a call names: prefix, suffix, folder and case do not count, leading zeros of L names do. Invalid =
/// none.
ir::ProgramId FindProgram(const ir::Module& module, std::string_view name);

}  // namespace ncport::frontend::sinumerik
