// Positions through branches, calls, loops and modes; plane words are in absolute_dimensions_test.cc.
#include <string>

#include "ir/transform/absolute_dimensions.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

struct Absolute {
  std::string text;
  std::string findings;
};

struct Setting {
  Distance distance = Distance::kAbsolute;
  Units units = Units::kMm;
  Diameter diameter = Diameter::kRadius;
  bool lathe = false;                   // X is transverse
  std::uint8_t target_diameter = 0xFF;  // axis whose words are diameters on the target
  ModalState sub_entry;
};

/// Whole programs.
Absolute RunAll(const std::string& programs, const Setting& setting = {}, test::Show show = test::Show::kPlain) {
  diag::Sink sink;
  Absolute result;
  const std::string text = test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\n" + test::WithCells(programs), sink,
      [&](Module& module, diag::Sink& findings) {
        Machine machine;
        machine.start.motion = Motion::kLinear;
        machine.start.plane = Plane::kXY;
        machine.start.distance = setting.distance;
        machine.start.units = setting.units;
        machine.start.diameter = setting.diameter;
        if (setting.lathe) machine.transverse_axis = 0;
        AbsoluteDimensionsConfig config;
        config.diameter_axis = setting.target_diameter;
        config.sub_entry = setting.sub_entry;
        config.target = "the target";
        const bool done = AbsoluteDimensions(module, machine, config, findings);
        CHECK(done == !findings.HasErrors());
        return done;
      },
      show);
  result.text = test::Brief(text);
  result.findings = test::CodesOf(sink);
  return result;
}

/// The blocks of one main program.
Absolute Run(std::string_view blocks, const Setting& setting = {}, test::Show show = test::Show::kPlain) {
  Absolute result = RunAll("program M main @m:0\n  var W real local\n  var V real local dims 3\n" + std::string(blocks),
                           setting, show);
  result.text.erase(0, result.text.find('\n') + 1);
  return result;
}

TEST_CASE("absolute words under absolute modes stay as they are") {
  const Absolute same =
      Run("  @m:1 : axis X = 1.50; axis Y = R[1]; feed = 100\n"
          "  @m:2 : motion arc-cw; axis X = 3; center I step = 1\n"
          "  @m:3 : radius = 5; axis Y = 2\n"
          "  @m:4 : dwell-seconds = 2\n");
  CHECK(same.findings.empty());
  CHECK(same.text ==
        "axis X absolute = 1.50; axis Y absolute = R[1]; feed = 100\n"
        "motion arc-cw; axis X absolute = 3; center I step = 1\n"
        "radius = 5; axis Y absolute = 2\n"
        "dwell-seconds = 2\n");
}

TEST_CASE("the distance mode goes, a block that held nothing else too, its label and comment stay") {
  const Absolute made =
      Run("  @m:1 : axis X = 1; axis Y = 2\n"
          "  @m:2 : distance incremental\n"
          "  @m:3 label A : distance incremental\n"
          "  @m:4 : axis X = 10; axis Y absolute = 7; distance incremental\n"
          "  @m:5 : distance absolute; axis X incremental = -1\n");
  CHECK(made.findings.empty());
  CHECK(made.text ==
        "axis X absolute = 1; axis Y absolute = 2\n"
        "label A -\n"
        "axis X absolute = 11; axis Y absolute = 7\n"
        "axis X absolute = 10\n");
}

TEST_CASE("a step away and back is the same position to the digit, however often") {
  std::string blocks = "  @m:1 : axis X = 0.3\n";
  for (int i = 0; i < 50; ++i) blocks += "  @m:2 : axis X incremental = 0.1\n  @m:3 : axis X incremental = -0.1\n";
  const std::string text = Run(blocks).text;
  CHECK(text.ends_with("axis X absolute = 0.3\n"));
}

