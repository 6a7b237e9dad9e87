// `ncport list`.
#pragma once

#include <string>
#include <string_view>

namespace ncport::app {

/// `what`: "profiles", "rules" or "languages"; one a line, or a JSON object {"version", what: [...]}.
std::string List(std::string_view what, bool json);

}  // namespace ncport::app
