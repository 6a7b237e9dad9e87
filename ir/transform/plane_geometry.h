// Points and arcs of a plane as sums (see linear_form.h), in mm and degrees, all axes as radii: what opening angles,
// intermediate points and polar words mean as end points and centres.
#pragma once

#include <optional>

#include "ir/transform/linear_form.h"

namespace ncport::ir::transform {

struct PlanePoint {
  LinearForm u, v;  // along the first and the second axis of the plane
};

/// Centre, seen from the start, of the arc to `way` (end - start) that opens by `degrees` (0 < degrees < 360).
PlanePoint CenterByOpening(const Module& module, const PlanePoint& way, double degrees, bool clockwise);
/// Centre, seen from the start, of the arc to (u, v) with this radius, negative for more than 180 degrees. None: there
/// is no such arc.
std::optional<PlanePoint> CenterByRadius(double u, double v, double radius, bool clockwise);
/// End, seen from the start, of the arc about `center` (seen from the start) that opens by `degrees`.
PlanePoint EndByOpening(const Module& module, const PlanePoint& center, double degrees, bool clockwise);
/// The point at `radius` and `angle` about `pole`. A constant angle leaves sums, another one COS and SIN.
PlanePoint PolarPoint(Module& module, const PlanePoint& pole, const LinearForm& radius, const LinearForm& angle);

/// Arc from the origin by way of `via` to `end`, all numbers: (u, v) each.
struct ThroughArc {
  double center_u = 0, center_v = 0;
  bool clockwise = false;
};
/// None: the points lie on one line, or two of them are one.
std::optional<ThroughArc> ArcThroughPoints(double via_u, double via_v, double end_u, double end_v);

}  // namespace ncport::ir::transform
