#include "prove/recorded_trace.h"

#include <doctest/doctest.h>

namespace ncport::prove {
namespace {

TEST_CASE("an arc with additional turns counts as circles and the rest, the depth even over the whole angle") {
  RecordedTrace trace;
  exec::Event arc;
  arc.kind = exec::EventKind::kArc;
  arc.turns = 2;
  arc.known_axes = arc.moved_axes = 7;
  arc.from[0] = 10;
  arc.position[1] = 10;
  arc.position[2] = -9;  // 810 degrees
  REQUIRE(trace.OnEvent(arc));
  REQUIRE(trace.Events().size() == 3);
  for (std::size_t i = 0; i < 2; ++i) {
    const exec::Event& circle = trace.Events()[i];
    CHECK(circle.full_circle);
    CHECK(circle.turns == 0);
    CHECK(circle.position[0] == 10);
    CHECK(circle.position[1] == 0);
    CHECK(circle.position[2] == doctest::Approx(-4.0 * (static_cast<double>(i) + 1)));
  }
  const exec::Event& rest = trace.Events()[2];
  CHECK_FALSE(rest.full_circle);
  CHECK(rest.turns == 0);
  CHECK(rest.from[2] == doctest::Approx(-8));
  CHECK(rest.position[1] == 10);
  CHECK(rest.position[2] == -9);
}

}  // namespace
}  // namespace ncport::prove