TEST_CASE("lengths of inch programs are mm, feeds too; degrees and times are not") {
  const Absolute made =
      Run("  @m:1 : units inch\n"
          "  @m:2 : axis X = 1; axis C = 90; feed = 10\n"
          "  @m:3 : axis X incremental = 0.5; axis C incremental = 5\n"
          "  @m:4 : motion arc-cw; axis X = 2; center I step = 1; dwell-seconds = 1\n"
          "  @m:5 : radius = -1; axis X = R[1]\n");
  CHECK(made.findings.empty());
  CHECK(made.text ==
        "axis X absolute = 25.4; axis C absolute = 90; feed = 254\n"
        "axis X absolute = 38.1; axis C absolute = 95\n"
        "motion arc-cw; axis X absolute = 50.8; center I step = 25.4; dwell-seconds = 1\n"
        "radius = -25.4; axis X absolute = mul(25.4, R[1])\n");
}

TEST_CASE("in inches a feed or speed whose mode is open may not be scaled or left, where both modes occur") {
  const Absolute feed =
      Run("  @m:1 : units inch; feed-mode inverse-time\n"
          "  @m:2 label L : axis X = 1; feed = 10\n"
          "  @m:3 : feed-mode per-minute\n"
          "  @m:4 : jump backward label L = lt(R[1], 4)\n");
  CHECK(feed.findings == "NC5006");
  const Absolute speed =
      Run("  @m:1 : units inch; speed-mode constant-surface\n"
          "  @m:2 label L : axis X = 1; speed = 10\n"
          "  @m:3 : speed-mode rpm\n"
          "  @m:4 : jump backward label L = lt(R[1], 4)\n");
  CHECK(speed.findings == "NC5006");
}

TEST_CASE("the transverse axis in the terms of the target (sinumerik-8.5)") {
  Setting setting;
  setting.lathe = true;
  setting.target_diameter = 0;
  const std::string_view blocks =
      "  @m:1 : axis X = 10; axis Z = 1\n"
      "  @m:2 : axis X incremental = 2\n"
      "  @m:3 : axis X absolute-radius = 3\n"
      "  @m:4 : axis X incremental-radius = 1\n"
      "  @m:5 : axis X incremental-diameter = 1\n"
      "  @m:6 : axis X absolute-diameter = 8\n";
  setting.diameter = Diameter::kDiameter;
  CHECK(Run(blocks, setting).text ==
        "axis X absolute = 10; axis Z absolute = 1\naxis X absolute = 12\naxis X absolute = 6\naxis X absolute = 8\n"
        "axis X absolute = 9\naxis X absolute = 8\n");
  setting.diameter = Diameter::kDiameterAbsolute;  // increments are radii
  CHECK(Run(blocks, setting).text ==
        "axis X absolute = 10; axis Z absolute = 1\naxis X absolute = 14\naxis X absolute = 6\naxis X absolute = 8\n"
        "axis X absolute = 9\naxis X absolute = 8\n");
  setting.diameter = Diameter::kRadius;
  CHECK(Run(blocks, setting).text ==
        "axis X absolute = 20; axis Z absolute = 1\naxis X absolute = 24\naxis X absolute = 6\naxis X absolute = 8\n"
        "axis X absolute = 9\naxis X absolute = 8\n");
  setting.target_diameter = 0xFF;
  setting.diameter = Diameter::kDiameter;
  CHECK(Run(blocks, setting).text ==
        "axis X absolute = 5; axis Z absolute = 1\naxis X absolute = 6\naxis X absolute = 3\naxis X absolute = 4\n"
        "axis X absolute = 4.5\naxis X absolute = 4\n");
}

