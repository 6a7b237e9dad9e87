// The embedded cycle texts; library_data.cc is written into the build tree from cycles/*.spf by cycles/embed.cmake.
#pragma once

#include <cstddef>
#include <string_view>

namespace ncport::dialects::sinumerik {

extern const std::size_t kLibraryCount;
extern const std::string_view kLibraryNames[];  // upper case, sorted
extern const std::string_view kLibraryTexts[];  // beside kLibraryNames

}  // namespace ncport::dialects::sinumerik
