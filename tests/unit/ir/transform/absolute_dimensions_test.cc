#include "ir/transform/absolute_dimensions.h"

#include <regex>

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

/// In texts here R[1] is a cell; types, and that a number was computed, are left out.
std::string Absolute(const std::string& blocks, diag::Sink& sink, bool work_frames_in = false,
                     AbsoluteDimensionsConfig::Corners corners = AbsoluteDimensionsConfig::Corners::kNone) {
  const std::string cells = std::regex_replace(blocks, std::regex("R\\["), "cell:real R[");
  const std::string text =
      test::After("ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n" + cells, sink,
                  [&](Module& module, diag::Sink& findings) {
                    Machine machine;
                    AbsoluteDimensionsConfig config;
                    config.work_frames_in = work_frames_in;
                    config.corners_to_moves = corners;
                    machine.start.comp = CutterComp::kOff;
                    machine.start.motion = Motion::kLinear;
                    machine.start.plane = Plane::kXY;
                    machine.start.distance = Distance::kAbsolute;
                    machine.start.units = Units::kMm;
                    machine.start.diameter = Diameter::kRadius;
                    return AbsoluteDimensions(module, machine, config, findings);
                  });
  const std::string numbers = std::regex_replace(text, std::regex("literal\\(([-0-9.]+), computed\\)"), "$1");
  return std::regex_replace(numbers, std::regex("cell:real |:(real|int)"), "");
}

TEST_CASE("an increment is the position that it leads to; in a loop that is held in a local") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 1\n"
                 "  @m:2 : axis X incremental = 2\n"
                 "  @m:3 label L : axis X incremental = 1\n"
                 "  @m:4 : jump backward label L = lt!tolerance:bool(R[1], 4)\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 1\n"
        "axis X absolute = 3\n"
        "assign variable POS_X = 3\n"
        "label L axis X absolute = add(variable POS_X, 1)\n"
        "assign variable POS_X = add(variable POS_X, 1)\n"
        "jump backward label L = lt!tolerance:bool(R[1], 4)\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("where a part with computed ends may run any block, no increment has a known start") {
  diag::Sink sink;
  Absolute(
      "  @m:1 : repeat-part first expression R[1]\n"
      "  @m:2 : axis X = 1\n"
      "  @m:3 : axis X incremental = 2\n",
      sink);
  CHECK(sink.HasErrors());
}

TEST_CASE("opening angles become centres and end points (sinumerik-8.3)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 0; axis Y = 0\n"
                 "  @m:2 : motion arc-ccw; axis X = 20; opening-angle = 180; feed = 100\n"
                 "  @m:3 : motion arc-cw; center I step = -10; opening-angle = 90\n"
                 "  @m:4 : axis X incremental = 1; motion linear\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 0; axis Y absolute = 0\n"
        "motion arc-ccw; axis X absolute = 20; center I step = 10; center J step = 0; feed = 100\n"
        "motion arc-cw; axis X absolute = 10; axis Y absolute = -10; center I step = -10\n"
        "axis X absolute = 11; motion linear\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("an opening angle without a known start, or computed, is refused") {
  for (const std::string_view blocks : {"  @m:1 : motion arc-ccw; axis X = 20; axis Y = 0; opening-angle = 180\n",
                                        "  @m:1 : axis X = 0; axis Y = 0\n"
                                        "  @m:2 : motion arc-ccw; axis X = 20; opening-angle = R[1]\n",
                                        "  @m:1 : axis X = 0; axis Y = 0\n"
                                        "  @m:2 : motion arc-ccw; axis X = 20; opening-angle = 360\n",
                                        "  @m:1 : axis X = 0; axis Y = 0\n"
                                        "  @m:2 : motion arc-ccw; opening-angle = 90\n"}) {
    CAPTURE(blocks);
    diag::Sink sink;
    Absolute(std::string(blocks), sink);
    CHECK(sink.HasErrors());
  }
}