TEST_CASE("an increment from a position that is not known on every way is refused at its word") {
  const auto refused = [](std::string_view blocks) { return Run(blocks).findings; };
  CHECK(refused("  @m:1 : axis X incremental = 1\n") == "NC5001");
  CHECK(refused("  @m:1 : axis X incremental = 1; axis Y incremental = 1\n") == "NC5001 NC5001");
  // One way only has a position.
  CHECK(refused("  @m:1 : jump forward label A = lt(R[1], 2)\n"
                "  @m:2 : axis X = 5\n"
                "  @m:3 label A : axis X incremental = 1\n") == "NC5001");
  // The block may be skipped.
  CHECK(refused("  @m:1 : axis X = 1\n"
                "  @m:2 skip 1 : axis X = 5\n"
                "  @m:3 : axis X incremental = 1\n") == "NC5001");
  CHECK(refused("  @m:1 : axis X = 1\n"
                "  @m:2 : when = lt(R[1], 2); axis X = 5\n"
                "  @m:3 : axis X incremental = 1\n") == "NC5001");
  // The reference point, and coordinates of the machine.
  CHECK(refused("  @m:1 : axis X = 1\n"
                "  @m:2 : reference reference; axis X = 0\n"
                "  @m:3 : axis X incremental = 1\n") == "NC5001");
  CHECK(refused("  @m:1 : axis X = 1\n"
                "  @m:2 : machine-coords; axis X = 0\n"
                "  @m:3 : axis X incremental = 1\n") == "NC5001");
  // Another zero point.
  CHECK(refused("  @m:1 : axis X = 1\n"
                "  @m:2 : work-offset #55\n"
                "  @m:3 : axis X incremental = 1\n") == "NC5001");
  // A program that is not here.
  CHECK(refused("  @m:1 : axis X = 1\n"
                "  @m:2 : call name NOWHERE\n"
                "  @m:3 : axis X incremental = 1\n") == "NC5001");
}

TEST_CASE("a block that may be skipped but leads to the same place changes nothing") {
  const Absolute made =
      Run("  @m:1 : axis X = 1\n"
          "  @m:2 skip 1 : axis X = 1\n"
          "  @m:3 : axis X incremental = 1\n");
  CHECK(made.findings.empty());
  CHECK(made.text.ends_with("axis X absolute = 2\n"));
}

TEST_CASE("ways with different positions meet: a local holds the position of each") {
  const Absolute made =
      Run("  @m:1 : axis X = 1\n"
          "  @m:2 link +2 : if = lt(R[1], 2)\n"
          "  @m:3 : axis X = 5\n"
          "  @m:4 link -2 : end-if\n"
          "  @m:5 : axis X incremental = 1\n"
          "  @m:6 : axis X incremental = 1\n");
  CHECK(made.findings.empty());
  CHECK(made.text ==
        "axis X absolute = 1\n"
        "assign variable POS_X = 1\n"
        "if = lt(R[1], 2)\n"
        "axis X absolute = 5\n"
        "assign variable POS_X = 5\n"
        "end-if\n"
        "axis X absolute = add(variable POS_X, 1)\n"
        "axis X absolute = add(variable POS_X, 2)\n");
}

TEST_CASE("what a sum reads is held before it changes, by whatever changes it") {
  const auto made = [](std::string_view changes) {
    return RunAll(
        "program M main @m:0\n  var W real local\n  var V real local dims 3\n"
        "  @m:1 : axis X = " +
        std::string(changes.substr(0, changes.find('|'))) + "\n" + std::string(changes.substr(changes.find('|') + 1)) +
        "  @m:9 : axis X incremental = 1\n"
        "program SET sub @m:20\n  param P real parameter ref\n  @m:21 : assign variable P = 3\n"
        "program COUNT sub @m:30\n  @m:31 link +1 : for R[1] to 5 = 1\n  @m:32 link -1 : end-for\n"
        "program PUT sub @m:40\n  @m:41 : assign R[1] = 5\n"
        "program DEEP sub @m:50\n  @m:51 : call name PUT calls PUT\n");
  };
  for (const std::string_view changes :
       {"R[1]|  @m:2 : assign R[1] = 7\n", "R[1]|  @m:2 : assign cell-at R[R[2]] = 7\n",
        "cell-at R[R[2]]|  @m:2 : assign R[2] = 7\n", "element V(0:int)|  @m:2 : assign element V(R[1]) = 7\n",
        "element V(1:int)|  @m:2 : assign-list place element V(0:int) (1, 2)\n",
        "R[1]|  @m:2 : assign-list place R[0] (1, 2)\n",
        "variable W|  @m:2 : call name SET calls SET (0: variable W)\n", "R[1]|  @m:2 : call name COUNT calls COUNT\n",
        "R[1]|  @m:2 : call name PUT calls PUT\n", "R[1]|  @m:2 : call name DEEP calls DEEP\n",
        "R[1]|  @m:2 link +1 : for R[1] to 5 = 1\n  @m:3 link -1 : end-for\n"}) {
    CAPTURE(changes);
    const Absolute result = made(changes);
    CHECK(result.findings.empty());
    CHECK(result.text.find("assign variable POS_X = ") != std::string::npos);
    CHECK(result.text.find("axis X absolute = add(variable POS_X, 1)\n") != std::string::npos);
  }
}

