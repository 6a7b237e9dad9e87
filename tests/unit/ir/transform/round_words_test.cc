#include "ir/transform/round_words.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

struct Setting {
  WordError error = WordError::kRound;
  Units units = Units::kMm;
  Distance distance = Distance::kAbsolute;
  Motion motion = Motion::kLinear;
};

std::string Rounded(std::string_view blocks, diag::Sink& sink, const Setting& setting = {}) {
  const std::string text = test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nsystem $P_EP programmed-position real\n"
      "program M main @m:0\n" +
          test::WithCells(blocks),
      sink, [&](Module& module, diag::Sink& findings) {
        Machine machine;
        machine.word_error = setting.error;
        machine.increment = 0.001;
        machine.start.units = setting.units;
        machine.start.distance = setting.distance;
        machine.start.motion = setting.motion;
        machine.start.plane = Plane::kXY;
        return RoundWords(module, machine, {}, findings);
      });
  CHECK(text.find("rounds") == std::string::npos);
  return test::Brief(text.substr(std::string_view("program M main\n").size()));
}

TEST_CASE("a single absolute word stays; increments would drift and are rounded") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : axis X = R[1] {rounds}\n"
                "  @m:2 : axis X incremental = R[1] {rounds}\n"
                "  @m:3 : distance incremental; axis X = R[1] {rounds}; axis Y absolute = R[1] {rounds}\n",
                sink) ==
        "axis X = R[1]\n"
        "axis X incremental = div(call round(mul(R[1], 1000.00000001)), 1000)\n"
        "distance incremental; axis X = div(call round(mul(R[1], 1000.00000001)), 1000); axis Y absolute = R[1]\n");
  CHECK(sink.Empty());
}

TEST_CASE("the least increment follows the unit; degrees have none") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : units inch; axis X incremental = R[1] {rounds}\n"
                "  @m:2 : axis C incremental = R[1] {rounds}\n",
                sink) ==
        "units inch; axis X incremental = div(call round(mul(R[1], 10000.0000001)), 10000)\n"
        "axis C incremental = div(call round(mul(R[1], 1000.00000001)), 1000)\n");
  CHECK(sink.Empty());
}

TEST_CASE("absolute words in inches are rounded where other moves are in millimetres") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : units inch; axis X = R[1] {rounds}; axis C = R[1] {rounds}\n"
                "  @m:2 : units mm; axis X = R[1] {rounds}\n",
                sink) ==
        "units inch; axis X = div(call round(mul(R[1], 10000.0000001)), 10000); axis C = R[1]\n"
        "units mm; axis X = R[1]\n");
  CHECK(sink.Empty());
}

TEST_CASE("where an arc has an end point, absolute words, centres and radii are rounded everywhere") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : axis X = R[1] {rounds}\n"
                "  @m:2 : motion arc-cw; axis X = R[2] {rounds}; center I = R[3] {rounds}\n"
                "  @m:3 : axis X = 5; radius = R[4] {rounds}\n",
                sink) ==
        "axis X = div(call round(mul(R[1], 1000.00000001)), 1000)\n"
        "motion arc-cw; axis X = div(call round(mul(R[2], 1000.00000001)), 1000); "
        "center I = div(call round(mul(R[3], 1000.00000001)), 1000)\n"
        "axis X = 5; radius = div(call round(mul(R[4], 1000.00000001)), 1000)\n");
  CHECK(sink.Empty());
}

TEST_CASE("a motion that is not known may be an arc") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : axis X = R[1] {rounds}\n", sink, {.motion = Motion::kUnknown}) ==
        "axis X = div(call round(mul(R[1], 1000.00000001)), 1000)\n");
  CHECK(sink.Empty());
}

TEST_CASE("positions that the program reads back are rounded") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : axis X = R[1] {rounds}\n"
                "  @m:2 : assign R[2] = system $P_EP(axis-name X)\n",
                sink) ==
        "axis X = div(call round(mul(R[1], 1000.00000001)), 1000)\n"
        "assign R[2] = system $P_EP(axis-name X)\n");
  CHECK(sink.Empty());
}

TEST_CASE("a computed speed is a whole number") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : speed = div(R[1], 3) {rounds}\n", sink) == "speed = call round(div(R[1], 3))\n");
  CHECK(sink.Empty());
}

TEST_CASE("words without the mark and controls without that error change nothing") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : axis X incremental = R[1]; speed = R[2]; feed = R[3] {rounds}\n", sink) ==
        "axis X incremental = R[1]; speed = R[2]; feed = R[3]\n");
  CHECK(Rounded("  @m:1 : axis X incremental = R[1] {rounds}\n", sink, {.error = WordError::kNone}) ==
        "axis X incremental = R[1]\n");
  CHECK(sink.Empty());
}

TEST_CASE("an increment of a unit that is not known, or that the control cuts, is a finding") {
  {
    diag::Sink sink;
    Rounded("  @m:1 : axis X incremental = R[1] {rounds}\n", sink, {.units = Units::kUnknown});
    CHECK(test::CodesOf(sink) == "NC5006");
  }
  {
    diag::Sink sink;
    Rounded(
        "  @m:1 : axis X incremental = R[1] {rounds}\n"
        "  @m:2 : axis X = R[1] {rounds}\n"
        "  @m:3 : center I = R[1] {rounds}\n",
        sink, {.error = WordError::kTruncate});
    CHECK(test::CodesOf(sink) == "NC6001 NC6001");
  }
}

TEST_CASE("under a distance mode that is not known a word is rounded as the control does: that is right in both") {
  diag::Sink sink;
  CHECK(Rounded("  @m:1 : axis X = R[1] {rounds}\n", sink, {.distance = Distance::kUnknown}) ==
        "axis X = div(call round(mul(R[1], 1000.00000001)), 1000)\n");
  CHECK(sink.Empty());
}

}  // namespace
}  // namespace ncport::ir::transform