TEST_CASE("an intermediate point becomes centre and sense (sinumerik-8.3)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = R[1]; axis Y = 0; axis Z = 0\n"
                 "  @m:2 : motion arc-via; axis X = add(R[1], 20); via I = add(R[1], 10); via J = -10\n"
                 "  @m:3 : axis X incremental = -20; via I incremental = -10; via J incremental = -10\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = R[1]; axis Y absolute = 0; axis Z absolute = 0\n"
        "motion arc-ccw; axis X absolute = add(R[1], 20); center I step = 10; center J step = 0\n"
        "motion arc-cw; axis X absolute = R[1]; center I step = -10; center J step = 0\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("an intermediate point on a line, or out of the plane, is refused") {
  for (const std::string_view via : {"via I = 10; via J = 0", "via I = 10; via K = 5"}) {
    CAPTURE(via);
    diag::Sink sink;
    Absolute(
        "  @m:1 : axis X = 0; axis Y = 0; axis Z = 0\n  @m:2 : motion arc-via; axis X = 20; " + std::string(via) + "\n",
        sink);
    CHECK(sink.HasErrors());
  }
}

TEST_CASE("polar words turn about their pole and stay until changed (sinumerik-8.6)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 1; axis Y = 2; axis Z = 3\n"
                 "  @m:2 : pole workpiece-zero; axis X = 20; axis Y = 10\n"
                 "  @m:3 : polar-radius = 50; polar-angle = 90; feed = 100\n"
                 "  @m:4 : polar-angle incremental = 90\n"
                 "  @m:5 : motion arc-ccw; polar-angle = 270\n"
                 "  @m:6 : pole last-position; axis Y = 5\n"
                 "  @m:7 : motion linear; polar-angle = 0; axis Z = 1\n"
                 "  @m:8 : plane zx\n"
                 "  @m:9 : polar-angle = 0; polar-radius = R[1]\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 1; axis Y absolute = 2; axis Z absolute = 3\n"
        "axis X absolute = 20; axis Y absolute = 60; feed = 100\n"
        "axis X absolute = -30; axis Y absolute = 10\n"
        "motion arc-ccw; axis X absolute = 20; axis Y absolute = -40; center I step = 50; center J step = 0\n"
        "motion linear; axis X absolute = 70; axis Y absolute = -35; axis Z absolute = 1\n"
        "plane zx\n"
        "polar-angle = 0; polar-radius = R[1]\n");
  CHECK(sink.HasErrors());  // R1 may be negative
}

TEST_CASE("a polar angle that grows in a loop is held in a local, a variable radius must not be negative") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 0; axis Y = 0\n"
                 "  @m:2 : assign R[1] = 5\n"
                 "  @m:3 : polar-radius = R[1]; polar-angle = 0\n"
                 "  @m:4 label L : polar-angle incremental = 15\n"
                 "  @m:5 : jump backward label L = lt!tolerance:bool(R[2], 4)\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 0; axis Y absolute = 0\n"
        "assign R[1] = 5\n"
        "axis X absolute = R[1]; axis Y absolute = 0\n"
        "assign variable POLAR_ANGLE = 0\n"
        "label L axis X absolute = mul(R[1], call cos(add(variable POLAR_ANGLE, 15))); "
        "axis Y absolute = mul(R[1], call sin(add(variable POLAR_ANGLE, 15)))\n"
        "assign variable POLAR_ANGLE = add(variable POLAR_ANGLE, 15)\n"
        "jump backward label L = lt!tolerance:bool(R[2], 4)\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a position that reads a local is taken before the local changes") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 0; axis Y = 0\n"
                 "  @m:2 : polar-radius = 10; polar-angle = 0\n"
                 "  @m:3 label L : polar-angle incremental = 15\n"
                 "  @m:4 : axis X incremental = 1\n"
                 "  @m:5 : jump backward label L = lt!tolerance:bool(R[2], 4)\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 0; axis Y absolute = 0\n"
        "axis X absolute = 10; axis Y absolute = 0\n"
        "assign variable POLAR_ANGLE = 0\n"
        "label L axis X absolute = mul(10, call cos(add(variable POLAR_ANGLE, 15))); "
        "axis Y absolute = mul(10, call sin(add(variable POLAR_ANGLE, 15)))\n"
        "assign variable POS_X = mul(10, call cos(add(variable POLAR_ANGLE, 15)))\n"
        "assign variable POLAR_ANGLE = add(variable POLAR_ANGLE, 15)\n"
        "axis X absolute = add(variable POS_X, 1)\n"
        "jump backward label L = lt!tolerance:bool(R[2], 4)\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("polar words without a known pole, angle or radius are refused") {
  for (const std::string_view blocks :
       {"  @m:1 : polar-radius = 5\n", "  @m:1 : polar-angle = 5\n",
        "  @m:1 : polar-radius = 5; polar-angle incremental = 5\n",
        "  @m:1 : polar-radius = 5; polar-angle = 5; axis X = 5\n", "  @m:1 : polar-radius = -5; polar-angle = 5\n",
        "  @m:1 : pole last-position; axis X = 5\n",
        "  @m:1 : polar-radius = 5; polar-angle = 5\n"
        "  @m:2 : pole workpiece-zero; axis X = 5\n"
        "  @m:3 : polar-radius = 5\n"}) {
    CAPTURE(blocks);
    diag::Sink sink;
    Absolute(std::string(blocks), sink);
    CHECK(sink.HasErrors());
  }
}

