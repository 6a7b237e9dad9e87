#include "backends/sinumerik/map_tools.h"

#include "tests/unit/backends/sinumerik/pass_fixture.h"

namespace ncport::backends::sinumerik {
namespace {

using test::Passed;
using test::Setting;

Setting Mill() {
  Setting setting;
  setting.tools = {{"T1 H1", "T11 D1"}, {"T1 H1 D21", "T11 D1"}, {"T2 H2", "T=\"DRILL 8\" D2"}};
  return setting;
}
Passed Mapped(std::string_view blocks, const Setting& setting = Mill()) { return test::Run(blocks, MapTools, setting); }

void Refused(std::string_view blocks, std::string_view why) {
  CAPTURE(blocks);
  const Passed passed = Mapped(blocks);
  CHECK(passed.findings == "NC6001");
  CHECK_MESSAGE(passed.messages.find(why) != std::string::npos, passed.messages);
}

constexpr std::string_view kToolOne =
    "  @m:1 : tool = 1; tool-change\n  @m:2 : length-offset 1; length-offset = 1; axis Z = 50\n";

TEST_CASE("map_tools: the register in force is the edge of the tool in force; it is off between change and offset") {
  const Passed passed = Mapped(
      "  @m:1 : tool = 1; tool-change\n"
      "  @m:2 : motion rapid; length-offset 1; length-offset = 1; axis Z = 50\n"
      "  @m:3 : tool = 2\n"
      "  @m:4 : length-offset\n"
      "  @m:5 : tool-change\n"
      "  @m:6 : length-offset 1; length-offset = 2; axis Z = 5\n");
  CHECK(passed.findings.empty());
  CHECK(passed.text ==
        "tool = 11; tool-change; edge = 0\n"
        "motion rapid; axis Z = 50; edge = 1\n"
        "tool = \"DRILL 8\"\n"
        "edge = 0\n"
        "tool-change; edge = 0\n"
        "axis Z = 5; edge = 2\n");
  CHECK(passed.out.tools.size() == 4);
}

TEST_CASE("map_tools: programs without tool words stay as they are") {
  const Passed passed = Mapped("  @m:1 : axis Z = 50; motion rapid\n  @m:2 : length-offset\n  @m:3 : comp off\n");
  CHECK(passed.findings.empty());
  CHECK(passed.text == "axis Z = 50; motion rapid\nlength-offset\ncomp off\n");
  CHECK(passed.out.tools.empty());
}

TEST_CASE("map_tools: the radius register chooses the row") {
  CHECK(Mapped(std::string(kToolOne) + "  @m:3 : motion linear; comp left; radius-offset = 21; axis X = 1\n")
            .text.ends_with("motion linear; comp left; axis X = 1; edge = 1\n"));
}

TEST_CASE("map_tools: what the length of a tool decides waits for its offset") {
  // Without an offset before the change there is none behind it.
  CHECK(Mapped("  @m:1 : tool = 1; tool-change\n  @m:2 : axis Z = 5\n").findings.empty());
  Refused(std::string(kToolOne) + "  @m:3 : tool = 2; tool-change\n  @m:4 : axis Z = 5\n", "a move along Z between");
  Refused(std::string(kToolOne) + "  @m:3 : tool = 2; tool-change\n  @m:4 : call name NOWHERE\n", "a call between");
  Refused("  @m:1 : tool = 1; tool-change\n  @m:2 : comp left; axis X = 5\n", "without a length offset");
  Refused(std::string(kToolOne) + "  @m:3 : comp left; axis X = 5\n", "without a register of this tool");
  // Moves beside it are free.
  CHECK(Mapped(std::string(kToolOne) + "  @m:3 : tool = 2; tool-change\n  @m:4 : axis X = 5\n").findings.empty());
}

TEST_CASE("map_tools: tools and offsets that are not one on all ways are refused where they matter") {
  Refused(
      "  @m:1 : jump forward label A = lt(R[1], 2)\n"
      "  @m:2 : tool = 1; tool-change\n"
      "  @m:3 label A : length-offset 1; length-offset = 1; axis X = 5\n",
      "not one on all ways");
  Refused(
      "  @m:1 : tool = 1; tool-change\n"
      "  @m:2 skip 1 : tool = 2; tool-change\n"
      "  @m:3 : length-offset 1; length-offset = 1; axis X = 5\n",
      "not one on all ways");
  Refused("  @m:1 : tool = R[1]; tool-change\n", "a computed tool");
  Refused("  @m:1 : tool = 1; tool-change\n  @m:2 : length-offset 1; length-offset = R[1]; axis X = 5\n",
          "not one on all ways");
  // Ways with the same tool are one.
  CHECK(Mapped("  @m:1 : tool = 1; tool-change\n"
               "  @m:2 : jump forward label A = lt(R[1], 2)\n"
               "  @m:3 : axis X = 1\n"
               "  @m:4 label A : length-offset 1; length-offset = 1; axis Z = 5\n")
            .findings.empty());
}

TEST_CASE("map_tools: the length of an edge lies along the third axis of the plane: other planes are refused") {
  Refused(std::string(kToolOne) + "  @m:3 : plane zx\n", "another plane than G17");
  Refused(
      "  @m:1 : plane zx\n  @m:2 : tool = 1; tool-change\n  @m:3 : length-offset 1; length-offset = 1; axis X = 5\n",
      "in another plane than G17");
  Refused("  @m:1 : tool = 1; tool-change\n  @m:2 : length-offset 2; length-offset = 1; axis X = 5\n",
          "counts downward");
}

TEST_CASE("map_tools: G53 leaves the offset out, SUPA does not: the edge is off for that block") {
  CHECK(Mapped(std::string(kToolOne) + "  @m:3 skip 1 : machine-coords; axis Z = 0\n")
            .text.ends_with("machine-coords; axis Z = 0; edge = 0\nedge = 1\n"));
  CHECK(Mapped(std::string(kToolOne) + "  @m:3 : machine-coords; axis X = 0\n")
            .text.ends_with("machine-coords; axis X = 0\n"));
  // Nothing selects a tool: an assumption.
  CHECK(Mapped("  @m:1 : machine-coords; axis Z = 0\n").out.assumptions.size() == 1);
}

TEST_CASE("map_tools: a tool without a row is asked for once") {
  const Passed passed = Mapped("  @m:1 : tool = 7; tool-change\n  @m:2 : axis X = 1\n  @m:3 : tool = 7; tool-change\n");
  CHECK(passed.findings == "NC6004");
}

TEST_CASE("map_tools: a program that is called keeps the selection of its caller, one that selects leaves its own") {
  const Passed passed = test::RunAll(
      "program M main @m:0\n"
      "  @m:1 : tool = 1; tool-change\n"
      "  @m:2 : length-offset 1; length-offset = 1; axis Z = 50\n"
      "  @m:3 : call name S calls S\n"
      "  @m:4 : machine-coords; axis Z = 0\n"
      "program S sub @m:10\n"
      "  @m:11 : tool = 2; tool-change\n"
      "  @m:12 : length-offset 1; length-offset = 2; axis Z = 5\n",
      MapTools, Mill());
  CHECK(passed.findings.empty());
  CHECK(passed.text.find("machine-coords; axis Z = 0; edge = 0\nedge = 2\n") != std::string::npos);
}

Passed Turned(std::string_view blocks) {
  Setting setting;
  setting.lathe = true;
  setting.tools = {{"T0101", "T1 D1"}, {"T0202", "T=\"ROUGH\" D3"}};
  return test::Run(blocks, MapTools, setting);
}

TEST_CASE("map_tools: a turret word is the tool and its edge; without an offset the edge is off") {
  const Passed passed = Turned(
      "  @m:1 : tool = 1 {digits 4}; tool-offset = 1; axis X = 5\n"
      "  @m:2 : tool = 2 {digits 4}; tool-offset = 2\n"
      "  @m:3 : tool = 1 {digits 4}; tool-offset = 0\n"
      "  @m:4 : tool = 0; tool-offset = 0\n"
      "  @m:5 : axis X = 1\n");
  CHECK_MESSAGE(passed.findings.empty(), passed.messages);
  CHECK(passed.text ==
        "tool = 1; edge = 1; axis X = 5\n"
        "tool = \"ROUGH\"; edge = 3\n"
        "tool = 1; edge = 0\n"
        "edge = 0\n"
        "axis X = 1\n");
}

TEST_CASE("map_tools: an offset without a tool, a computed one and one without a row are findings") {
  CHECK(Turned("  @m:1 : tool-offset = 3\n").findings == "NC6001");
  CHECK(Turned("  @m:1 : tool = R[1]; tool-offset = R[2]\n").findings == "NC6001");
  CHECK(Turned("  @m:1 : tool = 1; tool-offset = 5\n").findings == "NC6004");
}

}  // namespace
}  // namespace ncport::backends::sinumerik
