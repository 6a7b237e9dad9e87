#include "ir/transform/split_statements.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Split(std::string_view blocks, test::Show show = test::Show::kPlain) {
  diag::Sink sink;
  const std::string text = test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nsystem $AC_MARKER user-memory real writable\n"
      "system $P_EP programmed-position real\nprogram M main @m:0\n  var A real local dims 5\n" +
          test::WithCells(blocks),
      sink,
      [](Module& module, diag::Sink&) {
        SplitStatements(module, ProgramId{0U});
        return true;
      },
      show);
  return test::Brief(text.substr(std::string_view("program M main\n").size()));
}

TEST_CASE("assignments from left to right, then the words together, then the call") {
  CHECK(Split("  @m:1 : assign R[1] = 1; motion linear; assign R[2] = R[1]; axis X = 5; call name SUB; feed = 100\n") ==
        "assign R[1] = 1\n"
        "assign R[2] = R[1]\n"
        "motion linear; axis X = 5; feed = 100\n"
        "call name SUB\n");
}

TEST_CASE("a word keeps the value that it had before a later assignment of its block") {
  CHECK(Split("  @m:1 : axis X = R[1]; assign R[1] = 7; axis Y = R[1]\n") ==
        "assign variable HELD = R[1]\n"
        "assign R[1] = 7\n"
        "axis X = variable HELD; axis Y = R[1]\n");
}

TEST_CASE("a place that an index reaches may be any: the value is held") {
  CHECK(Split("  @m:1 : axis X = R[1]; assign cell-at R[R[2]] = 7\n") ==
        "assign variable HELD = R[1]\n"
        "assign cell-at R[R[2]] = 7\n"
        "axis X = variable HELD\n");
  CHECK(Split("  @m:1 : axis X = cell-at R[R[3]]; assign R[2] = 7\n") ==
        "assign variable HELD = cell-at R[R[3]]\n"
        "assign R[2] = 7\n"
        "axis X = variable HELD\n");
}

TEST_CASE("other cells and earlier assignments hold nothing") {
  CHECK(Split("  @m:1 : assign R[1] = 7; axis X = R[1]; assign R[2] = 3\n") ==
        "assign R[1] = 7\n"
        "assign R[2] = 3\n"
        "axis X = R[1]\n");
}

TEST_CASE("a list of values changes an array that an earlier word of the block read") {
  CHECK(Split("  @m:1 : axis X = element A(0:int); assign-list place element A(0:int) (4, 5)\n") ==
        "assign variable HELD = element A(0)\n"
        "assign-list place element A(0) (4, 5)\n"
        "axis X = variable HELD\n");
}

TEST_CASE("memory of the control that an earlier word of the block read is held too") {
  CHECK(Split("  @m:1 : axis X = system $AC_MARKER(1:int); assign system $AC_MARKER(1:int) = 7\n") ==
        "assign variable HELD = system $AC_MARKER(1)\n"
        "assign system $AC_MARKER(1) = 7\n"
        "axis X = variable HELD\n");
  // What is only read never changes by an assignment.
  CHECK(Split("  @m:1 : axis X = system $P_EP(axis-name X); assign system $AC_MARKER(1:int) = 7\n") ==
        "assign system $AC_MARKER(1) = 7\n"
        "axis X = system $P_EP(axis-name X)\n");
}

TEST_CASE("a return or a program end of the block comes behind its calls, as its phase says") {
  CHECK(Split("  @m:1 : axis X = 5; call name SUB; return plain\n") ==
        "axis X = 5\n"
        "call name SUB\n"
        "return plain\n");
  CHECK(Split("  @m:1 : program-end #30; call name SUB\n") ==
        "call name SUB\n"
        "program-end #30\n");
  // Without flow they stay with the other words.
  CHECK(Split("  @m:1 : assign R[1] = 5; axis X = 5; return plain\n") ==
        "assign R[1] = 5\n"
        "axis X = 5; return plain\n");
}

TEST_CASE("messages, alarms and stops of the preprocessor are statements in the order of the text") {
  CHECK(Split("  @m:1 : axis X = 5; message = \"A\"; assign R[1] = 2; alarm stops = 61000; preprocess-stop\n") ==
        "message = \"A\"\n"
        "assign R[1] = 2\n"
        "alarm stops = 61000\n"
        "preprocess-stop\n"
        "axis X = 5\n");
}

TEST_CASE("label, number and comments stand on the first statement, skip levels and flags on all") {
  CHECK(Split("  @m:1 skip 2 N10 label A skip-digit added : assign R[1] = 1; axis X = 5; jump forward label A\n"
              "    ; end-of-block \"note\"\n",
              test::Show::kMarks) ==
        "skip 2 skip-digit added label A N10 assign R[1] = 1\n"
        "    ; end-of-block \"note\"\n"
        "skip 2 skip-digit added axis X = 5\n"
        "skip 2 skip-digit added jump forward label A\n");
}

TEST_CASE("single statements, structure marks and conditional blocks stay as they are") {
  const std::string same =
      "axis X = 5; feed = 100\n"
      "assign R[1] = 1\n"
      "if = lt(R[1], 2)\n"
      "call name SUB\n"
      "end-if\n"
      "when = lt(R[1], 2); assign R[1] = 1; assign R[2] = 1\n"
      "assign R[3] = 1; skip-rest 1; assign R[1] = 1\n"
      "N20 -\n";
  CHECK(Split("  @m:1 : axis X = 5; feed = 100\n"
              "  @m:2 : assign R[1] = 1\n"
              "  @m:3 link +2 : if = lt(R[1], 2)\n"
              "  @m:4 : call name SUB\n"
              "  @m:5 link -2 : end-if\n"
              "  @m:6 : when = lt(R[1], 2); assign R[1] = 1; assign R[2] = 1\n"
              "  @m:7 : assign R[3] = 1; skip-rest 1; assign R[1] = 1\n"
              "  @m:8 N20\n") == same);
}

}  // namespace
}  // namespace ncport::ir::transform