TEST_CASE("what changes nothing of the sum holds nothing") {
  const Absolute made = RunAll(
      "program M main @m:0\n  var W real local\n"
      "  @m:1 : axis X = variable W; axis Y = R[1]\n"
      "  @m:2 : assign R[2] = 5\n"
      "  @m:3 : call name GET calls GET (0: variable W)\n"
      "  @m:4 : axis X incremental = 1; axis Y incremental = 1\n"
      "program GET sub @m:20\n  param P real parameter\n  @m:21 : assign variable P = 3\n");
  CHECK(made.findings.empty());
  CHECK(made.text.find("POS_") == std::string::npos);
}

TEST_CASE("what is held in front of a block takes the place that jumps go to, a main block's too") {
  const Absolute made =
      Run("  @m:1 : axis X = R[1]\n"
          "  @m:2 N10 main-block : assign R[1] = add(R[1], 1)\n"
          "  @m:3 : axis X incremental = 1\n"
          "  @m:4 : axis X = R[1]\n"
          "  @m:5 : jump backward main-number 10 = lt(R[1], 4)\n",
          {}, test::Show::kMarks);
  CHECK(made.findings.empty());
  CHECK(made.text.find("main-block N10 assign variable POS_X = R[1]\n") != std::string::npos);
  const Absolute plain =
      Run("  @m:1 : axis X = R[1]\n"
          "  @m:2 label A : assign R[1] = add(R[1], 1)\n"
          "  @m:3 : axis X incremental = 1\n"
          "  @m:4 : axis X = R[1]\n"
          "  @m:5 : jump backward label A = lt(R[1], 4)\n");
  CHECK(plain.text ==
        "axis X absolute = R[1]\n"
        "label A assign variable POS_X = R[1]\n"
        "assign R[1] = add(R[1], 1)\n"
        "axis X absolute = add(variable POS_X, 1)\n"
        "axis X absolute = R[1]\n"
        "jump backward label A = lt(R[1], 4)\n");
}

TEST_CASE("modes that the ways leave open are findings where a word needs them, and only there") {
  Setting setting;
  setting.distance = Distance::kUnknown;
  CHECK(Run("  @m:1 : axis X = 1\n", setting).findings == "NC5006");
  CHECK(Run("  @m:1 : axis X absolute = 1\n", setting).findings.empty());
  CHECK(Run("  @m:1 : distance absolute; axis X = 1\n", setting).findings.empty());
  CHECK(Run("  @m:1 : jump forward label A = lt(R[1], 2)\n"
            "  @m:2 : distance incremental\n"
            "  @m:3 label A : axis X = 1\n")
            .findings == "NC5006");
  setting = {};
  setting.lathe = true;
  setting.diameter = Diameter::kUnknown;
  CHECK(Run("  @m:1 : axis X = 1\n", setting).findings == "NC5006");
  CHECK(Run("  @m:1 : axis Z = 1; axis X absolute-diameter = 1\n", setting).findings.empty());
  // Behind a jump that always leaves nothing runs.
  setting = {};
  setting.distance = Distance::kUnknown;
  CHECK(Run("  @m:1 : jump forward label A\n"
            "  @m:2 : axis X = 1\n"
            "  @m:3 label A : axis X absolute = 1\n",
            setting)
            .findings.empty());
}

TEST_CASE("a subprogram that nothing calls starts with the modes that the user declares") {
  const std::string sub = "program S sub @m:10\n  @m:11 : axis X = 1\n";
  CHECK(RunAll(sub).findings == "NC5006");
  Setting setting;
  setting.sub_entry.distance = Distance::kAbsolute;
  CHECK(RunAll(sub, setting).findings.empty());
  setting.sub_entry.distance = Distance::kIncremental;
  CHECK(RunAll(sub, setting).findings == "NC5001");
}

}  // namespace
}  // namespace ncport::ir::transform
