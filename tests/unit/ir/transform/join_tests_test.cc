#include "ir/transform/join_tests.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Joined(const std::string& blocks) {
  diag::Sink sink;
  return test::After("ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n" + blocks, sink,
                     [](Module& module, diag::Sink&) {
                       for (const ProgramId program : module.programs.Ids()) JoinTests(module, program);
                       return true;
                     });
}

TEST_CASE("a branch that only jumps is a jump with a condition") {
  CHECK(Joined("  @m:1 label START : if = eq:bool(cell:real R[1], 2:int)\n"
               "  @m:2 : jump forward label OUT\n"
               "  @m:3 : end-if\n"
               "  @m:4 label OUT : program-end #30\n") ==
        "program M main\n"
        "label START jump forward label OUT = eq:bool(cell:real R[1], 2:int)\n"
        "label OUT program-end #30\n");
}

TEST_CASE("a branch with more than the jump, with ELSE or with a jump that is a target stays") {
  const std::string more =
      "  @m:1 : if = eq:bool(cell:real R[1], 2:int)\n"
      "  @m:2 : assign cell:real R[1] = 3:int\n"
      "  @m:3 : jump forward label OUT\n"
      "  @m:4 : end-if\n"
      "  @m:5 label OUT : program-end #30\n";
  CHECK(Joined(more).find("end-if") != std::string::npos);
  const std::string other =
      "  @m:1 : if = eq:bool(cell:real R[1], 2:int)\n"
      "  @m:2 : jump forward label OUT\n"
      "  @m:3 : else\n"
      "  @m:4 : assign cell:real R[1] = 3:int\n"
      "  @m:5 : end-if\n"
      "  @m:6 label OUT : program-end #30\n";
  CHECK(Joined(other).find("end-if") != std::string::npos);
  const std::string target =
      "  @m:1 : if = eq:bool(cell:real R[1], 2:int)\n"
      "  @m:2 label HERE : jump forward label OUT\n"
      "  @m:3 : end-if\n"
      "  @m:4 label OUT : program-end #30\n";
  CHECK(Joined(target).find("end-if") != std::string::npos);
}

}  // namespace
}  // namespace ncport::ir::transform
