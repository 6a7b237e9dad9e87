#include "ir/transform/part_ends.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

constexpr std::string_view kHead = "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n";

std::string Marked(std::string_view blocks, bool ignore_case = true) {
  diag::Sink sink;
  const std::string text =
      test::After(std::string(kHead) + test::WithCells(blocks), sink, [&](Module& module, diag::Sink&) {
        MarkPartEnds(module, ProgramId{0U}, ignore_case);
        return true;
      });
  return test::Brief(text.substr(std::string_view("program M main\n").size()));
}

TEST_CASE("a part of one block ends at an empty block with a label of its own (REPEATB)") {
  CHECK(Marked("  @m:1 label A : axis X = 1\n"
               "  @m:2 : axis Y = 1\n"
               "  @m:3 : repeat-part first label A single = 3\n") ==
        "label A axis X = 1\n"
        "label PART_END_1 -\n"
        "axis Y = 1\n"
        "repeat-part first label A last label PART_END_1 = 3\n");
}

TEST_CASE("a part from label to label ends behind the block of the second one") {
  CHECK(Marked("  @m:1 label A : axis X = 1\n"
               "  @m:2 label B : axis Y = 1\n"
               "  @m:3 : axis Z = 1\n"
               "  @m:4 : repeat-part first label A last label B = 3\n") ==
        "label A axis X = 1\n"
        "label B axis Y = 1\n"
        "label PART_END_1 -\n"
        "axis Z = 1\n"
        "repeat-part first label A last label PART_END_1 = 3\n");
}

TEST_CASE("an end label ends a part that has it before its repeat word, and only then") {
  CHECK(Marked("  @m:1 label A : axis X = 1\n"
               "  @m:2 label ENDLABEL : axis Y = 1\n"
               "  @m:3 : axis Z = 1\n"
               "  @m:4 : repeat-part first label A or-end label ENDLABEL\n") ==
        "label A axis X = 1\n"
        "label ENDLABEL axis Y = 1\n"
        "label PART_END_1 -\n"
        "axis Z = 1\n"
        "repeat-part first label A last label PART_END_1\n");
  const std::string same =
      "label A axis X = 1\n"
      "axis Z = 1\n"
      "repeat-part first label A or-end label ENDLABEL\n"
      "label ENDLABEL axis Y = 1\n";
  CHECK(Marked("  @m:1 label A : axis X = 1\n"
               "  @m:2 : axis Z = 1\n"
               "  @m:3 : repeat-part first label A or-end label ENDLABEL\n"
               "  @m:4 label ENDLABEL : axis Y = 1\n") == same);
}

TEST_CASE("parts that lie behind their repeat word are marked alike") {
  CHECK(Marked("  @m:1 : repeat-part first label A last label B\n"
               "  @m:2 label A : axis X = 1\n"
               "  @m:3 label B : axis Y = 1\n") ==
        "repeat-part first label A last label PART_END_1\n"
        "label A axis X = 1\n"
        "label B axis Y = 1\n"
        "label PART_END_1 -\n");
}

TEST_CASE("of two parts with one end the inner one ends first") {
  CHECK(Marked("  @m:1 label A : axis X = 1\n"
               "  @m:2 label B : axis Y = 1\n"
               "  @m:3 : axis Z = 1\n"
               "  @m:4 : repeat-part first label A last label B\n"
               "  @m:5 : repeat-part first label B single\n") ==
        "label A axis X = 1\n"
        "label B axis Y = 1\n"
        "label PART_END_1 -\n"
        "label PART_END_2 -\n"
        "axis Z = 1\n"
        "repeat-part first label A last label PART_END_2\n"
        "repeat-part first label B last label PART_END_1\n");
}

TEST_CASE("labels made stand once, in every case of their letters") {
  for (const bool ignore_case : {true, false}) {
    CAPTURE(ignore_case);
    CHECK(Marked("  @m:1 label A : axis X = 1\n"
                 "  @m:2 label Part_End_1 : axis Y = 1\n"
                 "  @m:3 label PART_END_2 : axis Y = 1\n"
                 "  @m:4 : repeat-part first label A single\n",
                 ignore_case)
              .find("last label PART_END_3") != std::string::npos);
  }
}

