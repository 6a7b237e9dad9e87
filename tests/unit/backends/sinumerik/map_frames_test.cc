#include "backends/sinumerik/map_frames.h"

#include "tests/unit/backends/sinumerik/pass_fixture.h"

namespace ncport::backends::sinumerik {
namespace {

using test::Passed;
using test::Setting;

Passed Framed(std::string_view blocks, const Setting& setting = {}, ir::test::Show show = ir::test::Show::kPlain) {
  return test::Run(blocks, MapFrames, setting, show);
}

void Refused(std::string_view blocks, std::string_view why) {
  CAPTURE(blocks);
  const Passed passed = Framed(blocks);
  CHECK(passed.findings.starts_with("NC6001"));
  CHECK_MESSAGE(passed.messages.find(why) != std::string::npos, passed.messages);
}

TEST_CASE("map_frames: a local shift is TRANS with the same axes") {
  const Passed passed = Framed(
      "  @m:1 : frame local-shift; axis X = 10; axis Y = R[1]\n"
      "  @m:2 : axis X = 1\n"
      "  @m:3 : frame local-shift; axis X = 0; axis Y absolute = 0\n");
  CHECK(passed.findings.empty());
  CHECK(passed.text ==
        "frame translate; axis X = 10; axis Y = R[1]\n"
        "axis X = 1\n"
        "frame translate; axis X = 0; axis Y = 0\n");
}

TEST_CASE("map_frames: shifts that leave axes as they are, increments and words beside are refused") {
  Refused("  @m:1 : frame local-shift; axis X = 10; axis Y = 5\n  @m:2 : frame local-shift; axis X = 0\n",
          "names other axes");
  Refused("  @m:1 : frame local-shift\n", "names other axes");
  Refused("  @m:1 : frame local-shift; axis X incremental = 10\n", "an increment in a shift");
  Refused("  @m:1 : frame local-shift; axis X = 10; feed = 5\n", "a word beside a shift");
  Refused(
      "  @m:1 : frame local-shift; axis X = 10\n  @m:2 : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 5\n",
      "stand beside each other");
}

TEST_CASE("map_frames: a shift in diameters is one in radii there (sinumerik-8.5)") {
  Setting lathe;
  lathe.lathe = true;
  lathe.machine = [](ir::Machine& machine) {
    machine.frame_shift_in_diameter = true;
    machine.transverse_axis = 0;
  };
  CHECK(Framed("  @m:1 : frame local-shift; axis X = 10; axis Z = 10\n  @m:2 : frame local-shift; axis X = R[1]; axis "
               "Z = 0\n",
               lathe)
            .text ==
        "frame translate; axis X = 5; axis Z = 10\n"
        "frame translate; axis X = div(R[1], 2); axis Z = 0\n");
}

TEST_CASE("map_frames: a rotation about the origin is ROT, about another point there, turn and back") {
  CHECK(Framed("  @m:1 : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 30\n  @m:2 : frame rotate-end\n")
            .text == "frame rotate; frame-angle = 30\nframe translate\n");
  CHECK(Framed("  @m:1 skip 1 N10 : plane xy; frame rotate-about; axis X = 5; axis Y = R[1]; frame-angle = R[2]\n", {},
               ir::test::Show::kMarks)
            .text ==
        "skip 1 N10 plane xy\n"
        "skip 1 frame translate; axis X = 5; axis Y = R[1]\n"
        "skip 1 frame add-rotate; frame-angle = R[2]\n"
        "skip 1 frame add-translate; axis X = negate(group(5)); axis Y = negate(group(R[1]))\n");
}

TEST_CASE("map_frames: the end of a rotation beside a move comes before it") {
  CHECK(Framed("  @m:1 : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 30\n"
               "  @m:2 N20 label A : frame rotate-end; motion rapid; axis X = 1\n")
            .text ==
        "frame rotate; frame-angle = 30\n"
        "label A N20 frame translate\n"
        "motion rapid; axis X = 1\n");
  Refused(
      "  @m:1 : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 30\n"
      "  @m:2 : frame rotate-end; axis X = system $P_EP(axis-name X)\n",
      "beside the end of a rotation");
  Refused(
      "  @m:1 : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 30\n"
      "  @m:2 : frame rotate-end; call name S\n",
      "beside the end of a rotation");
}

TEST_CASE("map_frames: rotations that hang on what is not written are refused") {
  Refused("  @m:1 : frame rotate-about; axis X = 0; axis Y = 0\n", "angle of a parameter");
  Refused("  @m:1 : frame rotate-about; frame-angle = 30\n", "about the present position");
  Refused("  @m:1 : frame rotate-about; axis X = 0; frame-angle = 30\n", "about the present position");
  Refused("  @m:1 : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 30; feed = 5\n", "beside a rotation");
  Refused(
      "  @m:1 : jump forward label A = lt(R[1], 2)\n  @m:2 : plane zx\n"
      "  @m:3 label A : frame rotate-about; axis X = 0; axis Y = 0; frame-angle = 30\n",
      "plane is not one");
  Refused("  @m:1 : frame rotate-about; frame rotate-end; axis X = 0; axis Y = 0; frame-angle = 30\n",
          "several frame words");
}

TEST_CASE("map_frames: programs without frames stay as they are") {
  const std::string same = "axis X = 1; plane xy\nmotion rapid\n";
  CHECK(Framed("  @m:1 : axis X = 1; plane xy\n  @m:2 : motion rapid\n").text == same);
}

}  // namespace
}  // namespace ncport::backends::sinumerik
