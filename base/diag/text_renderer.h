// Findings as text for people (docs/contracts.md, section 4).
#pragma once

#include <cstddef>
#include <string>

#include "base/diag/sink.h"
#include "base/source_files.h"

namespace ncport::diag {

struct TextOptions {
  std::size_t tab_width = 8;
  std::size_t max_width = 100;  // of the source line shown; a longer one is cut around the place
};

/// One finding with its source line, marker, notes, help and control alarm; ends with a line end.
std::string RenderText(const Diagnostic& diagnostic, const SourceFiles& files, const TextOptions& options = {});
/// All findings of the sink, in its order.
std::string RenderText(const Sink& sink, const SourceFiles& files, const TextOptions& options = {});

}  // namespace ncport::diag
