// Arcs in whole increments. Rounding end point and centre on their own can give two radii, or a full circle out of a
// tiny arc; here they are chosen together, and what is too short to be an arc any more is a line.
#pragma once

#include <cstdint>

namespace ncport::backends::iso {

/// An arc as the run computed it, in the plane's axis order, mm (or inch). Coordinates of the plane in target
/// increments are `unit` long: half as long on an axis that is written as a diameter.
struct ExactArc {
  double from[2] = {};
  double to[2] = {};
  double center[2] = {};
  bool clockwise = false;
  bool full_circle = false;
};

/// How the two axes of the plane are written.
struct ArcGrid {
  double increment = 0.001;         // of centre words
  double unit[2] = {0.001, 0.001};  // length of one increment of a coordinate word
};

struct GridArc {
  enum class Kind : std::uint8_t {
    kArc,     // `to` and `center` hold
    kLine,    // shorter than two increments: a line to `to`
    kBroken,  // no centre near the exact one gives both radii within the tolerance (`start_radius`, `end_radius`), or
              // rounding has turned the arc into another one
  };
  Kind kind = Kind::kArc;
  std::int64_t center[2] = {};  // from the start point, in `increment`
  double start_radius = 0, end_radius = 0;
};

/// Angle that the arc turns through, radians, above 0; a full circle is 2 pi.
double SweepOf(const ExactArc& arc);

/// Chooses the centre words of `arc` between the written points `start` and `end` (in units of the grid). `tolerance`:
/// largest difference of the two radii that the control takes. On each axis the written centre lies within one
/// increment of the exact one: a centre has the error of two words (contracts section 6), start point and centre word,
/// so that a flat program still compares with its source. Radii that need more than that stay apart, up to about 1.4
/// increments where the end points lie on the exact arc.
GridArc FitArc(const ExactArc& arc, const std::int64_t start[2], const std::int64_t end[2], const ArcGrid& grid,
               double tolerance);

}  // namespace ncport::backends::iso
