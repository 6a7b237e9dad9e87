#include "ir/transform/lower_expressions.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

constexpr std::string_view kHead = "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n";

std::string Lower(const std::string& blocks, double tolerance = 1e-12) {
  diag::Sink sink;
  return test::After(std::string(kHead) + blocks, sink, [&](Module& module, diag::Sink& findings) {
    LowerExpressionsConfig config;
    config.compare_tolerance = tolerance;
    config.for_counter_rounds = tolerance > 0;
    return LowerExpressions(module, ProgramId{std::size_t{0}}, config, findings);
  });
}

TEST_CASE("a comparison of computed fractions becomes a difference against a band (sinumerik-4.2)") {
  CHECK(Lower("  @m:1 : assign cell R[1] = add:real(0.1:real, 0.2:real)\n"
              "  @m:2 : jump forward number 9 = eq!tolerance:bool(cell:real R[1], 0.3:real)\n"
              "  @m:3 : jump forward number 9 = lt!tolerance:bool(cell:real R[1], 0.3:real)\n"
              "  @m:4 : jump forward number 9 = ge!tolerance:bool(cell:real R[1], cell:real R[2])\n"
              "  @m:9 N9 : program-end #30\n") ==
        "program M main\n"
        "assign cell R[1] = add:real(0.1:real, 0.2:real)\n"
        "jump forward number 9 = le:bool(call:real abs(sub:real(cell:real R[1], 0.3:real)), "
        "div:real(div:real(0.3:real, literal(1000000, computed):real), literal(1000000, computed):real))\n"
        "jump forward number 9 = gt:bool(sub:real(0.3:real, cell:real R[1]), "
        "div:real(div:real(0.3:real, literal(1000000, computed):real), literal(1000000, computed):real))\n"
        "jump forward number 9 = le:bool(sub:real(cell:real R[2], cell:real R[1]), "
        "div:real(div:real(call:real abs(cell:real R[2]), literal(1000000, computed):real), "
        "literal(1000000, computed):real))\n"
        "N9 program-end #30\n");
}

TEST_CASE("limits that may be swapped are an alarm before the value is bounded (sinumerik-4.3)") {
  const std::string open = Lower(
      "  @m:1 : assign cell R[1] = call bound(cell:real R[2], cell:real R[3], cell:real R[4])\n"
      "  @m:9 : program-end #30\n");
  CHECK(open.find("assign variable:real BOUNDED = call:real sqrt(sub:real(cell:real R[3], cell:real R[2]))\n"
                  "assign variable:real BOUNDED = cell:real R[4]\n") != std::string::npos);
  const std::string known = Lower(
      "  @m:1 : assign cell R[1] = call bound(1:int, 5:int, cell:real R[4])\n"
      "  @m:9 : program-end #30\n");
  CHECK(known.find("sqrt") == std::string::npos);
}

TEST_CASE("comparisons that cannot nearly hold stay plain") {
  // Counters, written numbers (R5 is what an operator writes), anything beside 0.
  const std::string all = Lower(
      "  @m:1 : assign cell:real R[1] = 0:int\n"
      "  @m:2 N2 : assign cell:real R[1] = add:real(cell:real R[1], 1:int)\n"
      "  @m:3 : assign cell:real R[3] = div:real(cell:real R[5], 3:int)\n"
      "  @m:4 : jump backward number 2 = lt!tolerance:bool(cell:real R[1], 360:int)\n"
      "  @m:5 : jump backward number 2 = eq!tolerance:bool(cell:real R[5], 2.5:real)\n"
      "  @m:6 : jump backward number 2 = gt!tolerance:bool(cell:real R[3], 0:int)\n"
      "  @m:9 : program-end #30\n");
  CHECK(all.find("lt:bool(cell:real R[1], 360:int)") != std::string::npos);
  CHECK(all.find("eq:bool(cell:real R[5], 2.5:real)") != std::string::npos);
  CHECK(all.find("gt:bool(cell:real R[3], 0:int)") != std::string::npos);
  CHECK(all.find("abs") == std::string::npos);
}

TEST_CASE("a cell is what its last assignment made it, on every way") {
  // R1 counts in the loop; behind the loop it holds a quotient.
  const std::string all = Lower(
      "  @m:1 : assign cell:real R[1] = 0:int\n"
      "  @m:2 N2 : assign cell:real R[1] = add:real(cell:real R[1], 1:int)\n"
      "  @m:4 : jump backward number 2 = lt!tolerance:bool(cell:real R[1], 360:int)\n"
      "  @m:5 : assign cell:real R[1] = div:real(cell:real R[5], 3:int)\n"
      "  @m:6 : jump forward number 9 = lt!tolerance:bool(cell:real R[1], 5:int)\n"
      "  @m:9 N9 : program-end #30\n");
  CHECK(all.find("lt:bool(cell:real R[1], 360:int)") != std::string::npos);
  CHECK(all.find("gt:bool(sub:int(5:int, cell:real R[1])") != std::string::npos);
}

TEST_CASE("a control that compares exactly gets no band") {
  const std::string all = Lower(
      "  @m:1 : assign cell:real R[1] = add:real(0.1:real, 0.2:real)\n"
      "  @m:2 : jump forward number 9 = eq!tolerance:bool(cell:real R[1], 0.3:real)\n"
      "  @m:9 N9 : program-end #30\n",
      0);
  CHECK(all.find("eq:bool(cell:real R[1], 0.3:real)") != std::string::npos);
}

TEST_CASE("a FOR loop starts at a whole number and ends within the band") {
  const std::string all = Lower(
      "  @m:1 : assign cell:real R[2] = mul:real(0.1:real, 30:int)\n"
      "  @m:2 link +1 : for cell:real R[1] to cell:real R[2] = cell:real R[5]\n"
      "  @m:3 link -1 : end-for\n"
      "  @m:9 : program-end #30\n");
  CHECK(all.find("for cell:real R[1] to add:real(cell:real R[2], div:real(div:real(call:real abs(cell:real R[2])") !=
        std::string::npos);
  CHECK(all.find("= call:real round(cell:real R[5])") != std::string::npos);
}

TEST_CASE("what a target can say stays as it is") {
  const std::string blocks =
      "assign cell:real R[1] = mul:real(cell:real R[2], 2:int)\n"
      "axis X = cell:real R[1]\n"
      "program-end #30\n";
  CHECK(Lower("  @m:1 : assign cell:real R[1] = mul:real(cell:real R[2], 2:int)\n"
              "  @m:2 : axis X = cell:real R[1]\n"
              "  @m:3 : program-end #30\n") == "program M main\n" + blocks);
}

}  // namespace
}  // namespace ncport::ir::transform
