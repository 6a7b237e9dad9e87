#include "ir/analysis/axis_positions.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "ir/parse_dump.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::analysis {
namespace {

std::string Text(const Interval& way) {
  if (way.low == way.high) return fmt::format("{:g}", way.low);
  return way.high == kInfinity ? "?" : fmt::format("{:g}..{:g}", way.low, way.high);
}

Machine Lathe() {
  Machine machine;
  machine.lathe = true;
  machine.transverse_axis = 0;
  machine.start.units = Units::kMm;
  machine.start.distance = Distance::kAbsolute;
  machine.start.diameter = Diameter::kDiameter;
  machine.start.motion = Motion::kRapid;
  return machine;
}

/// Ways of X and Z in each block of the first program, those that name neither left out.
std::string Ways(const std::string& blocks, const Machine& machine = Lathe()) {
  diag::Sink sink;
  Result<Module> parsed = ParseDump("ncport-ir 1\nspace R 0..9 real kept all zero\n" + test::WithCells(blocks), sink);
  for (const auto& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
  REQUIRE(parsed.Ok());
  const FlowAnalyses analyses(*parsed, machine, {machine.start, {}});
  const AxisPositions positions(*parsed, machine, analyses);
  std::string text;
  const ProgramId program{std::size_t{0}};
  for (const BlockId block : parsed->programs[program].blocks) {
    bool moves = false;
    for (const WordId word : parsed->blocks[block].words) moves = moves || parsed->words[word].op == WordOp::kAxis;
    if (!moves) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", Text(positions.WayOf(program, block, 0)),
                        Text(positions.WayOf(program, block, 2)));
  }
  return text;
}

std::string Main(const std::string& blocks) { return Ways("program M main\n" + blocks); }

TEST_CASE("axis_positions: a way begins where the block before ended; diameters count half") {
  CHECK(Main("@- : axis X = 50; axis Z = 5\n@- : axis X = 52; axis Z = -20\n@- : axis Z = 0\n") == "? ?; 1 25; 0 20");
}

TEST_CASE("axis_positions: increments are the way, and lead on") {
  CHECK(Main("@- : axis X incremental = 4; axis Z incremental = -3\n@- : axis X = 10; axis Z = 0\n"
             "@- : axis X incremental = 4; axis Z incremental = -3\n@- : axis X = 20; axis Z = 1\n") ==
        "2 3; ? ?; 2 3; 3 4");
  CHECK(Main("@- : axis X = 10; axis Z = 0\n@- : distance incremental; axis X = 2; axis Z = -3\n") == "? ?; 1 3");
}

TEST_CASE("axis_positions: inches are lengths in mm, and a unit that is not known is none") {
  CHECK(Main("@- : units inch; axis X = 2; axis Z = 0\n@- : axis X = 4; axis Z = -1\n") == "? ?; 25.4 25.4");
  Machine open = Lathe();
  open.start.units = Units::kUnknown;
  CHECK(Ways("program M main\n@- : axis X = 10; axis Z = 0\n@- : axis X = 4; axis Z = -1\n", open) == "? ?; ? ?");
  open = Lathe();
  open.start.diameter = Diameter::kUnknown;
  CHECK(Ways("program M main\n@- : axis X = 10; axis Z = 0\n@- : axis X = 4; axis Z = -1\n", open) == "? ?; ? 1");
}

TEST_CASE("axis_positions: ways that meet leave a range, loops that climb nothing") {
  CHECK(Main("@- : axis X = 10; axis Z = 0\n@- skip 1 : axis Z = 4\n@- : axis X = 20; axis Z = -1\n") ==
        "? ?; 0 4; 5 1..5");
  CHECK(Main("@- : axis X = 10; axis Z = 0\n@- label A : axis Z incremental = 1\n@- : axis X = 20; axis Z = 0\n"
             "@- : axis Z incremental = 1\n@- : jump backward label A\n") == "? ?; 0 1; 0..5 1..2; 0 1");
  CHECK(Main("@- : axis X = 10; axis Z = 0\n@- label A : axis Z incremental = 1\n@- : axis X = 20\n"
             "@- : jump backward label A = R[1]\n@- : axis Z = 0\n") == "? ?; 0 1; 0..5 0; 0 ?");
}

TEST_CASE("axis_positions: computed words count within their values and the increment") {
  CHECK(Main("@- : assign R[1] = 10\n@- : axis X = 10; axis Z = 0\n@- : axis X = R[1]; axis Z = R[1]\n") ==
        "? ?; 0..0.0005 9.999..10.001");
  CHECK(Main("@- : axis X = 10; axis Z = 0\n@- : axis X = R[1]; axis Z = 3\n") == "? ?; ? 3");
}

TEST_CASE("axis_positions: what moves the zero point or the axes otherwise leaves them unknown") {
  const std::string start = "@- : axis X = 10; axis Z = 0\n", end = "@- : axis X = 20; axis Z = -1\n";
  for (const char* between :
       {"@- : tool = 1\n", "@- : edge = 1\n", "@- : work-offset #55\n", "@- : reference reference; axis X = 0\n",
        "@- : motion probe; axis Z = -1\n", "@- : machine-coords; axis X = 0\n", "@- : frame translate; axis X = 1\n",
        "@- : preset-position; axis X = 1\n", "@- : cycle turn; axis X = 8; axis Z = -3\n"}) {
    CAPTURE(between);
    const std::string ways = Main(start + between + "@- : motion linear\n" + end);
    CHECK_MESSAGE(ways.ends_with("? ?"), ways);
  }
  // Ends in the same block stand in the new coordinates.
  CHECK(Main("@- : tool = 1; axis X = 10; axis Z = 0\n" + end) == "? ?; 5 1");
  // Under a cycle words are no ends of moves.
  CHECK(Main(start + "@- : cycle turn; axis X = 8; axis Z = -3\n" + end).ends_with("? ?"));
}

TEST_CASE("axis_positions: calls carry positions in and back") {
  const std::string sub = "program S sub\n@- : motion rapid; axis X = 30\n@- : return plain\n";
  CHECK(Ways("program M main\n@- : axis X = 10; axis Z = 0\n@- : call name S calls S\n@- : axis X = 20; axis Z = -1\n" +
             sub) == "? ?; 5 1");
}

}  // namespace
}  // namespace ncport::ir::analysis
