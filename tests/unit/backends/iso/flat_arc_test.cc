#include "backends/iso/flat_arc.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "backends/iso/flat_numbers.h"

namespace ncport::backends::iso {
namespace {

struct Rounded {
  GridArc fit;
  std::int64_t from[2];
  std::int64_t to[2];
};

Rounded Fit(const ExactArc& arc, double tolerance = 0.01) {
  Rounded result{};
  for (int i = 0; i < 2; ++i) {
    result.from[i] = RoundToIncrements(arc.from[i], 1000);
    result.to[i] = RoundToIncrements(arc.to[i], 1000);
  }
  result.fit = FitArc(arc, result.from, result.to, ArcGrid{}, tolerance);
  return result;
}

ExactArc ArcOf(double center0, double center1, double radius, double from_degrees, double sweep_degrees,
               bool clockwise) {
  const double rad = std::numbers::pi / 180;
  const double to = from_degrees + (clockwise ? -sweep_degrees : sweep_degrees);
  ExactArc arc;
  arc.center[0] = center0;
  arc.center[1] = center1;
  arc.from[0] = center0 + radius * std::cos(from_degrees * rad);
  arc.from[1] = center1 + radius * std::sin(from_degrees * rad);
  arc.to[0] = center0 + radius * std::cos(to * rad);
  arc.to[1] = center1 + radius * std::sin(to * rad);
  arc.clockwise = clockwise;
  return arc;
}

TEST_CASE("a plain arc keeps its centre") {
  const Rounded arc = Fit(ArcOf(10, 0, 10, 180, 90, true));
  CHECK(arc.fit.kind == GridArc::Kind::kArc);
  CHECK(arc.fit.center[0] == 10000);
  CHECK(arc.fit.center[1] == 0);
}

TEST_CASE("the two radii of a written arc agree within two increments, wherever it lies") {
  for (int i = 0; i < 20000; ++i) {
    const double radius = 0.01 + 0.37 * i;
    const ExactArc exact =
        ArcOf(17.3 * std::sin(i * 0.7), -11.9 * std::cos(i * 1.3), radius, i * 7.13, 1 + i % 358, i % 2 == 0);
    const Rounded arc = Fit(exact);
    if (arc.fit.kind == GridArc::Kind::kLine) {
      // Only where both ends are next to each other.
      REQUIRE(std::hypot(arc.to[0] - arc.from[0], arc.to[1] - arc.from[1]) <= 2.0);
      continue;
    }
    REQUIRE(arc.fit.kind == GridArc::Kind::kArc);
    const double i0 = static_cast<double>(arc.fit.center[0]);
    const double j0 = static_cast<double>(arc.fit.center[1]);
    const double start = std::hypot(i0, j0);
    const double end = std::hypot(static_cast<double>(arc.to[0] - arc.from[0]) - i0,
                                  static_cast<double>(arc.to[1] - arc.from[1]) - j0);
    REQUIRE(std::fabs(start - end) <= 2.0);
    // The centre has the error of two words, no more (contracts section 6).
    REQUIRE(std::fabs(static_cast<double>(arc.from[0]) + i0 - exact.center[0] * 1000) <= 1.0 + 1e-6);
    REQUIRE(std::fabs(static_cast<double>(arc.from[1]) + j0 - exact.center[1] * 1000) <= 1.0 + 1e-6);
    // The written arc turns as far as the exact one.
    const ExactArc written{{0, 0},
                           {static_cast<double>(arc.to[0] - arc.from[0]), static_cast<double>(arc.to[1] - arc.from[1])},
                           {i0, j0},
                           exact.clockwise,
                           false};
    REQUIRE(std::fabs(SweepOf(written) - SweepOf(exact)) * start <= 4.0);
  }
}

TEST_CASE("a tiny arc whose ends fall together is a line, not a full circle") {
  const Rounded arc = Fit(ArcOf(0, 0, 5, 10, 0.002, false));
  CHECK(arc.from[0] == arc.to[0]);
  CHECK(arc.from[1] == arc.to[1]);
  CHECK(arc.fit.kind == GridArc::Kind::kLine);
}

TEST_CASE("an arc that nearly closes stays one") {
  // Ends fall together: the written full circle differs by less than an increment.
  for (int i = 0; i < 2000; ++i) {
    const Rounded arc = Fit(ArcOf(0, 0, 20, i * 0.18, 359.9985, i % 2 == 0));
    REQUIRE(arc.fit.kind == GridArc::Kind::kArc);
  }
}

TEST_CASE("a circle smaller than an increment is a line") {
  ExactArc arc = ArcOf(0, 0, 0.0003, 0, 360, false);
  arc.full_circle = true;
  CHECK(Fit(arc).fit.kind == GridArc::Kind::kLine);
}

TEST_CASE("radii that differ beyond the tolerance are refused") {
  ExactArc arc = ArcOf(0, 0, 10, 0, 90, false);
  arc.to[1] = 10.1;
  const Rounded fit = Fit(arc);
  CHECK(fit.fit.kind == GridArc::Kind::kBroken);
  CHECK(fit.fit.start_radius == doctest::Approx(10).epsilon(0.001));
  CHECK(fit.fit.end_radius == doctest::Approx(10.1).epsilon(0.001));
}

TEST_CASE("a diameter axis counts half") {
  // X is written as a diameter: increments of 0.0005 mm on the radius.
  const ExactArc exact = ArcOf(0, 20, 5, -90, 90, false);
  const ArcGrid grid{.increment = 0.001, .unit = {0.001, 0.0005}};
  const std::int64_t from[2] = {RoundToIncrements(exact.from[0], 1000), RoundToIncrements(exact.from[1], 2000)};
  const std::int64_t to[2] = {RoundToIncrements(exact.to[0], 1000), RoundToIncrements(exact.to[1], 2000)};
  CHECK(from[1] == 30000);
  const GridArc fit = FitArc(exact, from, to, grid, 0.01);
  CHECK(fit.kind == GridArc::Kind::kArc);
  CHECK(fit.center[0] == 0);
  CHECK(fit.center[1] == 5000);
}

}  // namespace
}  // namespace ncport::backends::iso
