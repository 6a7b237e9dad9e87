// Modal words, positions, feed, units, diameters, events of motion. Values of the sinumerik card and vectors.
#include <doctest/doctest.h>

#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

TEST_CASE_FIXTURE(RunFixture, "only axes that were programmed are written, in the order of traces") {
  CHECK(Trace({"G0 Z5 X1", "C90", "Y2"}) == "RAPID X1 Z5\nRAPID X1 Z5 C90\nRAPID X1 Y2 Z5 C90\n");
  CHECK(result.moved);
  CHECK(result.outcome == Outcome::kEnded);
}

TEST_CASE_FIXTURE(RunFixture, "a start position is known but not written until it is programmed") {
  options.start_position_known = true;
  options.start_axes = 7;
  options.start_position[0] = 3;
  CHECK(Trace({"G91 G0 X2", "G90 Y1"}) == "RAPID X5\nRAPID X5 Y1\n");
}

TEST_CASE_FIXTURE(RunFixture, "an increment from an unknown position is refused with its place") {
  CHECK(Trace({"G91 G0 X2"}).empty());
  CHECK(result.outcome == Outcome::kRefused);
  CHECK(Finding() == "increment for X from an unknown position");
}

TEST_CASE_FIXTURE(RunFixture,
                  "the distance mode holds for the block whatever the order of words, and words override it") {
  CHECK(Trace({"G0 X10 Y10", "X5 G91", "X1 Y=AC(3)", "G90 X=IC(-2)"}) ==
        "RAPID X10 Y10\nRAPID X15 Y10\nRAPID X16 Y3\nRAPID X14 Y3\n");
}

