#include "app/envelope.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::app {
namespace {

using exec::Event;
using exec::EventKind;

struct Bench {
  void Tool(std::uint32_t number, bool waits = false) {
    Event event;
    event.kind = EventKind::kTool;
    event.number = number;
    event.tool_waits = waits;
    envelopes.OnEvent(event);
  }
  void Move(EventKind kind, double x, double y, double feed = 0) {
    Event event;
    event.kind = kind;
    event.known_axes = event.moved_axes = 0b011;
    event.from[0] = at[0];
    event.from[1] = at[1];
    event.position[0] = at[0] = x;
    event.position[1] = at[1] = y;
    event.feed = feed;
    envelopes.OnEvent(event);
  }
  [[nodiscard]] std::vector<ReportEnvelope> Result(const dialects::Config* config = nullptr) const {
    return envelopes.Result(files, config);
  }
  ir::Module module;
  SourceFiles files;
  Envelopes envelopes{module, nullptr};
  double at[2] = {};
};

TEST_CASE("each tool has the ends of its moves, its approaches and its largest speed and feed") {
  Bench bench;
  bench.Tool(1);
  Event speed;
  speed.kind = EventKind::kSpindleSpeed;
  for (const double value : {900.0, 1200.0, 100.0}) {
    speed.value = value;
    bench.envelopes.OnEvent(speed);
  }
  bench.Move(EventKind::kRapid, 10, 5);
  bench.Move(EventKind::kLine, 20, -5, 200);
  bench.Move(EventKind::kLine, 15, 0, 300);
  bench.Move(EventKind::kRapid, 40, 50);
  bench.Move(EventKind::kLine, 41, 50, 100);
  bench.Tool(2, true);
  bench.Move(EventKind::kRapid, 60, 50);  // tool 2 only stands ready
  Event change;
  change.kind = EventKind::kAux;
  change.number = 6;
  change.tool_change = true;
  bench.envelopes.OnEvent(change);
  bench.Move(EventKind::kRapid, -7, 0);
  const auto result = bench.Result();
  REQUIRE(result.size() == 2);
  CHECK(result[0].tool == "T1");
  REQUIRE(result[0].axes.size() == 2);
  CHECK(result[0].axes[0].low == 10);
  CHECK(result[0].axes[0].high == 60);
  CHECK(result[0].axes[1].low == -5);
  CHECK(*result[0].speed == 1200);
  CHECK(*result[0].feed == 300);
  CHECK_FALSE(result[0].feed_per_revolution);
  REQUIRE(result[0].first_approach);
  CHECK(result[0].first_approach->axes[0].second == 10);
  CHECK(result[0].last_approach->axes[0].second == 40);
  CHECK(result[1].tool == "T2");
  CHECK(result[1].axes[0].low == -7);
  CHECK_FALSE(result[1].first_approach);
}

TEST_CASE("an arc reaches beyond its ends") {
  Bench bench;
  bench.Move(EventKind::kRapid, 10, 0);
  Event arc;
  arc.kind = EventKind::kArc;
  arc.known_axes = 0b011;
  arc.from[0] = 10;
  arc.position[0] = -10;
  arc.radius = 10;
  SUBCASE("counter-clockwise over the top") {
    bench.envelopes.OnEvent(arc);
    CHECK(bench.Result()[0].axes[1].high == 10);
    CHECK(bench.Result()[0].axes[1].low == 0);
  }
  SUBCASE("clockwise below") {
    arc.clockwise = true;
    bench.envelopes.OnEvent(arc);
    CHECK(bench.Result()[0].axes[1].high == 0);
    CHECK(bench.Result()[0].axes[1].low == -10);
  }
  SUBCASE("a full circle all around") {
    arc.position[0] = 10;
    arc.full_circle = true;
    bench.envelopes.OnEvent(arc);
    CHECK(bench.Result()[0].axes[0].low == -10);
    CHECK(bench.Result()[0].axes[1].high == 10);
  }
  CHECK(bench.Result()[0].axes[0].high == 10);
}

TEST_CASE("limits of the folder stand beside the values") {
  Bench bench;
  bench.Move(EventKind::kRapid, 10, 0);
  dialects::Config config;
  config.limits.push_back({"x", -5, 5, {}});
  config.limits.push_back({"spindle", 0, 3500, {}});
  const auto result = bench.Result(&config);
  CHECK(*result[0].axes[0].high_limit == 5);
  CHECK_FALSE(result[0].axes[1].high_limit);
  CHECK(*result[0].speed_limit == 3500);
  CHECK_FALSE(result[0].feed_limit);
}

}  // namespace
}  // namespace ncport::app
