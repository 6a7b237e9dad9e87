// Text of program files to the IR, for every language. One file after the other is read into one module; when the set
// is complete, names are resolved.
#pragma once

#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::frontend {

class TokenListener;

struct ReadOptions {
  /// Blocks of a shape that was seen before take the recipe of the first one. Off: each block is parsed; the IR is the
  /// same (a test and a fuzz target hold this).
  bool shape_cache = true;
  /// The file holds standard cycles that ncport brings along.
  bool library = false;
  /// Gets the tokens of each block; null: nobody asks.
  TokenListener* tokens = nullptr;
};

/// Appends the programs of one file, structure marks joined. Each wrong block is one finding, is marked kRefused and
/// keeps its text; the blocks after it are read as usual. Fails when there was an error.
Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink);

/// Names of called programs that the module does not hold, as written, each once: for looking up in folders (-I).
std::vector<StringId> UnknownCallees(const ir::Module& module, dialects::Language language);

/// When the set is complete: variables by scope, calls, jump targets that are variables, types, implicit conversions.
/// Unknown callees that the language brings along as text are read into `files` and the module. After it no Name
/// expression is left in a block that is not refused.
void ResolveNames(SourceFiles& files, ir::Module& module, const dialects::Profile& profile, diag::Sink& sink);

}  // namespace ncport::frontend
