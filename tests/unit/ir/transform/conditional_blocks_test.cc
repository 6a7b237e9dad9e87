#include "ir/transform/conditional_blocks.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Split(std::string_view blocks, test::Show show = test::Show::kPlain) {
  diag::Sink sink;
  const std::string text = test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n" + test::WithCells(blocks), sink,
      [](Module& module, diag::Sink&) {
        ConditionalBlocks(module, ProgramId{0U}, "U_C");
        return true;
      },
      show);
  return test::Brief(text.substr(std::string_view("program M main\n").size()));
}

TEST_CASE("the rest of a block under a condition stands between IF and ENDIF") {
  CHECK(Split("  @m:1 : assign R[3] = 1; when = lt(R[1], 2); assign R[1] = 1; axis X = 5\n") ==
        "assign R[3] = 1\n"
        "if = lt(R[1], 2)\n"
        "assign R[1] = 1; axis X = 5\n"
        "end-if\n");
}

TEST_CASE("a plain jump takes the condition itself") {
  CHECK(Split("  @m:1 label A : when = lt(R[1], 2); jump backward label A\n") ==
        "label A jump backward label A = lt(R[1], 2)\n");
}

TEST_CASE("a jump that has a condition already keeps it inside the other one") {
  CHECK(Split("  @m:1 label A : axis X = 1\n"
              "  @m:2 : when = lt(R[1], 2); jump backward label A = gt(R[2], 3)\n") ==
        "label A axis X = 1\n"
        "if = lt(R[1], 2)\n"
        "jump backward label A = gt(R[2], 3)\n"
        "end-if\n");
}

TEST_CASE("a label and a number stand in front of the mark, with the comments") {
  CHECK(Split("  @m:1 N10 label A : when = lt(R[1], 2); axis X = 5\n"
              "    ; end-of-block \"note\"\n",
              test::Show::kMarks) ==
        "label A N10 -\n"
        "if = lt(R[1], 2)\n"
        "    ; end-of-block \"note\"\n"
        "axis X = 5\n"
        "end-if\n");
}

TEST_CASE("a block with a skip level jumps over its rest: no mark is skipped alone") {
  CHECK(Split("  @m:1 skip 1 N10 : when = lt(R[1], 2); axis X = 5\n", test::Show::kMarks) ==
        "skip 1 N10 jump forward label U_C1 = not(group(lt(R[1], 2)))\n"
        "skip 1 axis X = 5\n"
        "label U_C1 -\n");
}

TEST_CASE("labels made stand nowhere else in the program") {
  CHECK(Split("  @m:1 skip 1 : when = lt(R[1], 2); axis X = 5\n"
              "  @m:2 skip 1 : when = lt(R[1], 2); axis X = 6\n"
              "  @m:3 label U_C2 : axis X = 7\n") ==
        "jump forward label U_C1 = not(group(lt(R[1], 2)))\n"
        "axis X = 5\n"
        "label U_C1 -\n"
        "jump forward label U_C3 = not(group(lt(R[1], 2)))\n"
        "axis X = 6\n"
        "label U_C3 -\n"
        "label U_C2 axis X = 7\n");
  // Labels compare without regard to case.
  CHECK(Split("  @m:1 skip 1 : when = lt(R[1], 2); axis X = 5\n"
              "  @m:2 label u_c1 : axis X = 7\n") ==
        "jump forward label U_C2 = not(group(lt(R[1], 2)))\n"
        "axis X = 5\n"
        "label U_C2 -\n"
        "label u_c1 axis X = 7\n");
}

TEST_CASE("a block that holds a finding stays whole; main blocks stay main blocks") {
  CHECK(Split("  @m:1 refused : when = lt(R[1], 2); axis X = 5\n", test::Show::kMarks) ==
        "refused when = lt(R[1], 2); axis X = 5\n");
  CHECK(Split("  @m:1 N10 main-block : assign R[1] = 1; when = lt(R[1], 2); axis X = 5\n", test::Show::kMarks) ==
        "main-block N10 assign R[1] = 1\n"
        "if = lt(R[1], 2)\n"
        "axis X = 5\n"
        "end-if\n");
}

TEST_CASE("the second condition of a block stays inside the first") {
  CHECK(Split("  @m:1 : when = lt(R[1], 2); when = lt(R[2], 2); axis X = 5\n") ==
        "if = lt(R[1], 2)\n"
        "when = lt(R[2], 2); axis X = 5\n"
        "end-if\n");
}

TEST_CASE("blocks without a condition stay as they are") {
  CHECK(Split("  @m:1 N10 label A : axis X = 5\n"
              "  @m:2 skip 1 : jump backward label A = lt(R[1], 2)\n") ==
        "label A N10 axis X = 5\n"
        "jump backward label A = lt(R[1], 2)\n");
}

}  // namespace
}  // namespace ncport::ir::transform
