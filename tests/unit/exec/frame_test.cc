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

TEST_CASE_FIXTURE(RunFixture, "a block that ends a rotation or a scale moves behind it") {
  CHECK(Trace({"G0 X0 Y0 Z0", "G68 X10 Y0 RPL=90", "X20 Y0", "G69 G0 X0 Y0 Z50", "X8"}) ==
        "RAPID X0 Y0 Z0\nRAPID X10 Y10 Z0\nRAPID X0 Y0 Z50\nRAPID X8 Y0 Z50\n");
  RunFixture modal;
  CHECK(modal.Trace({"G0 X0 Y0", "G68 X0 Y0 RPL=90", "X20 Y0", "G69 X30 Y40", "G1 G69 X3 F50"}) ==
        "RAPID X0 Y0\nRAPID X0 Y20\nRAPID X30 Y40\nLINE X3 Y40 F50\n");
  RunFixture scale;
  CHECK(scale.Trace({"G0 X0 Y0 Z0", "G51 X0 Y0 Z0 P2", "X10", "G50 X30", "G1 X31 F50"}) ==
        "RAPID X0 Y0 Z0\nRAPID X20 Y0 Z0\nRAPID X30 Y0 Z0\nLINE X31 Y0 Z0 F50\n");
}

TEST_CASE_FIXTURE(RunFixture, "a mirror ends for the axes that its block names, which moves none") {
  CHECK(Trace({"G0 X0 Y0", "G51.1 X0 Y0", "X5 Y6", "G50.1 X7", "X5 Y6", "G50.1 Y7", "X5 Y6", "G50.1 G0", "X1"}) ==
        "RAPID X0 Y0\nRAPID X-5 Y-6\nRAPID X5 Y-6\nRAPID X5 Y6\nRAPID X1 Y6\n");
  for (const std::string_view block : {"G50.1 X0 G0 Y7", "G50.1 X0 G74", "G50.1 X0 SUPA", "G50.1 X0 I1"}) {
    RunFixture beside;
    beside.Trace({"G0 X0 Y0", "G51.1 X0", block});
    CHECK(beside.Finding().find("the end of a mirror beside another word") != std::string::npos);
  }
}

TEST_CASE_FIXTURE(RunFixture, "every frame word of a block acts") {
  CHECK(Trace({"G0 X0 Y0 Z0", "G51 X0 Y0 P2", "G68 X0 Y0 RPL=90", "X10 Y0", "G17 G40 G69 G50", "X10 Y1"}) ==
        "RAPID X0 Y0 Z0\nRAPID X0 Y20 Z0\nRAPID X10 Y1 Z0\n");
  RunFixture mirror;
  CHECK(mirror.Trace({"G0 X0 Y0", "G51.1 X0", "G68 X0 Y0 RPL=90", "X10 Y1", "G50.1 X0 G69", "X10 Y1"}) ==
        "RAPID X0 Y0\nRAPID X1 Y10\nRAPID X10 Y1\n");
  RunFixture shift;
  CHECK(shift.Trace({"G0 X0 Y0", "G68 X0 Y0 RPL=90", "G52 X5 G69", "X10 Y1"}) == "RAPID X0 Y0\nRAPID X15 Y1\n");
  RunFixture sides;  // one change of the side at most
  CHECK(sides.Trace({"G0 X0 Y0", "G68 X0 Y0 RPL=90", "G42", "G51.1 X0 G69"}) == "RAPID X0 Y0\nCOMP RIGHT\nCOMP LEFT\n");
}

TEST_CASE_FIXTURE(RunFixture, "frame words of one block whose order would matter are refused") {
  struct Case {
    std::string_view block, finding;
  };
  static constexpr Case kCases[] = {
      {"G52 X1 G68", "two frame words with values"},
      {"G69 G68 X1 Y1 RPL=5", "beside the word that ends it"},
      {"G50 G51 X1 P2", "beside the word that ends it"},
      {"G50.1 G51.1 X1", "beside the word that ends it"},
      {"G50 G68 X1 Y1 RPL=5", "a rotation beside the end of a scale"},
      {"G50 G52 X1 G50.1", "the end of a mirror beside another word"},
  };
  for (const Case& row : kCases) {
    RunFixture beside;
    beside.Trace({"G0 X0 Y0 Z0", "G51 X0 Y0 P2", row.block});
    CHECK(beside.result.outcome == Outcome::kRefused);
    CHECK_MESSAGE(beside.Finding().find(row.finding) != std::string::npos, row.block);
  }
}

}  // namespace ncport::exec
