// Axes by name: nine have letters, others the names of their profile.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ir/module.h"

namespace ncport::ir {

inline constexpr std::string_view kAxisLetters = "XYZABCUVW";  // in the order of the axes
static_assert(kAxisLetters.size() == kLetterAxes);

/// The axis of a letter in upper case; none: it is no axis.
constexpr std::optional<std::uint8_t> AxisOf(char letter) {
  const std::size_t axis = kAxisLetters.find(letter);
  return axis == std::string_view::npos ? std::nullopt : std::optional(static_cast<std::uint8_t>(axis));
}
/// The axis of a name that is one letter.
constexpr std::optional<std::uint8_t> AxisOf(std::string_view name) {
  return name.size() == 1 ? AxisOf(name[0]) : std::nullopt;
}

/// Empty: the module has no name for it.
inline std::string_view AxisName(const Module& module, std::uint8_t axis) {
  if (axis < kLetterAxes) return kAxisLetters.substr(axis, 1);
  const std::size_t named = axis - kFirstNamedAxis;
  return named < module.axis_names.size() ? module.View(module.axis_names[named]) : std::string_view{};
}

}  // namespace ncport::ir
