// The axes of a plane, 0 to 2 for X Y Z, in the order in which angles count.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "ir/modes.h"

namespace ncport::check {

/// None: the plane is not known.
constexpr std::optional<std::array<std::size_t, 2>> AxesOf(ir::Plane plane) {
  switch (plane) {
    case ir::Plane::kXY:
      return {{0, 1}};
    case ir::Plane::kZX:
      return {{2, 0}};
    case ir::Plane::kYZ:
      return {{1, 2}};
    default:
      return std::nullopt;
  }
}

}  // namespace ncport::check
