// The texts of docs/diagnostics/*.md, compiled in by embed_pages.cmake.
#pragma once

#include <string_view>

namespace ncport::app {

/// All pages, in the order of the codes.
std::string_view DiagnosticPages();

}  // namespace ncport::app
