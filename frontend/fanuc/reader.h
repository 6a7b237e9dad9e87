// Reads one Fanuc, Mazak or Haas file into the module: lines to tokens, tokens to recipes, recipes to blocks.
#pragma once

#include <string>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "frontend/reader.h"
#include "ir/module.h"

namespace ncport::frontend::fanuc {

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink);

/// Name of the program that a file without O word holds: `O9810.NC`, `O09810_NAME.nc`, `9810-Name.nc` and `9810` are
/// O9810, any other name stands for itself without folder and ending (real-programs, "Text").
std::string ProgramNameOfFile(std::string_view file_name);
/// O number without leading zeros: all lengths name one program (fanuc-2.1).
std::string ProgramName(std::uint32_t number);

}  // namespace ncport::frontend::fanuc
