// Findings as SARIF 2.1.0, the form that code hosts and editors read.
#pragma once

#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "base/source_files.h"

namespace ncport::diag {

/// One run with all rules of the registry. `tool_version` is that of ncport.
std::string RenderSarif(const Sink& sink, const SourceFiles& files, std::string_view tool_version);

/// A file name as a URI reference: "a b.nc" -> "a%20b.nc", "/x" -> "file:///x".
std::string UriOf(std::string_view file);

}  // namespace ncport::diag
