#include "ir/transform/plane_geometry.h"

#include <doctest/doctest.h>

#include <cmath>

#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

PlanePoint Point(double u, double v) { return {{u, {}}, {v, {}}}; }

TEST_CASE("the centre of an opening angle lies at equal distance from both ends and opens by it (sinumerik-8.3)") {
  const Module module;
  for (const bool clockwise : {false, true}) {
    for (const double degrees : {10.0, 90.0, 179.0, 180.0, 181.0, 270.0, 359.0}) {
      CAPTURE(degrees);
      CAPTURE(clockwise);
      const double du = 30, dv = -12;
      const PlanePoint center = CenterByOpening(module, Point(du, dv), degrees, clockwise);
      const double u = center.u.constant, v = center.v.constant;
      CHECK(std::hypot(u, v) == doctest::Approx(std::hypot(du - u, dv - v)));
      double sweep = (std::atan2(dv - v, du - u) - std::atan2(-v, -u)) * 180 / 3.14159265358979323846;
      if (clockwise) sweep = -sweep;
      if (sweep < 0) sweep += 360;
      CHECK(sweep == doctest::Approx(degrees));
      const PlanePoint end = EndByOpening(module, center, degrees, clockwise);
      CHECK(end.u.constant == doctest::Approx(du));
      CHECK(end.v.constant == doctest::Approx(dv));
    }
  }
}

TEST_CASE("the centre by a radius: short and long arcs of both senses") {
  for (const bool clockwise : {false, true}) {
    for (const double radius : {20.0, -20.0}) {
      const std::optional<PlanePoint> center = CenterByRadius(30, -12, radius, clockwise);
      REQUIRE(center);
      const double u = center->u.constant, v = center->v.constant;
      CHECK(std::hypot(u, v) == doctest::Approx(20));
      CHECK(std::hypot(30 - u, -12 - v) == doctest::Approx(20));
      const double across = 30 * v - -12 * u;  // > 0: the centre lies to the left of the way
      CHECK((across > 0) == (clockwise == (radius < 0)));
    }
  }
  CHECK_FALSE(CenterByRadius(30, 0, 14, false));
  CHECK_FALSE(CenterByRadius(0, 0, 14, false));
}

TEST_CASE("a half circle has its centre in the middle of a chord of variables") {
  Module module;
  ExprBuilder e(module);
  const SpaceId space = AddSpace(module, "R", 0, 99);
  const PlanePoint center = CenterByOpening(module, {FormOf(module, e.Cell(space, 1)), {}}, 180, false);
  REQUIRE(center.u.terms.size() == 1);
  CHECK(center.u.terms[0].coefficient == 0.5);
  CHECK(center.v.IsConstant());
  CHECK(center.v.constant == 0);
}

TEST_CASE("a polar point keeps numbers as numbers and computes what varies") {
  Module module;
  ExprBuilder e(module);
  const SpaceId space = AddSpace(module, "R", 0, 99);
  const PlanePoint fixed = PolarPoint(module, Point(20, 10), {50, {}}, {90, {}});
  CHECK(fixed.u.constant == 20);
  CHECK(fixed.v.constant == 60);
  const PlanePoint turned = PolarPoint(module, Point(20, 10), {50, {}}, FormOf(module, e.Cell(space, 1)));
  CHECK(turned.u.constant == 20);
  REQUIRE(turned.u.terms.size() == 1);
  CHECK(turned.u.terms[0].coefficient == 50);
  CHECK(module.exprs[turned.u.terms[0].atom].op == ExprOp::kFunction);
}

TEST_CASE("an arc through three points, and none on a line") {
  const std::optional<ThroughArc> arc = ArcThroughPoints(10, 10, 20, 0);
  REQUIRE(arc);
  CHECK(arc->center_u == doctest::Approx(10));
  CHECK(arc->center_v == doctest::Approx(0));
  CHECK(arc->clockwise);
  CHECK_FALSE(ArcThroughPoints(10, -10, 20, 0)->clockwise);
  CHECK_FALSE(ArcThroughPoints(5, 0, 20, 0));
  CHECK_FALSE(ArcThroughPoints(0, 0, 20, 0));
}

}  // namespace
}  // namespace ncport::ir::transform
