// The axes of the main planes.
#pragma once

#include <cstdint>

#include "ir/modes.h"

namespace ncport::ir {

/// The two axes of a plane in its order, and its normal: XY -> 0 1 2, ZX -> 2 0 1, YZ -> 1 2 0.
struct PlaneAxes {
  std::uint8_t first = 0;
  std::uint8_t second = 1;
  std::uint8_t normal = 2;
};
constexpr PlaneAxes AxesOf(Plane plane) {
  switch (plane) {
    case Plane::kZX:
      return {2, 0, 1};
    case Plane::kYZ:
      return {1, 2, 0};
    default:
      return {0, 1, 2};
  }
}
constexpr Plane PlaneWithNormal(std::uint8_t normal) {
  return normal == 1 ? Plane::kZX : normal == 0 ? Plane::kYZ : Plane::kXY;
}

}  // namespace ncport::ir