TEST_CASE("a position is followed through a shift that stays in the program (sinumerik-8.2)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 4; axis Y = 1\n"
                 "  @m:2 : frame translate; axis X = 50\n"
                 "  @m:3 : axis X incremental = 1\n"
                 "  @m:4 : frame add-translate; axis X = R[1]\n"
                 "  @m:5 : axis X incremental = 1\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 4; axis Y absolute = 1\n"
        "frame translate; axis X = 50\n"
        "axis X absolute = -45\n"
        "frame add-translate; axis X = R[1]\n"
        "axis X absolute = sub(negate(R[1]), 44)\n");
}

TEST_CASE("frames go into the coordinates, in the order in which they were added (sinumerik-8.7)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 1; axis Y = 1\n"
                 "  @m:2 : frame translate; axis X = 10\n"
                 "  @m:3 : frame add-rotate; frame-angle = 90\n"
                 "  @m:4 : frame add-translate; axis X = 5\n"
                 "  @m:5 : axis X = 3; axis Y = 0\n"
                 "  @m:6 : axis Y = 2\n"
                 "  @m:7 : axis X incremental = 1\n"
                 "  @m:8 : frame rotate\n"
                 "  @m:9 : axis Y incremental = 1\n",
                 sink, true) ==
        "program M main\n"
        "axis X absolute = 1; axis Y absolute = 1\n"
        "axis X absolute = 10; axis Y absolute = 8\n"
        "axis X absolute = 8\n"
        "axis Y absolute = 9\n"
        "axis Y absolute = 10\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a mirror turns arcs and the side of the cutter, a scale their size (sinumerik-8.7)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 0; axis Y = 0\n"
                 "  @m:2 : motion arc-cw; axis X = 4; axis Y = 4; center J step = 4\n"
                 "  @m:3 : frame mirror; axis X = 0\n"
                 "  @m:4 : frame add-scale; axis X = 2; axis Y = 2\n"
                 "  @m:5 : comp left; motion linear; axis X = 5; axis Y = 5\n"
                 "  @m:6 : motion arc-cw; axis X = 8; axis Y = 8; radius = -5\n"
                 "  @m:7 : axis X = 8; axis Y = 2; center J step = -3\n",
                 sink, true) ==
        "program M main\n"
        "axis X absolute = 0; axis Y absolute = 0\n"
        "motion arc-cw; axis X absolute = 4; axis Y absolute = 4; center J step = 4\n"
        "comp right; motion linear; axis X absolute = -10; axis Y absolute = 10\n"
        "motion arc-ccw; axis X absolute = -16; axis Y absolute = 16; radius = -10\n"
        "motion arc-ccw; axis X absolute = -16; axis Y absolute = 4; center I step = 0; center J step = -6\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("an arc by its radius keeps its centre under a rotation") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : frame rotate; frame-angle = 30\n"
                 "  @m:2 : axis X = 0; axis Y = 0\n"
                 "  @m:3 : motion arc-cw; axis X = 10; radius = 5\n",
                 sink, true) ==
        "program M main\n"
        "axis X absolute = 0; axis Y absolute = 0\n"
        "motion arc-cw; axis X absolute = 8.660254038; axis Y absolute = 5; center I step = 4.330127019; "
        "center J step = 2.5\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("frames that no coordinates can take are refused") {
  for (const std::string_view blocks : {
           // Another axis is not known.
           "  @m:1 : frame rotate; frame-angle = 30\n  @m:2 : axis X = 1\n",
           // A computed angle.
           "  @m:1 : frame rotate; frame-angle = R[1]\n  @m:2 : axis X = 1; axis Y = 1\n",
           // Not the same on every way.
           "  @m:1 : jump forward label L = lt!tolerance:bool(R[1], 4)\n"
           "  @m:2 : frame rotate; frame-angle = 30\n  @m:3 label L : axis X = 1; axis Y = 1\n",
           // No circle any more.
           "  @m:1 : axis X = 0; axis Y = 0\n  @m:2 : frame scale; axis X = 2\n"
           "  @m:3 : motion arc-cw; axis X = 10; radius = 5\n",
           // The sides of the cutter would be exchanged while it is on one.
           "  @m:1 : axis X = 0; axis Y = 0; comp left\n  @m:2 : frame mirror; axis X = 0\n",
           // A lead does not turn.
           "  @m:1 : axis X = 0; axis Y = 0; axis Z = 0\n  @m:2 : frame rotate; frame-angle = 30\n"
           "  @m:3 : motion thread; axis Z = 10; center K step = 1\n",
           "  @m:1 : frame scale; axis X = 0\n  @m:2 : axis X = 1\n",
       }) {
    CAPTURE(blocks);
    diag::Sink sink;
    Absolute(std::string(blocks), sink, true);
    CHECK(sink.HasErrors());
  }
}

