// Names of programs as calls by a text write them.
#pragma once

#include <string_view>

namespace ncport::exec {

/// The name in a path or with the marks of a file: "/_N_SPF_DIR/_N_SUB1_SPF" is SUB1 (sinumerik-1.1).
std::string_view PlainName(std::string_view name);

}  // namespace ncport::exec