TEST_CASE_FIXTURE(RunFixture, "inch of the geometry leaves the feed, inch of everything takes it along (vector 50)") {
  CHECK(Trace({"G71 G0 X25.4 Y0", "G70 X2 Y1", "G1 X1 F100", "G700 X3 F10", "G710 X100 F100"}) ==
        "RAPID X25.4 Y0\nRAPID X50.8 Y25.4\nLINE X25.4 Y25.4 F100\nLINE X76.2 Y25.4 F254\nLINE X100 Y25.4 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "a rotary axis has no inches") {
  CHECK(Trace({"G700 G0 X1 C90"}) == "RAPID X25.4 C90\n");
}

TEST_CASE_FIXTURE(RunFixture, "diameter modes (vector 36)") {
  machine = TestLathe();
  CHECK(
      Trace({"G0 X40 Z2", "G1 X30 Z0 F100", "G91 X4", "DIAM90", "X4", "G90 X50", "DIAMOF", "X10"}) ==
      "RAPID Xr20 Z2\nLINE Xr15 Z0 F100\nLINE Xr17 Z0 F100\nLINE Xr21 Z0 F100\nLINE Xr25 Z0 F100\nLINE X10 Z0 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "diameter words need a transverse axis (sinumerik-10#53)") {
  CHECK(Trace({"G0 X10", "DIAMON", "X20"}) == "RAPID X10\nALARM transverse diameter word without a transverse axis\n");
  RunFixture word;
  CHECK(word.Trace({"DIAMOF", "G0 X=DAC(10)"}) == "ALARM transverse diameter word of an axis that is not transverse\n");
}

TEST_CASE_FIXTURE(RunFixture, "words of one axis choose diameter or radius themselves") {
  machine = TestLathe();
  CHECK(Trace({"G0 X=RAC(10) Z0", "X=DIC(4)", "X=RIC(4)", "DIAMOF", "X=DAC(10)"}) ==
        "RAPID Xr10 Z0\nRAPID Xr12 Z0\nRAPID Xr16 Z0\nRAPID X5 Z0\n");
}

TEST_CASE_FIXTURE(RunFixture, "a start position of a lathe is a diameter") {
  machine = TestLathe();
  options.start_position_known = true;
  options.start_axes = 5;
  options.start_position[0] = 20;
  CHECK(Trace({"G91 G0 X2"}) == "RAPID Xr11\n");
}

TEST_CASE_FIXTURE(RunFixture, "a feed move needs a feed") {
  CHECK(Trace({"X5"}) == "ALARM feed no feed programmed\n");
  CHECK(result.outcome == Outcome::kAlarmed);
}

TEST_CASE_FIXTURE(RunFixture, "a change of the feed mode drops the feed, a repeated word does not") {
  CHECK(Trace({"G1 X1 F100", "G94 X2", "G95 X3"}) == "LINE X1 F100\nLINE X2 F100\nALARM feed no feed programmed\n");
}

TEST_CASE_FIXTURE(RunFixture, "forms of the feed, and the feed of one block") {
  CHECK(Trace({"G95 G1 X1 F0.2", "G93 X2 F3", "G94 X3 F100", "X4 FB=50", "X5"}) ==
        "LINE X1 F0.2/r\nLINE X2 F3/t\nLINE X3 F100\nLINE X4 F50\nLINE X5 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "rotary positions of one direction lie in 0 to 359.999") {
  CHECK(Trace({"G0 C=ACP(10)", "C=DC(350)", "C=ACN(360)"}) ==
        "RAPID C10\nRAPID C350\nALARM range rotary position outside 0 to 359.999\n");
}

TEST_CASE_FIXTURE(RunFixture, "computed words round or cut on their way to the axis, literals do not") {
  machine.word_error = ir::WordError::kRound;
  ir::ProgramBuilder program(module, "MAIN");
  const auto computed = [&](std::string_view value, bool rounds) {
    ir::BlockBuilder block = program.Block();
    block.Motion(ir::Motion::kRapid).Axis(0, N(value));
    if (rounds) block.Last().flags |= ir::Word::kRoundsValue;
    block.Finish();
  };
  computed("1.0005", true);
  computed("1.0005", false);
  computed("-2.00049", true);
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X1.001\nRAPID X1.0005\nRAPID X-2\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a vacant value makes its word vanish, zero does not") {
  ir::ProgramBuilder program(module, "MAIN");
  Line(program, "G0 X1 Y1");
  ir::BlockBuilder block = program.Block();
  block.Axis(0, e.Vacant());
  block.Last().flags |= ir::Word::kVanishesVacant;
  block.Axis(1, N("0")).Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X1 Y1\nRAPID X1 Y0\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "machine coordinates and reference points leave a position that nobody knows") {
  CHECK(Trace({"G0 X5 Y5 Z5", "SUPA Z0", "X6", "G74 X0", "Y7"}) ==
        "RAPID X5 Y5 Z5\nRAPID MCS Z0\nRAPID X6 Y5\nREFPOINT X\nRAPID Y7\n");
  // By way of a point: a step of nothing is none, also from a position that is not known.
  RunFixture via;
  via.machine.reference_via_point = true;
  CHECK(via.Trace({"G91 G74 X0", "G90 G0 X5", "G91 G74 X0", "G90 G74 Z3"}) ==
        "REFPOINT X\nRAPID X5\nRAPID X5\nREFPOINT X\nRAPID Z3\nREFPOINT Z\n");
  RunFixture step;
  step.machine.reference_via_point = true;
  step.Trace({"G91 G74 X1"});
  CHECK(step.Finding() == "increment for X from an unknown position");
  RunFixture after;
  after.Trace({"G0 Z5", "SUPA Z0", "G91 Z1"});
  CHECK(after.Finding() == "increment for Z from an unknown position");
  RunFixture feed;
  feed.Trace({"G1 F100 SUPA Z0"});
  CHECK(feed.result.outcome == Outcome::kRefused);
}

TEST_CASE_FIXTURE(RunFixture,
                  "another work offset: the old coordinates still show, but nothing is computed from them") {
  CHECK(Trace({"G54 G0 X5 Z9", "G55 X6", "G91 X1"}) == "WCS 54\nRAPID X5 Z9\nWCS 55\nRAPID X6 Z9\nRAPID X7 Z9\n");
  RunFixture after;
  after.Trace({"G54 G0 X5 Z9", "G55 G91 Z1"});
  CHECK(after.Finding() == "increment for Z from an unknown position");
  RunFixture again;
  CHECK(again.Trace({"G54 G0 X5", "G54 G91 X1"}) == "WCS 54\nRAPID X5\nRAPID X6\n");
}

TEST_CASE_FIXTURE(RunFixture, "path modes and compensation are shown when they change") {
  CHECK(Trace({"G64", "G64 G41", "G0 X1", "G9 G1 X2 F10", "G60 G40"}) ==
        "PATH CONTINUOUS\nCOMP LEFT\nRAPID X1\nPATH EXACT\nLINE X2 F10\nPATH CONTINUOUS\nPATH EXACT\nCOMP OFF\n");
}

TEST_CASE_FIXTURE(RunFixture, "threads and taps") {
  CHECK(Trace({"G0 X20 Z5", "G33 Z-10 K1.5 SF=90", "Z-20 K1.5", "G34 Z-30 K2 F0.1", "G35 Z-40 K2 F0.1",
               "G331 Z-50 K-1.25", "G0 Z5"}) ==
        "RAPID X20 Z5\nTHREAD X20 Z-10 pitch 1.5 start 90\nTHREAD X20 Z-20 pitch 1.5\nTHREAD X20 Z-30 pitch 2 change "
        "0.1\n"
        "THREAD X20 Z-40 pitch 2 change -0.1\nTAP X20 Z-50 pitch -1.25\nRAPID X20 Z5\n");
  RunFixture lead;
  CHECK(lead.Trace({"G0 Z5", "G33 Z-10"}) == "RAPID Z5\nALARM geometry thread without a lead\n");
  // On a taper the lead is that of the longer way; under the other letter it would mean something else.
  RunFixture taper;
  CHECK(taper.Trace({"G0 X0 Z0", "G33 X2 Z-10 K1.5"}) == "RAPID X0 Z0\nTHREAD X2 Z-10 pitch 1.5\n");
  RunFixture wrong;
  wrong.Trace({"G0 X0 Z0", "G33 X20 Z-10 K1.5"});
  CHECK(wrong.result.outcome == Outcome::kRefused);
  CHECK(wrong.Finding() == "this cannot be run: a lead under the letter of the axis with the shorter way");
}

TEST_CASE_FIXTURE(RunFixture, "the lead of a thread is F on some controls, and the centre word its change") {
  machine.thread_lead_from_feed = true;
  machine.start.feed_mode = ir::FeedMode::kPerRevolution;
  CHECK(Trace({"G0 Z5", "G33 Z-10 F1.5", "G34 Z-20 F2 K0.1", "Z-30 F2 K-0.1"}) ==
        "RAPID Z5\nTHREAD Z-10 pitch 1.5\nTHREAD Z-20 pitch 2 change 0.1\nTHREAD Z-30 pitch 2 change -0.1\n");
}

TEST_CASE_FIXTURE(RunFixture, "under inverse time F of a thread is a lead only where the control takes it from F") {
  CHECK(Trace({"G700 G93 G1 X1 F2", "G33 Z-1 K0.1 F3", "G1 X2"}) ==
        "LINE X25.4 F2/t\nTHREAD X25.4 Z-25.4 pitch 2.54\nLINE X50.8 Z-25.4 F3/t\n");
}

TEST_CASE_FIXTURE(RunFixture, "a motion word of one block gives way to the one before") {
  CHECK(Trace({"G0 Z5 F100", "G63 Z-5", "Z6"}) == "RAPID Z5\nLINE Z-5 F100\nRAPID Z6\n");
}

TEST_CASE_FIXTURE(RunFixture, "behind a probe nobody knows where the axis stands") {
  CHECK(Trace({"G0 X5 Z5 F100", "MEAS X1", "X9"}) == "RAPID X5 Z5\nPROBE X1 Z5 F100\nRAPID X9 Z5\n");
  RunFixture after;
  after.Trace({"G0 X5 F100", "MEAS X1", "G91 X1"});
  CHECK(after.Finding() == "increment for X from an unknown position");
}

TEST_CASE_FIXTURE(RunFixture, "dwell leaves feed and speed as they are") {
  CHECK(Trace({"G1 X1 F200", "G4F=2.5", "X2", "G4S=5", "X3"}) ==
        "LINE X1 F200\nDWELL 2.5\nLINE X2 F200\nDWELL 5/r\nLINE X3 F200\n");
}

TEST_CASE_FIXTURE(RunFixture, "poles and polar words (vector 60)") {
  CHECK(Trace({"G0 X0 Y0", "G111 X20 Y10", "G1 RP=50 AP=30 F1000", "G110 X-10 Y20", "G1 RP=30 AP=45", "G112 X40 Y20",
               "G1 RP=30 AP=135", "G1 RP=10", "G1 AP=IC(45)"}) ==
        "RAPID X0 Y0\nLINE X63.30127 Y35 F1000\nLINE X74.514474 Y76.213203 F1000\nLINE X72.088067 Y96.213203 F1000\n"
        "LINE X86.230202 Y82.071068 F1000\nLINE X83.30127 Y75 F1000\n");
  RunFixture missing;
  CHECK(missing.Trace({"G0 AP=10"}) == "ALARM geometry polar radius or angle is missing\n");
}

TEST_CASE_FIXTURE(RunFixture, "new values for the present position move the zero point") {
  CHECK(Trace({"G0 X10 Y5", "G92 X0", "X1", "Y6"}) == "RAPID X10 Y5\nRAPID X11 Y5\nRAPID X11 Y6\n");
}

TEST_CASE_FIXTURE(RunFixture, "surface speed with a feed mode of its own keeps the feed") {
  CHECK(Trace({"G1 X1 F100", "G96 G94", "X2"}) == "LINE X1 F100\nLINE X2 F100\n");
}

TEST_CASE_FIXTURE(RunFixture, "words of an arc are never dropped") {
  Trace({"G0 X0 Y0", "G1 X5 I2 F100"});
  CHECK(Finding().find("no arc is in force") != std::string::npos);
  RunFixture closed;
  CHECK(closed.Trace({"G0 X0 Y0 Z0 F100", "CIP I1=10 J1=0"}) ==
        "RAPID X0 Y0 Z0\nALARM circle end point is the start point\n");
}

TEST_CASE_FIXTURE(RunFixture, "an empty program has no end, or is at its end") {
  ir::ProgramBuilder program(module, "EMPTY");
  program.Finish();
  CHECK(Run() == "ALARM end program EMPTY has no end\n");
  machine.file_end_is_end = true;
  CHECK(Run() == "END\n");
}

TEST_CASE_FIXTURE(RunFixture, "words whose mode nothing has set are refused") {
  machine.start = {};
  Trace({"X1"});
  CHECK(result.outcome == Outcome::kRefused);
  CHECK(Finding().find("is not known here") != std::string::npos);
}

}  // namespace ncport::exec
