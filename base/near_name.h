// "Did you mean": the known name that was probably meant.
#pragma once

#include <span>
#include <string_view>

namespace ncport {

/// The candidate that the fewest edits (insert, delete, replace, swap neighbours; case is free) make from `name`, if
/// few enough to be a slip: at most a third of its length, at least 1. Of several as near, the one that starts longer
/// alike wins, then the one whose letter lies beside on the keyboard, then the first. Empty when none is near or `name`
/// is longer than 64.
std::string_view NearName(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace ncport
