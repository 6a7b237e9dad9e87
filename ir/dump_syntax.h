// Words of the dump language that writer and parser share.
#pragma once

#include <string_view>

namespace ncport::ir {

inline constexpr std::string_view kDumpTitle = "ncport-ir 1";

// By bit of the flags.
inline constexpr std::string_view kExprFlagNames[] = {"tolerance", "implicit",      "operands-to-int", "vacant-as-zero",
                                                      "round-cut", "numeric-model", "vacant-differs"};
inline constexpr std::string_view kNumberFlagNames[] = {"point", "plus", "as-text", "computed"};
inline constexpr std::string_view kWordFlagNames[] = {"equal",   "vanishes",   "rounds",    "added",
                                                      "freezes", "increments", "keeps-tool"};
inline constexpr std::string_view kBlockFlagNames[] = {"main-block", "skip-digit", "added", "refused"};

constexpr bool IsNameStart(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$' || c == '#';
}
constexpr bool IsNameChar(char c) {
  return IsNameStart(c) || (c >= '0' && c <= '9') || c == '.' || c == '/' || c == '-';
}

/// Names that need no quotes. Behind the first character also what files and rules have in their names.
constexpr bool IsBareName(std::string_view text) {
  if (text.empty() || !IsNameStart(text.front())) return false;
  for (const char c : text.substr(1)) {
    if (!IsNameChar(c)) return false;
  }
  return true;
}

}  // namespace ncport::ir