TEST_CASE("a position crosses calls in a cell when increments on the other side need it") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 1; axis Y = 2\n"
                 "  @m:2 : call name S calls S\n"
                 "  @m:3 : axis X incremental = 5\n"
                 "  @m:4 : call name S calls S passes 2\n"
                 "program S sub @m:0\n"
                 "  @m:5 : axis X incremental = 1; axis Y = 7\n"
                 "  @m:6 : return plain\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 1; axis Y absolute = 2\n"
        "assign AT_X[0] = 1\n"
        "call name S calls S\n"
        "axis X absolute = add(AT_X[0], 5)\n"
        "assign AT_X[0] = add(AT_X[0], 5)\n"
        "call name S calls S passes 2\n"
        "program S sub\n"
        "axis X absolute = add(AT_X[0], 1); axis Y absolute = 7\n"
        "assign AT_X[0] = add(AT_X[0], 1)\n"
        "return plain\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a loop that begins with an increment takes the position out of its cell first") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 1\n"
                 "  @m:2 : call name S calls S\n"
                 "program S sub @m:0\n"
                 "  @m:5 label L : axis X incremental = 2\n"
                 "  @m:6 : jump backward label L = lt!tolerance:bool(R[1], 4)\n"
                 "  @m:7 : return plain\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 1\n"
        "assign AT_X[0] = 1\n"
        "call name S calls S\n"
        "program S sub\n"
        "assign variable POS_X = AT_X[0]\n"
        "label L axis X absolute = add(variable POS_X, 2)\n"
        "assign variable POS_X = add(variable POS_X, 2)\n"
        "jump backward label L = lt!tolerance:bool(R[1], 4)\n"
        "return plain\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a return beside a move: the position is in its cell before the block acts") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 1\n"
                 "  @m:2 : call name S calls S\n"
                 "  @m:3 : axis X incremental = 5\n"
                 "program S sub @m:0\n"
                 "  @m:5 : axis X incremental = 1; return auxiliary\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 1\n"
        "assign AT_X[0] = 1\n"
        "call name S calls S\n"
        "axis X absolute = add(AT_X[0], 5)\n"
        "program S sub\n"
        "assign variable POS_X = AT_X[0]\n"
        "assign AT_X[0] = add(variable POS_X, 1)\n"
        "axis X absolute = add(variable POS_X, 1); return auxiliary\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a position does not cross a call that one caller makes without knowing it, or that moves the zero point") {
  constexpr std::string_view kIncrement =
      "program S sub @m:0\n"
      "  @m:5 : axis X incremental = 1\n"
      "  @m:6 : return plain\n";
  for (const std::string& text :
       {"  @m:1 : axis Y = 1\n  @m:2 : call name S calls S\n" + std::string(kIncrement),
        "  @m:1 : axis X = 1\n  @m:2 : call name S calls S\n  @m:3 : work-offset #55\n  @m:4 : call name S calls S\n" +
            std::string(kIncrement),
        "  @m:1 : axis X = 1\n  @m:2 : modal-call name S calls S\n  @m:3 : axis Y = 1\n" + std::string(kIncrement),
        std::string("  @m:1 : axis X = 1\n  @m:2 : call name S calls S\n  @m:3 : axis X incremental = 1\n"
                    "program S sub @m:0\n  @m:5 : work-offset #55\n  @m:6 : return plain\n")}) {
    CAPTURE(text);
    diag::Sink sink;
    Absolute(text, sink);
    CHECK(sink.HasErrors());
  }
}

