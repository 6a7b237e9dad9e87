// A module as the files of its language, and back.
#pragma once

#include <string>
#include <vector>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::tests::random {

struct TextFile {
  std::string name;
  std::string text;
};

/// Each file of the module in the language of the profile.
std::vector<TextFile> PrintAll(const ir::Module& module, const dialects::Profile& profile);

/// The files of the main program and of those that it calls, as a command reads them.
std::vector<TextFile> PrintCalled(const ir::Module& module, ir::ProgramId main, const dialects::Profile& profile);

/// Reads all files and resolves their names. False after errors.
bool ReadAll(const std::vector<TextFile>& texts, const dialects::Profile& profile, SourceFiles& files,
             ir::Module& module, diag::Sink& sink);

/// All files, one below the other.
std::string Listing(const std::vector<TextFile>& texts);

}  // namespace ncport::tests::random
