// Chamfers and roundings between two elements of a contour in a plane: pure geometry, lengths in mm.
#pragma once

#include "exec/arc_geometry.h"

namespace ncport::exec {

struct Element {
  Point start;
  Point end;
  bool arc = false;
  Point center;
  bool clockwise = false;
};

enum class CornerFault : unsigned char {
  kNone,
  kSmooth,    // the elements meet without a corner: nothing to insert
  kReversal,  // the second goes straight back on the first
  kTooShort,  // an element has no room for it
};

struct Corner {
  CornerFault fault = CornerFault::kNone;
  Point first;   // where the first element now ends
  Point second;  // where the second one now begins
  Point center;  // of a rounding
  bool clockwise = false;
};

/// Rounding of this radius, tangent to both elements.
Corner RoundCorner(const Element& first, const Element& second, double radius);
/// Chamfer that begins `leg` before the corner and ends as far behind it; on an arc the distance is straight from the
/// corner.
Corner CutCorner(const Element& first, const Element& second, double leg);
/// Leg of a chamfer of this length over the corner (sinumerik-8.9: length = 2 leg sin(angle / 2)); 0 for a smooth
/// corner.
double LegOfChamfer(const Element& first, const Element& second, double length);

}  // namespace ncport::exec