TEST_CASE("additional turns become circles, the depth runs evenly over the whole angle (sinumerik-8.3)") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 10; axis Y = 0; axis Z = 0\n"
                 "  @m:2 N20 : motion arc-ccw; axis X = 0; axis Y = 10; axis Z = -5; center I step = -10; turns = 1; "
                 "feed = 9\n"
                 "  @m:3 : axis Z = -9; center J step = -10; turns = 1\n"
                 "  @m:4 : axis X = 10; axis Y = 0; center J step = -10; turns = 0\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 10; axis Y absolute = 0; axis Z absolute = 0\n"
        "N20 motion arc-ccw; axis Z absolute = -4; center I step = -10; feed = 9\n"
        "motion arc-ccw; axis X absolute = 0; axis Y absolute = 10; axis Z absolute = -5; center I step = -10\n"
        "motion arc-ccw; axis Z absolute = -7; center J step = -10\n"
        "motion arc-ccw; axis Z absolute = -9; center J step = -10\n"
        "axis X absolute = 10; axis Y absolute = 0; center J step = -10\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a position that additional turns share is taken out of its cell before that changes") {
  diag::Sink sink;
  CHECK(Absolute("  @m:1 : axis X = 10; axis Y = 0; axis Z = R[1]\n"
                 "  @m:2 : assign R[1] = 0\n"
                 "  @m:3 : motion arc-ccw; axis Z = -5; center I step = -10; turns = 1; feed = 9\n",
                 sink) ==
        "program M main\n"
        "axis X absolute = 10; axis Y absolute = 0; axis Z absolute = R[1]\n"
        "assign variable POS_Z = R[1]\n"
        "assign R[1] = 0\n"
        "motion arc-ccw; axis Z absolute = sub(mul(0.5, variable POS_Z), 2.5); center I step = -10; feed = 9\n"
        "motion arc-ccw; axis Z absolute = -5; center I step = -10\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("lengths and feeds under a unit that is not one on every way are refused where one of them is inches") {
  for (const std::string behind : {"axis X = 5", "feed = 5", "center I step = 5"}) {
    for (const bool inch : {true, false}) {
      CAPTURE(behind);
      diag::Sink sink;
      Absolute(
          "  @m:1 : axis X = 10; axis Y = 0; axis Z = 0\n"
          "  @m:2 skip 1 : units " +
              std::string(inch ? "inch" : "mm") + "\n  @m:3 : " + behind + "\n",
          sink);
      CHECK(sink.HasErrors() == inch);
    }
  }
}

TEST_CASE("turns that cannot be written out are refused") {
  for (const std::string_view arc :
       {"axis X = 0; axis Y = 10; radius = 10; turns = 1", "center I step = -10; turns = R[1]",
        "center I step = -10; turns = 500", "axis Z = -5; center I step = R[1]; axis X = 0; turns = 1"}) {
    CAPTURE(arc);
    diag::Sink sink;
    Absolute("  @m:1 : axis X = 10; axis Y = 0; axis Z = 0\n  @m:2 : motion arc-cw; " + std::string(arc) + "\n", sink);
    CHECK(sink.HasErrors());
  }
}

TEST_CASE("corners between straight moves become moves (sinumerik-8.9)") {
  diag::Sink sink;
  const std::string text =
      "  @m:1 : axis X = 0; axis Y = 0\n"
      "  @m:2 : axis X = 20; chamfer leg = 5\n"
      "  @m:3 : axis Y = 20; chamfer length = 2.8284271247461903\n"
      "  @m:4 : axis X = 40; chamfer round = 4\n"
      "  @m:5 : axis Y = 40\n"
      "  @m:6 : axis X incremental = 1\n";
  CHECK(Absolute(text, sink, false, AbsoluteDimensionsConfig::Corners::kAll) ==
        "program M main\n"
        "axis X absolute = 0; axis Y absolute = 0\n"
        "axis X absolute = 15\n"
        "motion linear; axis X absolute = 20; axis Y absolute = 5\n"
        "motion linear; axis Y absolute = 18\n"
        "motion linear; axis X absolute = 22; axis Y absolute = 20\n"
        "motion linear; axis X absolute = 36\n"
        "motion arc-ccw; axis X absolute = 40; axis Y absolute = 24; center I step = 0; center J step = 4\n"
        "motion linear; axis Y absolute = 40\n"
        "axis X absolute = 41\n");
  CHECK_FALSE(sink.HasErrors());
  const std::string lengths = Absolute(text, sink, false, AbsoluteDimensionsConfig::Corners::kByLength);
  CHECK(lengths.find("axis X absolute = 20; chamfer leg = 5\n") != std::string::npos);
  CHECK(lengths.find("chamfer length") == std::string::npos);
}

TEST_CASE("a corner that is longer than its side, or whose side is computed, is refused") {
  for (const std::string_view sides :
       {"axis X = 20; chamfer leg = 25\n  @m:3 : axis Y = 20", "axis X = 20; chamfer leg = 5\n  @m:3 : axis Y = 4",
        "axis X = 20; chamfer round = 5\n  @m:3 : axis X = 4", "axis X = R[1]; chamfer leg = 5\n  @m:3 : axis Y = 20",
        "axis X = 20; chamfer leg = 5\n  @m:3 : axis Y = 8; chamfer leg = 4\n  @m:4 : axis X = 40"}) {
    CAPTURE(sides);
    diag::Sink sink;
    Absolute("  @m:1 : axis X = 0; axis Y = 0\n  @m:2 : " + std::string(sides) + "\n", sink, false,
             AbsoluteDimensionsConfig::Corners::kAll);
    CHECK(sink.HasErrors());
  }
}

/// As Absolute, with increments kept; the target rounds to 0.001.
std::string Kept(const std::string& blocks, diag::Sink& sink, KeepIncrements keep, KeptIncrements& kept) {
  const std::string cells = std::regex_replace(blocks, std::regex("R\\["), "cell:real R[");
  const std::string text = test::After("ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\n" + cells, sink,
                                       [&](Module& module, diag::Sink& findings) {
                                         Machine machine;
                                         machine.start.comp = CutterComp::kOff;
                                         machine.start.motion = Motion::kLinear;
                                         machine.start.plane = Plane::kXY;
                                         machine.start.distance = Distance::kAbsolute;
                                         machine.start.units = Units::kMm;
                                         machine.start.diameter = Diameter::kRadius;
                                         AbsoluteDimensionsConfig config;
                                         config.sub_entry = machine.start;
                                         config.keep = keep;
                                         config.keep_axes = 0x27;
                                         config.word_error = WordError::kRound;
                                         config.increment = 0.001;
                                         return AbsoluteDimensions(module, machine, config, findings, nullptr, &kept);
                                       });
  const std::string numbers = std::regex_replace(text, std::regex("literal\\(([-0-9.]+), computed\\)"), "$1");
  return std::regex_replace(numbers, std::regex("cell:real |:(real|int)"), "");
}

TEST_CASE("kept increments stay words; no local holds a position for them") {
  diag::Sink sink;
  KeptIncrements kept;
  CHECK(Kept("program M main @m:0\n"
             "  @m:1 : axis X = 1; axis Y = 2\n"
             "  @m:2 label L : axis X incremental = 1.5; axis Y = 3\n"
             "  @m:3 : axis Y incremental = R[1]\n"
             "  @m:4 : jump backward label L = lt!tolerance:bool(R[1], 4)\n",
             sink, KeepIncrements::kAxes, kept) ==
        "program M main\n"
        "axis X absolute = 1; axis Y absolute = 2\n"
        "label L axis X incremental = 1.5; axis Y absolute = 3\n"
        "axis Y incremental = R[1]\n"
        "jump backward label L = lt!tolerance:bool(R[1], 4)\n");
  CHECK_FALSE(sink.HasErrors());
  CHECK(kept.words == 2);
  CHECK(kept.drifting == 1);
  CHECK(sink.WarningCount() == 1);
  CHECK(kept.started.empty());
}

TEST_CASE("under a mode whole blocks stay, and each label is reached under the absolute mode") {
  diag::Sink sink;
  KeptIncrements kept;
  CHECK(Kept("program M main @m:0\n"
             "  @m:1 : axis X = 1; axis Y = 2\n"
             "  @m:2 : axis X incremental = 1\n"
             "  @m:3 label L : axis X incremental = 1; axis Y incremental = 2\n"
             "  @m:4 : axis X incremental = 3\n"
             "  @m:5 skip 0 : axis X incremental = 4\n"
             "  @m:6 : axis X incremental = 5\n"
             "  @m:7 : axis X = 6; axis Y = 7\n"
             "  @m:8 : axis X incremental = 8; axis Y = 9\n"
             "  @m:9 : axis X incremental = 8\n"
             "  @m:10 : jump backward label L = lt!tolerance:bool(R[1], 4)\n",
             sink, KeepIncrements::kBlocks, kept) ==
        "program M main\n"
        "axis X absolute = 1; axis Y absolute = 2\n"
        "distance incremental; axis X = 1\n"
        "label L distance incremental; axis X = 1; axis Y = 2\n"
        "axis X = 3\n"
        "axis X = 4\n"
        "axis X = 5\n"
        "distance absolute; axis X absolute = 6; axis Y absolute = 7\n"
        "axis X absolute = 14; axis Y absolute = 9\n"
        "distance incremental; axis X = 8\n"
        "distance absolute\n"
        "jump backward label L = lt!tolerance:bool(R[1], 4)\n");
  CHECK(sink.All().empty());
  CHECK(kept.words == 7);
}

TEST_CASE(
    "an increment behind a tool, a shift or a work offset becomes a position, and is refused where none is known") {
  for (const std::string_view between : {"tool = 2", "edge = 2", "work-offset #55", "length-offset = 3"}) {
    diag::Sink sink;
    KeptIncrements kept;
    const std::string text = Kept(
        "program M main @m:0\n"
        "  @m:1 : axis Z = 1\n"
        "  @m:2 : " +
            std::string(between) +
            "\n"
            "  @m:3 : axis Z incremental = 1\n"
            "  @m:4 : axis Z = 3\n"
            "  @m:5 : axis Z incremental = 1\n",
        sink, KeepIncrements::kAxes, kept);
    CHECK(kept.words == 1);
    const bool lost = between.starts_with("work");
    CHECK(sink.HasErrors() == lost);
    if (!lost)
      CHECK(text.find("axis Z absolute = 2\naxis Z absolute = 3\naxis Z incremental = 1") != std::string::npos);
  }
}

TEST_CASE("a subprogram that nobody calls starts where its caller stands") {
  diag::Sink sink;
  KeptIncrements kept;
  Kept(
      "program S sub @m:0\n"
      "  @m:1 : axis X incremental = 1\n",
      sink, KeepIncrements::kBlocks, kept);
  CHECK_FALSE(sink.HasErrors());
  CHECK(kept.started.size() == 1);
}

TEST_CASE("a whole number times the increment of the target does not drift, half of it does") {
  for (const bool whole : {true, false}) {
    diag::Sink sink;
    KeptIncrements kept;
    Kept(
        "program M main @m:0\n"
        "  @m:1 : axis X = 1\n"
        "  @m:2 : assign R[1] = 0\n"
        "  @m:3 label L : axis X incremental = mul:real(" +
            std::string(whole ? "0.002" : "0.0005") +
            ", R[1])\n"
            "  @m:4 : assign R[1] = add:real(R[1], 1)\n"
            "  @m:5 : jump backward label L = lt!tolerance:bool(R[1], 4)\n",
        sink, KeepIncrements::kAxes, kept);
    CHECK(kept.words == 1);
    CHECK(kept.drifting == (whole ? 0 : 1));
  }
}

}  // namespace
}  // namespace ncport::ir::transform
