// Reads one SINUMERIK file into the module: lines to tokens, tokens to recipes, recipes to blocks.
#pragma once

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "frontend/reader.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink);

/// Name of a program without folder, `_N_`, `_MPF`, `_SPF` and file ending: all of them name the same program
/// (card 1.1).
std::string_view PlainProgramName(std::string_view name);

}  // namespace ncport::frontend::sinumerik
