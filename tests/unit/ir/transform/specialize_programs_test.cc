#include "ir/transform/specialize_programs.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

/// A main program with these blocks, and a cycle that dwells if it is told to.
std::string Specialized(const std::string& blocks) {
  diag::Sink sink;
  const std::string text =
      "ncport-ir 1\n"
      "file m\n"
      "space R 0..99 real kept all zero\n"
      "program M main @m:0\n" +
      blocks +
      "program CYC sub @m:10 header library\n"
      "  param DEPTH real parameter\n"
      "  param DWELLT real parameter\n"
      "  var NEARZ real local\n"
      "  @m:10 : header CYC\n"
      "  @m:11 : define NEARZ\n"
      "  @m:12 : assign variable:real NEARZ = 2:int\n"
      "  @m:13 : if = lt:bool(variable:real DEPTH, 0:int)\n"
      "  @m:14 : assign variable:real NEARZ = -2:int\n"
      "  @m:15 : end-if\n"
      "  @m:16 : axis Z absolute = variable:real NEARZ\n"
      "  @m:17 : axis Z absolute = variable:real DEPTH\n"
      "  @m:18 : if = gt:bool(variable:real DWELLT, 0:int)\n"
      "  @m:19 : dwell-seconds = variable:real DWELLT\n"
      "  @m:20 : end-if\n"
      "  @m:21 : return plain\n";
  return test::After(text, sink, [](Module& module, diag::Sink&) {
    SpecializePrograms(module, Machine{}, {});
    return true;
  });
}

TEST_CASE("what constant arguments decide is gone, and so are they") {
  CHECK(Specialized("  @m:1 : call name CYC calls CYC (0: 5:int)\n  @m:2 : program-end #30\n") ==
        "program M main\n"
        "call name CYC calls CYC\n"
        "program-end #30\n"
        "program CYC sub\n"
        "-\n"
        "axis Z absolute = literal(2, computed):real\n"
        "axis Z absolute = literal(5, computed):real\n"
        "return plain\n");
}

TEST_CASE("equal calls share one text, others have their own; an argument that is no constant stays") {
  const std::string text = Specialized(
      "  @m:1 : call name CYC calls CYC (0: 5:int)\n"
      "  @m:2 : call name CYC calls CYC (0: 5:int, 1: 0:int)\n"
      "  @m:3 : call name CYC calls CYC (0: cell:real R[1], 1: 3:int)\n"
      "  @m:4 : program-end #30\n");
  CHECK(text.find("call name CYC calls CYC\ncall name CYC calls CYC\ncall name CYC_2") != std::string::npos);
  CHECK(text.find("program CYC_2 sub") != std::string::npos);
  CHECK(text.find("(0: cell:real R[1])") != std::string::npos);
  CHECK(text.find("dwell-seconds = literal(3, computed):real") != std::string::npos);
  CHECK(text.find("lt:bool(variable:real DEPTH, 0:int)") != std::string::npos);
}

}  // namespace
}  // namespace ncport::ir::transform
