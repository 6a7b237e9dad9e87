#include "ir/transform/resolve_increments.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

Machine Control() {
  Machine machine;
  machine.increment = 0.001;
  machine.start.units = Units::kMm;
  machine.start.feed_mode = FeedMode::kPerMinute;
  machine.start.motion = Motion::kLinear;
  machine.units = {.feed_per_minute = 1,
                   .feed_per_minute_inch = 0.01,
                   .feed_per_revolution = 0.01,
                   .feed_per_revolution_inch = 0.0001};
  return machine;
}

std::string Resolved(std::string_view blocks, diag::Sink& sink, const Machine& machine = Control()) {
  const std::string text = test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n" + test::WithCells(blocks), sink,
      [&](Module& module, diag::Sink& findings) { return ResolveIncrements(module, machine, {}, findings); });
  return test::Brief(text.substr(text.find('\n') + 1));
}

TEST_CASE("lengths, angles and times in the unit of their word (mm)") {
  diag::Sink sink;
  CHECK(Resolved(
            "  @m:1 : axis X = 100 {increments}; axis C = 1500 {increments}; center I = -7 {increments}\n"
            "  @m:2 : radius = 250 {increments}; contour-angle = 45000 {increments}; chamfer length = 10 {increments}\n"
            "  @m:3 : dwell-seconds = 1500 {increments}; frame-angle = 30000 {increments}; frame-factor = 2000 "
            "{increments}; start-angle = 90000 {increments}\n"
            "  @m:4 : cycle-value dwell = 500 {increments}; cycle-value level = 2000 {increments}\n",
            sink) ==
        "axis X = 0.1; axis C = 1.5; center I = -0.007\n"
        "radius = 0.25; contour-angle = 45; chamfer length = 0.01\n"
        "dwell-seconds = 1.5; frame-angle = 30; frame-factor = 2; start-angle = 90\n"
        "cycle-value dwell = 0.5; cycle-value level = 2\n");
  CHECK(sink.Empty());
}

TEST_CASE("lengths under inch are tenths of a thousandth; angles and times do not follow the unit") {
  diag::Sink sink;
  CHECK(Resolved("  @m:1 : units inch; axis X = 100 {increments}; axis C = 1500 {increments}\n"
                 "  @m:2 : dwell-seconds = 1500 {increments}; cycle-value level = 2000 {increments}\n",
                 sink) ==
        "units inch; axis X = 0.01; axis C = 1.5\n"
        "dwell-seconds = 1.5; cycle-value level = 0.2\n");
  CHECK(sink.Empty());
}

TEST_CASE("the nearest decimal number comes out, not the product with a binary thousandth") {
  diag::Sink sink;
  CHECK(Resolved("  @m:1 : axis X = 3 {increments}; axis Y = 1001 {increments}; axis Z = 999999 {increments}\n",
                 sink) == "axis X = 0.003; axis Y = 1.001; axis Z = 999.999\n");
}

TEST_CASE("a feed counts by its mode; a thread's is per revolution whatever the mode") {
  diag::Sink sink;
  CHECK(Resolved("  @m:1 : feed = 100 {increments}\n"
                 "  @m:2 : feed-mode per-revolution; feed = 20 {increments}\n"
                 "  @m:3 : feed-mode inverse-time; feed = 5 {increments}\n"
                 "  @m:4 : feed-mode per-minute; units inch; feed = 300 {increments}\n"
                 "  @m:5 : units mm; motion thread; feed = 150 {increments}\n",
                 sink) ==
        "feed = 100\n"
        "feed-mode per-revolution; feed = 0.2\n"
        "feed-mode inverse-time; feed = 5\n"
        "feed-mode per-minute; units inch; feed = 3\n"
        "units mm; motion thread; feed = 1.5\n");
  CHECK(sink.Empty());
}

TEST_CASE("a feed whose mode is not known stays readable only where both modes count alike") {
  Machine machine = Control();
  machine.start.feed_mode = FeedMode::kUnknown;
  {
    diag::Sink sink;
    Resolved("  @m:1 : feed = 100 {increments}\n", sink, machine);
    CHECK(test::CodesOf(sink) == "NC5006");
  }
  machine.units = {};
  {
    diag::Sink sink;
    CHECK(Resolved("  @m:1 : feed = 100 {increments}\n", sink, machine) == "feed = 100\n");
    CHECK(sink.Empty());
  }
}

TEST_CASE("arguments of calls count as the axis of their letter") {
  diag::Sink sink;
  CHECK(Resolved("  @m:1 : call name SUB (0 X increments: 100, 1 B increments: 100, 2 Z: 100, 3 I increments: R[1])\n"
                 "  @m:2 : units inch; modal-call name SUB (0 X increments: 100, 1 B increments: 100)\n"
                 "  @m:3 : modal-call\n",
                 sink) ==
        "call name SUB (0 X: 0.1, 1 B: 0.1, 2 Z: 100, 3 I: mul(R[1], 0.001))\n"
        "units inch; modal-call name SUB (0 X: 0.01, 1 B: 0.1)\n"
        "modal-call\n");
  CHECK(sink.Empty());
}

TEST_CASE("data of the control stay as written") {
  diag::Sink sink;
  const std::string same = "data-setting name - (0 X increments: 100, 1 P: 1)\n";
  CHECK(Resolved("  @m:1 : " + same, sink) == same);
  CHECK(sink.Empty());
}

TEST_CASE("where ways with different units meet, each such word is a finding and the others go on") {
  diag::Sink sink;
  CHECK(Resolved("  @m:1 : jump forward label A = lt(R[1], 2)\n"
                 "  @m:2 : units inch\n"
                 "  @m:3 label A : axis X = 100 {increments}; axis C = 100 {increments}\n"
                 "  @m:4 : call name SUB (0 X increments: 100)\n"
                 "  @m:5 : axis X = 1.5; units mm\n"
                 "  @m:6 : axis X = 100 {increments}\n",
                 sink) ==
        "jump forward label A = lt(R[1], 2)\n"
        "units inch\n"
        "label A axis X = 100 {increments}; axis C = 0.1\n"
        "call name SUB (0 X increments: 100)\n"
        "axis X = 1.5; units mm\n"
        "axis X = 0.1\n");
  CHECK(test::CodesOf(sink) == "NC5006 NC5006");
}

TEST_CASE("words that say what they are stay to the digit") {
  diag::Sink sink;
  const std::string same = "axis X = 010.50; axis Y = -.5; feed = 100; dwell-seconds = 2\naxis Z = R[1]\n";
  CHECK(Resolved("  @m:1 : axis X = 010.50; axis Y = -.5; feed = 100; dwell-seconds = 2\n"
                 "  @m:2 : axis Z = R[1]\n",
                 sink) == same);
  CHECK(sink.Empty());
}

}  // namespace
}  // namespace ncport::ir::transform
