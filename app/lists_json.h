// Lists as JSON.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ncport::app {

/// One entry: key and value of each field.
using ListEntry = std::vector<std::pair<std::string_view, std::string>>;

/// {"version": 1, `what`: [{...}, ...]}
std::string ListAsJson(std::string_view what, const std::vector<ListEntry>& entries);

}  // namespace ncport::app
