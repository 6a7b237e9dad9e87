#include "ir/transform/resolve_axes.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Resolved(std::string_view blocks, Plane start = Plane::kXY) {
  diag::Sink sink;
  const std::string text = test::After(
      "ncport-ir 1\nfile m\naxis SP3\nspace R 0..99 real kept all zero\n"
      "system $P_AXN1 plane-axis axis number 1\nsystem $P_AXN2 plane-axis axis number 2\n"
      "system $P_AXN3 plane-axis axis number 3\nprogram M main @m:0\n  var A axis local\n" +
          test::WithCells(blocks),
      sink, [&](Module& module, diag::Sink&) {
        Machine machine;
        machine.start.plane = start;
        const analysis::FlowGraphs graphs(module);
        const analysis::CallGraph calls(module);
        ResolveAxes(module, analysis::ModalFlow(module, machine, graphs, calls, {machine.start, {}}));
        return true;
      });
  return test::Brief(text.substr(std::string_view("program M main\n").size()));
}

TEST_CASE("a named axis becomes a plain word that keeps its value and mode") {
  CHECK(Resolved("  @m:1 : axis-computed incremental axis-name Z = R[1]; axis-computed group(axis-name SP3) = 2\n") ==
        "axis Z incremental = R[1]; axis SP3 = 2\n");
}

TEST_CASE("the axes of the plane in force") {
  const std::string_view words =
      "axis-computed system $P_AXN1() = 1; axis-computed system $P_AXN2() = 2; axis-computed system $P_AXN3() = 3\n";
  const auto under = [&](Plane plane) { return Resolved("  @m:1 : " + std::string(words), plane); };
  CHECK(under(Plane::kXY) == "axis X = 1; axis Y = 2; axis Z = 3\n");
  CHECK(under(Plane::kZX) == "axis Z = 1; axis X = 2; axis Y = 3\n");
  CHECK(under(Plane::kYZ) == "axis Y = 1; axis Z = 2; axis X = 3\n");
  CHECK(under(Plane::kUnknown).find("axis X") == std::string::npos);
}

TEST_CASE("a plane of the block before counts; values are taken before the block's own plane holds") {
  CHECK(Resolved("  @m:1 : plane zx\n"
                 "  @m:2 : axis-computed system $P_AXN1() = 1\n") ==
        "plane zx\n"
        "axis Z = 1\n");
  // Whether the control looks the axis up before or behind the plane word of the same block is not for us to guess.
  CHECK(Resolved("  @m:1 : plane zx; axis-computed system $P_AXN1() = 1\n") ==
        "plane zx; axis-computed system $P_AXN1() = 1\n");
  CHECK(Resolved("  @m:1 : plane xy; axis-computed system $P_AXN1() = 1\n") == "plane xy; axis X = 1\n");
}

TEST_CASE("where ways with different planes meet, and where a variable holds the axis, the word stays computed") {
  const std::string same =
      "jump forward label A = lt(R[1], 2)\n"
      "plane zx\n"
      "label A axis-computed system $P_AXN1() = 1\n"
      "axis-computed variable A = 1\n"
      "axis X = 5\n";
  CHECK(Resolved("  @m:1 : jump forward label A = lt(R[1], 2)\n"
                 "  @m:2 : plane zx\n"
                 "  @m:3 label A : axis-computed system $P_AXN1() = 1\n"
                 "  @m:4 : axis-computed variable A = 1\n"
                 "  @m:5 : axis X = 5\n") == same);
}

}  // namespace
}  // namespace ncport::ir::transform
