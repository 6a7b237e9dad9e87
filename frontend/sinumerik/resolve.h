// Names, calls and types of SINUMERIK programs, once the set of files is complete (card 3.3 to 3.7, 7).
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

void ResolveNames(SourceFiles& files, ir::Module& module, const dialects::Profile& profile, diag::Sink& sink);

/// Programs of a module as calls name them.
class ProgramIndex {
 public:
  /// Of the programs that the module holds now.
  explicit ProgramIndex(const ir::Module& module);
  /// Program that a call names: prefix, suffix, folder and case do not count, leading zeros of L names do. Invalid =
  /// none.
  [[nodiscard]] ir::ProgramId Find(std::string_view name) const;

 private:
  std::unordered_map<std::string, ir::ProgramId> by_name_, by_file_;  // upper case
};

}  // namespace ncport::frontend::sinumerik