TEST_CASE("parts that end right before their repeat word, or whose labels are missing, stay as they are") {
  const std::string same =
      "label A axis X = 1\n"
      "axis Z = 1\n"
      "repeat-part first label A = 2\n"
      "repeat-part first label NOWHERE single\n"
      "repeat-part first label A last label NOWHERE\n";
  CHECK(Marked("  @m:1 label A : axis X = 1\n"
               "  @m:2 : axis Z = 1\n"
               "  @m:3 : repeat-part first label A = 2\n"
               "  @m:4 : repeat-part first label NOWHERE single\n"
               "  @m:5 : repeat-part first label A last label NOWHERE\n") == same);
}

/// Of the blocks `first` to `last`, counted from 0.
bool Leaves(std::string_view blocks, std::size_t first, std::size_t last) {
  diag::Sink sink;
  Result<Module> module = ParseDump(std::string(kHead) + test::WithCells(blocks), sink);
  REQUIRE(module.Ok());
  const analysis::LabelTable labels(module.Value(), ProgramId{0U});
  const IdRange<BlockId> range = module.Value().programs[ProgramId{0U}].blocks;
  return !LeavesAtEndOnly(module.Value(), labels, {BlockId{range.begin + first}, BlockId{range.begin + last}});
}

TEST_CASE("a jump, a branch of a switch or a restart leads out of a part; a return ends the program") {
  const auto part = [](std::string_view middle) {
    return "  @m:1 label A : axis X = 1\n  @m:2 : " + std::string(middle) +
           "\n  @m:3 label B : axis Y = 1\n  @m:4 label OUT : axis Z = 1\n";
  };
  CHECK_FALSE(Leaves(part("axis X = 2"), 0, 2));
  CHECK_FALSE(Leaves(part("jump forward label B"), 0, 2));
  CHECK_FALSE(Leaves(part("jump backward label A"), 0, 2));
  CHECK(Leaves(part("jump forward label OUT = lt(R[1], 2)"), 0, 2));
  CHECK(Leaves(part("jump backward program-start"), 0, 2));
  CHECK(Leaves(part("switch (1 => forward label B, - => forward label OUT) = R[1]"), 0, 2));
  CHECK_FALSE(Leaves(part("switch (1 => forward label B, - => backward label A) = R[1]"), 0, 2));
  CHECK(Leaves(part("restart"), 0, 2));
  CHECK_FALSE(Leaves(part("return plain"), 0, 2));
  CHECK_FALSE(Leaves(part("call name SUB"), 0, 2));
}

TEST_CASE("a jump that finds nothing leads out only if that ends in no alarm and no other place is meant") {
  const auto part = [](std::string_view middle) {
    return "  @m:1 label A : axis X = 1\n  @m:2 : " + std::string(middle) + "\n  @m:3 label OUT : axis Z = 1\n";
  };
  CHECK(Leaves(part("jump forward label NOWHERE"), 0, 1));
  CHECK_FALSE(Leaves(part("jump forward label NOWHERE quiet"), 0, 1));  // goes on with the next block
  CHECK(Leaves(part("jump forward expression R[1]"), 0, 1));
  CHECK(Leaves(part("jump forward expression R[1] quiet"), 0, 1));  // may find OUT
}

TEST_CASE("a part that cuts a structure is left in its middle") {
  const std::string blocks =
      "  @m:1 label A : axis X = 1\n"
      "  @m:2 link +2 : if = lt(R[1], 2)\n"
      "  @m:3 : axis Y = 1\n"
      "  @m:4 link -2 : end-if\n"
      "  @m:5 : axis Z = 1\n";
  CHECK_FALSE(Leaves(blocks, 0, 3));
  CHECK(Leaves(blocks, 0, 2));
  CHECK(Leaves(blocks, 2, 4));
  CHECK_FALSE(Leaves(blocks, 2, 2));
}

}  // namespace
}  // namespace ncport::ir::transform
