// Arcs: values of the vectors 30 to 37 and 61, and what cannot be an arc.
#include <doctest/doctest.h>

#include "exec/arc_geometry.h"
#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

TEST_CASE_FIXTURE(RunFixture, "centre from the start, full circles (vector 30)") {
  CHECK(Trace({"G0 X20 Y0", "G3 X0 Y20 I-20 J0 F200", "G2 X20 Y0 J-20", "G2 I-20"}) ==
        "RAPID X20 Y0\nARC CCW XY X0 Y20 center (0,0) F200\nARC CW XY X20 Y0 center (0,0) F200\nARC CW XY X20 Y0 "
        "center (0,0) F200\n");
}

TEST_CASE_FIXTURE(RunFixture, "absolute centre, also under G91 (vector 31)") {
  CHECK(Trace({"G0 X30 Y10", "G2 X10 Y-10 I=AC(10) J=AC(10) F100", "G91 G3 X20 Y20 I=AC(10) J=AC(10)"}) ==
        "RAPID X30 Y10\nARC CW XY X10 Y-10 center (10,10) F100\nARC CCW XY X30 Y10 center (10,10) F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "radius: short and long arc") {
  CHECK(Trace({"G0 X10 Y0", "G3 X0 Y10 CR=10 F100", "G3 X-10 Y0 CR=-10", "G2 X-10 Y20 CR=10"}) ==
        "RAPID X10 Y0\nARC CCW XY X0 Y10 center (0,0) F100\nARC CCW XY X-10 Y0 center (-10,10) F100\nARC CW XY X-10 "
        "Y20 center (-10,10) F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "opening angle with end point or centre (vectors 33, 61)") {
  CHECK(Trace({"G0 X0 Y0", "G3 X20 Y0 AR=180 F100", "G2 I-10 J0 AR=90", "G2 X0 Y-20 AR=90"}) ==
        "RAPID X0 Y0\nARC CCW XY X20 Y0 center (10,0) F100\nARC CW XY X10 Y-10 center (10,0) F100\nARC CW XY X0 Y-20 "
        "center (0,-10) F100\n");
  RunFixture pair;
  CHECK(pair.Trace({"G0 X67.5 Y80.211", "G3 X17.203 Y38.029 AR=140.134 F500", "G0 X67.5 Y80.211",
                    "G3 I-17.5 J-30.211 AR=140.134"}) ==
        "RAPID X67.5 Y80.211\nARC CCW XY X17.203 Y38.029 center (50.000078,49.999984) F500\nRAPID X67.5 Y80.211\n"
        "ARC CCW XY X17.202873 Y38.029078 center (50,50) F500\n");
}

TEST_CASE_FIXTURE(RunFixture, "through a point: plane and sense follow from three points (vector 34)") {
  CHECK(Trace({"G0 X0 Y0 Z0", "CIP X20 Y0 Z0 I1=10 J1=10 K1=0 F100"}) ==
        "RAPID X0 Y0 Z0\nARC CW XY X20 Y0 Z0 center (10,0) F100\n");
  RunFixture upright;
  CHECK(upright.Trace({"G0 X0 Y0 Z0", "CIP X20 Z0 I1=10 K1=10 F100"}) ==
        "RAPID X0 Y0 Z0\nARC CCW ZX X20 Y0 Z0 center (0,10) F100\n");
  RunFixture tilted;
  tilted.Trace({"G0 X0 Y0 Z0", "CIP X20 Y0 Z5 I1=10 J1=10 K1=1 F100"});
  CHECK(tilted.Finding().find("parallel to no main plane") != std::string::npos);
  RunFixture straight;
  CHECK(straight.Trace({"G0 X0 Y0 Z0", "CIP X20 Y0 I1=10 J1=0 F100"}) ==
        "RAPID X0 Y0 Z0\nALARM circle points of the arc lie on one line\n");
}

TEST_CASE_FIXTURE(RunFixture, "tangent arcs follow the path before them") {
  CHECK(Trace({"G0 X0 Y0", "G1 X10 F100", "CT X20 Y10", "CT X10 Y20"}) ==
        "RAPID X0 Y0\nLINE X10 Y0 F100\nARC CCW XY X20 Y10 center (10,10) F100\nARC CCW XY X10 Y20 center (10,10) "
        "F100\n");
  RunFixture line;
  CHECK(line.Trace({"G0 X0 Y0", "G1 X10 F100", "CT X20 Y0"}) == "RAPID X0 Y0\nLINE X10 Y0 F100\nLINE X20 Y0 F100\n");
  RunFixture unknown;
  unknown.Trace({"G0 X0 Y0 F100", "CT X20 Y10"});
  CHECK(unknown.result.outcome == Outcome::kRefused);
}

TEST_CASE_FIXTURE(RunFixture, "helix with additional turns (vector 35)") {
  CHECK(Trace({"G0 X10 Y0 Z0", "G3 X0 Y10 Z-6 I-10 J0 TURN=2 F100"}) ==
        "RAPID X10 Y0 Z0\nARC CCW XY X0 Y10 Z-6 center (0,0) turns 2 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "lathe: I is a radius, absolute centres are diameters (vector 37)") {
  machine = TestLathe();
  CHECK(Trace({"G0 X20 Z0", "G3 X40 Z-10 I0 K-10 F100", "G2 X60 Z-20 CR=10", "G3 X40 Z-30 I=AC(40) K=AC(-20)"}) ==
        "RAPID Xr10 Z0\nARC CCW ZX Xr20 Z-10 center (-10,10) F100\nARC CW ZX Xr30 Z-20 center (-10,30) F100\n"
        "ARC CCW ZX Xr20 Z-30 center (-20,20) F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "radii that differ a little move the centre between the ends") {
  CHECK(Trace({"G0 X10 Y0", "G3 X0 Y10.008 I-10 J0 F100"}) ==
        "RAPID X10 Y0\nARC CCW XY X0 Y10.008 center (-0.003998,0.004002) F100\n");
  RunFixture kept;
  kept.machine.arc_center_corrected = false;
  CHECK(kept.Trace({"G0 X10 Y0", "G3 X0 Y10.008 I-10 J0 F100"}) ==
        "RAPID X10 Y0\nARC CCW XY X0 Y10.008 center (0,0) F100\n");
  RunFixture far;
  CHECK(far.Trace({"G0 X10 Y0", "G3 X0 Y10.02 I-10 J0 F100"}) ==
        "RAPID X10 Y0\nALARM circle radius is 10 at the start and 10.02 at the end\n");
}

TEST_CASE_FIXTURE(RunFixture, "alarms of arcs") {
  const auto alarm = [](std::string_view block) {
    RunFixture fixture;
    return fixture.Trace({"G0 X0 Y0 F100", block});
  };
  CHECK(alarm("G2 X10 Y0") == "RAPID X0 Y0\nALARM circle arc without centre and radius\n");
  CHECK(alarm("G2 X10 Y0 CR=4") == "RAPID X0 Y0\nALARM circle radius too small for the end point\n");
  CHECK(alarm("G2 X10 Y0 CR=4.995") == "RAPID X0 Y0\nARC CW XY X10 Y0 center (5,0) F100\n");
  CHECK(alarm("G2 X0 Y0 CR=4") == "RAPID X0 Y0\nALARM circle end point is the start point\n");
  CHECK(alarm("G2 X10 Y0 CR=5 I5") == "RAPID X0 Y0\nALARM circle radius and centre in one block\n");
  CHECK(alarm("G2 X10 Y0 AR=0") == "RAPID X0 Y0\nALARM circle opening angle outside 0 to 360 degrees\n");
  CHECK(alarm("G2 X10 K5") == "RAPID X0 Y0\nALARM circle centre word outside the plane\n");
}

TEST_CASE_FIXTURE(RunFixture, "controls where the radius beats the centre and stays without an end point") {
  machine.arc_radius_beats_center = true;
  machine.arc_radius_without_end_stays = true;
  CHECK(Trace({"G0 X-10 Y0", "G2 X-10 Y20 I99 J99 CR=10 F100", "G2 CR=10"}) ==
        "RAPID X-10 Y0\nARC CW XY X-10 Y20 center (-10,10) F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "a polar end point has the pole as centre") {
  CHECK(Trace({"G0 X10 Y0", "G111 X0 Y0", "G3 AP=90 RP=10 F100"}) ==
        "RAPID X10 Y0\nARC CCW XY X0 Y10 center (0,0) F100\n");
}

TEST_CASE("sweep of an arc") {
  CHECK(SweepOf({1, 0}, {0, 1}, {0, 0}, false) == doctest::Approx(90));
  CHECK(SweepOf({1, 0}, {0, 1}, {0, 0}, true) == doctest::Approx(270));
}

}  // namespace ncport::exec
