// The programmable frame: vectors 39, 40, 41, 62, and arcs under it.
#include <doctest/doctest.h>

#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

TEST_CASE_FIXTURE(RunFixture, "TRANS replaces the frame, ATRANS adds; increments do not traverse it (vector 39)") {
  CHECK(Trace({"G0 X1 Y1", "TRANS X100 Y20", "X2 Y2", "ATRANS X10", "X2", "TRANS Y5", "X3 Y3", "TRANS", "X4 Y4",
               "TRANS X50", "G91 X1", "G90 X1"}) ==
        "RAPID X1 Y1\nRAPID X102 Y22\nRAPID X112 Y22\nRAPID X3 Y8\nRAPID X4 Y4\nRAPID X5 Y4\nRAPID X51 Y4\n");
}

TEST_CASE_FIXTURE(RunFixture, "a setting lets increments traverse the shift") {
  machine.incremental_traverses_frame = true;
  CHECK(Trace({"G0 X4", "TRANS X50", "G91 X1"}) == "RAPID X4\nRAPID X55\n");
}

TEST_CASE_FIXTURE(RunFixture, "ROT deletes a TRANS, AROT adds to it (vector 40)") {
  CHECK(Trace({"TRANS X10 Y0", "AROT RPL=90", "G0 X5 Y0", "X5 Y2", "ROT RPL=90", "X5 Y0", "ROT", "X1 Y2"}) ==
        "RAPID X10 Y5\nRAPID X8 Y5\nRAPID X0 Y5\nRAPID X1 Y2\n");
}

TEST_CASE_FIXTURE(RunFixture, "SCALE and MIRROR; a mirror turns arcs around (vector 41)") {
  CHECK(Trace({"SCALE X2 Y2", "G0 X5 Y1", "MIRROR X0", "X10 Y0", "G2 X0 Y-10 I-10 J0 F100", "MIRROR", "G0 X3 Y3"}) ==
        "RAPID X10 Y2\nRAPID X-10 Y0\nARC CCW XY X0 Y-10 center (0,0) F100\nRAPID X3 Y3\n");
}

TEST_CASE_FIXTURE(RunFixture, "several angles turn about Z, the new Y, the new X (vector 62)") {
  CHECK(Trace({"ROT X90 Z90", "G0 X1 Y2 Z3", "ROT Z90 X90", "G0 X1 Y2 Z0", "ROT X90 Y90", "G0 X1 Y2 Z3", "ROT",
               "G0 X0 Y0 Z0"}) == "RAPID X3 Y1 Z2\nRAPID X0 Y1 Z2\nRAPID X2 Y-3 Z-1\nRAPID X0 Y0 Z0\n");
}

TEST_CASE_FIXTURE(RunFixture, "an additive word alone changes nothing") {
  CHECK(Trace({"TRANS X10", "ATRANS", "G0 X1"}) == "RAPID X11\n");
}

TEST_CASE_FIXTURE(RunFixture, "a mirror exchanges the sides of the compensation") {
  CHECK(Trace({"G41", "MIRROR X0", "MIRROR"}) == "COMP LEFT\nCOMP RIGHT\nCOMP LEFT\n");
}

TEST_CASE_FIXTURE(RunFixture, "arcs in a turned plane, and planes that no arc of the trace has") {
  CHECK(Trace({"ROT X90", "G0 X10 Y0 Z0", "G3 X0 Y10 I-10 J0 F100"}) ==
        "RAPID X10 Y0 Z0\nARC CW ZX X0 Y0 Z10 center (0,0) F100\n");
  RunFixture turned;
  CHECK(turned.Trace({"TRANS X5", "AROT RPL=90", "G0 X10 Y0", "G3 X0 Y10 I-10 J0 F100"}) ==
        "RAPID X5 Y10\nARC CCW XY X-5 Y0 center (5,0) F100\n");
  RunFixture tilted;
  tilted.Trace({"ROT X30", "G0 X10 Y0 Z0", "G3 X0 Y10 I-10 J0 F100"});
  CHECK(tilted.Finding().find("tilts") != std::string::npos);
  RunFixture uneven;
  uneven.Trace({"SCALE X2", "G0 X10 Y0", "G3 X0 Y10 I-10 J0 F100"});
  CHECK(uneven.Finding().find("different scale") != std::string::npos);
}

TEST_CASE_FIXTURE(RunFixture, "under a rotation an axis may depend on one that nobody has placed") {
  Trace({"ROT RPL=45", "G0 X5"});
  CHECK(result.outcome == Outcome::kRefused);
  CHECK(Finding().find("position is not known") != std::string::npos);
}

TEST_CASE_FIXTURE(RunFixture, "one axis under a rotation keeps the other where it is in the turned system") {
  CHECK(Trace({"ROT RPL=90", "G0 X5 Y2", "X6", "G91 Y1"}) == "RAPID X-2 Y5\nRAPID X-2 Y6\nRAPID X-3 Y6\n");
}

TEST_CASE_FIXTURE(RunFixture, "shifts of the transverse axis are radii unless the machine says otherwise") {
  machine = TestLathe();
  CHECK(Trace({"TRANS X10", "G0 X20"}) == "RAPID Xr20\n");
  RunFixture diameter;
  diameter.machine = TestLathe();
  diameter.machine.frame_shift_in_diameter = true;
  CHECK(diameter.Trace({"TRANS X10", "G0 X20"}) == "RAPID Xr15\n");
}

}  // namespace ncport::exec
