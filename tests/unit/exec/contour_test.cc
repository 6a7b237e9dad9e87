// Chamfers, roundings and lines by their angle.
#include <doctest/doctest.h>

#include <cmath>

#include "exec/corner.h"
#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

TEST_CASE_FIXTURE(RunFixture, "leg, length and radius between lines (vector 43)") {
  CHECK(Trace({"G0 X0 Y0", "G1 X20 CHR=5 F100", "Y20 CHF=2", "X40 RND=4", "Y40"}) ==
        "RAPID X0 Y0\nLINE X15 Y0 F100\nLINE X20 Y5 F100\nLINE X20 Y18.585786 F100\nLINE X21.414214 Y20 F100\nLINE X36 "
        "Y20 F100\n"
        "ARC CCW XY X40 Y24 center (36,24) F100\nLINE X40 Y40 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "the corner takes the feed of the block behind it, or of the one before") {
  CHECK(Trace({"G0 X0 Y0", "G1 X20 CHR=5 F100", "Y20 F50"}) ==
        "RAPID X0 Y0\nLINE X15 Y0 F100\nLINE X20 Y5 F50\nLINE X20 Y20 F50\n");
  RunFixture before;
  before.machine.chamfer_feed_from_next = false;
  CHECK(before.Trace({"G0 X0 Y0", "G1 X20 CHR=5 F100", "Y20 F50"}) ==
        "RAPID X0 Y0\nLINE X15 Y0 F100\nLINE X20 Y5 F100\nLINE X20 Y20 F50\n");
}

TEST_CASE_FIXTURE(RunFixture, "events between the elements come behind the corner") {
  CHECK(Trace({"G0 X0 Y0", "G1 X20 RND=5 F100", "M=8", "Y20"}) ==
        "RAPID X0 Y0\nLINE X15 Y0 F100\nARC CCW XY X20 Y5 center (15,5) F100\nM8\nLINE X20 Y20 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "rounding by mode, until it is switched off; rapids have none") {
  CHECK(Trace({"G0 X0 Y0", "G1 X20 RNDM=5 F100", "Y20", "X0 RNDM=0", "Y40"}) ==
        "RAPID X0 Y0\nLINE X15 Y0 F100\nARC CCW XY X20 Y5 center (15,5) F100\nLINE X20 Y15 F100\nARC CCW XY X15 Y20 "
        "center (15,15) F100\n"
        "LINE X0 Y20 F100\nLINE X0 Y40 F100\n");
  RunFixture rapid;
  CHECK(rapid.Trace({"G0 X0 Y0", "G1 X20 RNDM=5 F100", "G0 Z10"}) ==
        "RAPID X0 Y0\nLINE X20 Y0 F100\nRAPID X20 Y0 Z10\n");
}

TEST_CASE_FIXTURE(RunFixture, "roundings with arcs are tangent to both") {
  // The centre lies 2 over the line and 10 - 2 from the centre of the arc: x = 10 + sqrt(64 - 4).
  CHECK(Trace({"G0 X0 Y10", "G1 X20 RND=2 F100", "G3 X10 Y20 I-10 J0"}) ==
        "RAPID X0 Y10\nLINE X17.745967 Y10 F100\nARC CCW XY X19.682458 Y12.5 center (17.745967,12) F100\n"
        "ARC CCW XY X10 Y20 center (10,10) F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "corners that cannot be") {
  CHECK(Trace({"G0 X0 Y0", "G1 X2 RND=5 F100", "Y20"}) ==
        "RAPID X0 Y0\nALARM geometry chamfer or rounding is longer than its element\n");
  RunFixture back;
  CHECK(back.Trace({"G0 X0 Y0", "G1 X20 RND=5 F100", "X0"}) ==
        "RAPID X0 Y0\nALARM geometry chamfer or rounding between elements that run back on each other\n");
  RunFixture end;
  CHECK(end.Trace({"G0 X0 Y0", "G1 X20 RND=5 F100"}) ==
        "RAPID X0 Y0\nLINE X20 Y0 F100\nALARM geometry no motion behind the chamfer or rounding\n");
  RunFixture rapid;
  rapid.Trace({"G0 X0 Y0", "G1 X20 RND=5 F100", "G0 Y5"});
  CHECK(rapid.result.outcome == Outcome::kRefused);
  RunFixture deep;
  deep.Trace({"G0 X0 Y0 Z0", "G1 X20 Z-5 RND=5 F100", "Y5"});
  CHECK(deep.Finding().find("not flat") != std::string::npos);
  RunFixture smooth;
  CHECK(smooth.Trace({"G0 X0 Y0", "G1 X20 RND=5 F100", "X30"}) == "RAPID X0 Y0\nLINE X20 Y0 F100\nLINE X30 Y0 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "a corner under a scale grows with it") {
  CHECK(Trace({"SCALE X2 Y2", "G0 X0 Y0", "G1 X10 CHR=2 F100", "Y10"}) ==
        "RAPID X0 Y0\nLINE X16 Y0 F100\nLINE X20 Y4 F100\nLINE X20 Y20 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "an angle and one coordinate give the other") {
  CHECK(Trace({"G0 X0 Y0", "G1 X10 ANG=45 F100", "Y0 ANG=-45"}) ==
        "RAPID X0 Y0\nLINE X10 Y10 F100\nLINE X20 Y0 F100\n");
  RunFixture wrong;
  CHECK(wrong.Trace({"G0 X0 Y0", "G1 X10 ANG=135 F100"}) ==
        "RAPID X0 Y0\nALARM geometry the angle does not lead to the end coordinate\n");
  RunFixture lathe;
  lathe.machine = TestLathe();
  CHECK(lathe.Trace({"G0 X20 Z0", "G1 Z-10 ANG=135 F100"}) == "RAPID Xr10 Z0\nLINE Xr20 Z-10 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "two lines by angles and the end point, each with its feed") {
  CHECK(Trace({"G0 X0 Y0", "G1 ANG=90 F100", "X10 Y20 ANG=45 F50"}) ==
        "RAPID X0 Y0\nLINE X0 Y10 F100\nLINE X10 Y20 F50\n");
  RunFixture corner;
  CHECK(corner.Trace({"G0 X0 Y0", "G1 ANG=90 CHR=2 F100", "X10 Y10 ANG=0"}) ==
        "RAPID X0 Y0\nLINE X0 Y8 F100\nLINE X2 Y10 F100\nLINE X10 Y10 F100\n");
  RunFixture open;
  CHECK(open.Trace({"G0 X0 Y0", "G1 ANG=90 F100"}) ==
        "RAPID X0 Y0\nALARM geometry no motion behind the line with an angle\n");
}

TEST_CASE("corners of two arcs") {
  const Element first{{0, 0}, {10, 10}, true, {10, 0}, true};
  const Element second{{10, 10}, {20, 20}, true, {10, 20}, false};
  CHECK(RoundCorner(first, second, 1).fault == CornerFault::kSmooth);
  const Element third{{10, 10}, {20, 0}, true, {20, 10}, false};
  const Corner corner = RoundCorner(first, third, 1);
  CHECK(corner.fault == CornerFault::kNone);
  CHECK(corner.clockwise);
  CHECK(std::hypot(corner.center.u - 10, corner.center.v) == doctest::Approx(9));
  CHECK(std::hypot(corner.center.u - 20, corner.center.v - 10) == doctest::Approx(11));
}

}  // namespace ncport::exec
