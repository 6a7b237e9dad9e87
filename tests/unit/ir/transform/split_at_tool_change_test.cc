#include "ir/transform/split_at_tool_change.h"

#include "ir/transform/linear_form.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

constexpr std::string_view kMain =
    "program M main @m:0\n"
    "  @m:1 : call name SUB calls SUB (0: 5)\n"
    "  @m:2 : program-end #30\n";

struct Split {
  std::string text;
  std::string findings;  // codes
  std::string messages;
  std::vector<std::vector<std::string>> parts;
  bool ok = false;
};

Split Run(std::string_view programs, test::Show show = test::Show::kPlain) {
  Split split;
  diag::Sink sink;
  const std::string text = test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nvar G real global\n" + test::WithCells(programs), sink,
      [&](Module& module, diag::Sink& findings) {
        const SplitResult result = SplitAtToolChange(module, findings);
        split.ok = result.ok;
        for (const SplitProgram& program : result.programs) {
          split.parts.emplace_back();
          for (const ProgramId part : program.parts)
            split.parts.back().emplace_back(module.View(module.programs[part].name));
          CHECK(program.parts.front() == program.whole);
        }
        return result.ok;
      },
      show);
  split.text = test::Brief(text);
  split.findings = test::CodesOf(sink);
  for (const diag::Diagnostic& finding : sink.All()) split.messages += finding.message + "\n";
  CHECK(split.ok == sink.Empty());
  return split;
}

/// SUB with a parameter A and a local L, called once from M.
Split OfSub(std::string_view blocks, std::string_view main = kMain) {
  return Run(std::string(main) +
             "program SUB sub @m:10\n  param A real parameter\n  var L real local\n  var V real local dims 3\n  var L2 "
             "real local "
             "initial R[1]\n  var L3 real local initial variable A\n" +
             std::string(blocks));
}

void Refused(std::string_view blocks, std::string_view why, std::string_view main = kMain) {
  CAPTURE(blocks);
  const Split split = OfSub(blocks, main);
  CHECK_FALSE(split.ok);
  CHECK(split.findings == "NC6001");
  CHECK_MESSAGE(split.messages.find(why) != std::string::npos, split.messages);
}

void Splits(std::string_view blocks) {
  CAPTURE(blocks);
  const Split split = OfSub(blocks);
  CHECK_MESSAGE(split.ok, split.messages);
  CHECK(split.parts.size() == 1);
}

TEST_CASE("the caller calls the part before, changes the tool, and calls the part behind with the same arguments") {
  const Split split = OfSub(
      "  @m:11 : axis X = variable A\n"
      "  @m:12 : tool = 2; tool-change\n"
      "  @m:13 : axis X = add(variable A, 1)\n"
      "  @m:14 : return plain\n");
  CHECK(split.text ==
        "program M main\n"
        "call name SUB calls SUB (0: 5)\n"
        "tool = 2; tool-change\n"
        "call name SUB_2 calls SUB_2 (0: 5)\n"
        "program-end #30\n"
        "program SUB sub\n"
        "axis X = variable A\n"
        "return plain\n"
        "program SUB_2 sub\n"
        "axis X = add(variable A, 1)\n"
        "return plain\n");
  CHECK(split.parts == std::vector<std::vector<std::string>>{{"SUB", "SUB_2"}});
}

TEST_CASE("several tool changes make several parts, in their order, behind every call") {
  const Split split =
      Run("program M main @m:0\n"
          "  @m:1 : call name SUB calls SUB\n"
          "  @m:2 : call name SUB calls SUB\n"
          "program SUB sub @m:10\n"
          "  @m:11 : axis X = 1\n"
          "  @m:12 : tool = 2\n"
          "  @m:13 : axis X = 2\n"
          "  @m:14 : tool = 3\n"
          "  @m:15 : axis X = 3\n"
          "  @m:16 : return plain\n");
  REQUIRE(split.parts.size() == 1);
  REQUIRE(split.parts[0].size() == 3);
  CHECK(split.parts[0][0] == "SUB");
  const std::string once = "call name SUB calls SUB\ntool = 2\ncall name " + split.parts[0][1] + " calls " +
                           split.parts[0][1] + "\ntool = 3\ncall name " + split.parts[0][2] + " calls " +
                           split.parts[0][2] + "\n";
  CHECK(split.text == "program M main\n" + once + once + "program SUB sub\naxis X = 1\nreturn plain\nprogram " +
                          split.parts[0][1] + " sub\naxis X = 2\nreturn plain\nprogram " + split.parts[0][2] +
                          " sub\naxis X = 3\nreturn plain\n");
}

TEST_CASE("main programs, and programs without tools, stay as they are") {
  const Split split =
      Run("program M main @m:0\n  @m:1 : tool = 2\n  @m:2 : call name SUB calls SUB\n"
          "program SUB sub @m:10\n  @m:11 : axis X = 1\n  @m:12 : edge = 2\n");
  CHECK(split.ok);
  CHECK(split.parts.empty());
  CHECK(split.text == "program M main\ntool = 2\ncall name SUB calls SUB\nprogram SUB sub\naxis X = 1\nedge = 2\n");
}

TEST_CASE("a call that may be skipped is skipped whole, with its tool change") {
  const Split split =
      Run("program M main @m:0\n"
          "  @m:1 skip 1 : call name SUB calls SUB\n"
          "program SUB sub @m:10\n"
          "  @m:11 : axis X = 1\n"
          "  @m:12 : tool = 2\n"
          "  @m:13 : return plain\n",
          test::Show::kMarks);
  CHECK(split.text ==
        "program M main\n"
        "skip 1 call name SUB calls SUB\n"
        "skip 1 tool = 2\n"
        "skip 1 call name SUB_2 calls SUB_2\n"
        "program SUB sub\n"
        "axis X = 1\n"
        "return plain\n"
        "program SUB_2 sub\n"
        "return plain\n");
}

TEST_CASE("a jump to the tool change ends the first part") {
  const Split split = OfSub(
      "  @m:11 : jump forward label T = lt(variable A, 3)\n"
      "  @m:12 : axis X = 1\n"
      "  @m:13 label T : tool = 2\n"
      "  @m:14 : return plain\n");
  CHECK(split.ok);
  CHECK(split.text.find("jump forward label T = lt(variable A, 3)\naxis X = 1\nlabel T return plain\n") !=
        std::string::npos);
}

TEST_CASE("a tool change that is not on the straight path is refused") {
  Refused(
      "  @m:11 link +2 : if = lt(variable A, 3)\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 link -2 : end-if\n",
      "inside a loop, a branch");
  Refused(
      "  @m:11 link +2 : while = lt(R[1], 3)\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 link -2 : end-while\n",
      "inside a loop, a branch");
  Refused("  @m:11 skip 1 : tool = 2\n", "may be skipped");
  Refused(
      "  @m:11 : jump forward label OUT = lt(variable A, 3)\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 label OUT : return plain\n",
      "a jump leads over");
  Refused(
      "  @m:11 label A : axis X = 1\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 : jump backward label A = lt(R[1], 3)\n",
      "a jump leads over");
  Refused(
      "  @m:11 : jump forward expression R[1]\n"
      "  @m:12 : tool = 2\n",
      "a jump leads over");
  Refused(
      "  @m:11 : switch (1 => forward label OUT) = R[1]\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 label OUT : return plain\n",
      "a jump leads over");
  Refused(
      "  @m:11 label A : axis X = 1\n"
      "  @m:12 : repeat-part first label A = 2\n"
      "  @m:13 : tool = 2\n",
      "repeated parts");
}

TEST_CASE("a jump from behind to the tool change would change the tool again: refused") {
  Refused(
      "  @m:11 : axis X = 1\n"
      "  @m:12 label T : tool = 2\n"
      "  @m:13 : jump backward label T = lt(R[1], 3)\n",
      "a jump leads over");
}

TEST_CASE("a program that may end before the tool change would go on with it: refused") {
  Refused(
      "  @m:11 link +2 : if = lt(variable A, 3)\n"
      "  @m:12 : return plain\n"
      "  @m:13 link -2 : end-if\n"
      "  @m:14 : tool = 2\n",
      "before");
  Refused(
      "  @m:11 skip 1 : program-end #30\n"
      "  @m:12 : tool = 2\n",
      "before");
}

TEST_CASE("what one part sets and another reads does not cross the cut") {
  const std::string_view why = "between the block that sets";
  Refused("  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n  @m:13 : axis X = variable L\n", why);
  Refused("  @m:11 : assign variable A = 3\n  @m:12 : tool = 2\n  @m:13 : axis X = variable A\n", why);
  Refused("  @m:11 : assign element V(0:int) = 3\n  @m:12 : tool = 2\n  @m:13 : axis X = element V(0:int)\n", why);
  Refused(
      "  @m:11 : assign-list place element V(0:int) (1, 2)\n  @m:12 : tool = 2\n"
      "  @m:13 : axis X = element V(0:int)\n",
      why);
  // Read on the way to a place, in a list, in a condition, as an argument, in the tool words.
  Refused("  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n  @m:13 : assign cell-at R[variable L] = 1\n", why);
  Refused(
      "  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n"
      "  @m:13 : assign-list place element V(0:int) (1, variable L)\n",
      why);
  Refused(
      "  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n"
      "  @m:13 link +1 : if = lt(variable L, 2)\n  @m:14 link -1 : end-if\n",
      why);
  Refused("  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n  @m:13 : call name OTHER (0: variable L)\n", why);
  Refused("  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n  @m:13 : modal-call name OTHER (0: variable L)\n",
          why);
  Refused("  @m:11 : assign variable L = 3\n  @m:12 : tool = 2\n  @m:13 : message = call to-text(variable L)\n", why);
}

TEST_CASE("a variable that the second part sets on some ways only is read as the first part left it") {
  Refused(
      "  @m:11 : assign variable L = 3\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 link +2 : if = lt(R[1], 3)\n"
      "  @m:14 : assign variable L = 4\n"
      "  @m:15 link -2 : end-if\n"
      "  @m:16 : axis X = variable L\n",
      "between the block that sets L");
  Refused(
      "  @m:11 : assign variable L = 3\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 : jump forward label OVER = lt(R[1], 3)\n"
      "  @m:14 : assign variable L = 4\n"
      "  @m:15 label OVER : axis X = variable L\n",
      "between the block that sets L");
  Refused(
      "  @m:11 : assign variable L = 3\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 skip 1 : assign variable L = 4\n"
      "  @m:14 : axis X = variable L\n",
      "between the block that sets L");
}

TEST_CASE("a variable that a called program sets by reference crosses the cut as well") {
  const Split split = Run(std::string(kMain) +
                          "program SUB sub @m:10\n  param A real parameter\n  var L real local\n"
                          "  @m:11 : call name SET calls SET (0: variable L)\n"
                          "  @m:12 : tool = 2\n"
                          "  @m:13 : axis X = variable L\n"
                          "program SET sub @m:20\n  param P real parameter ref\n"
                          "  @m:21 : assign variable P = 3\n");
  CHECK(split.findings == "NC6001");
}

TEST_CASE("variables that the second part sets itself before it reads them cross nothing") {
  Splits(
      "  @m:11 : assign variable L = 3\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 : assign variable L = 4\n"
      "  @m:14 : axis X = variable L\n");
  Splits(
      "  @m:11 : axis X = variable L\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 : axis X = variable L\n");
  Splits(
      "  @m:11 : assign R[1] = 3\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 : axis X = R[1]\n");
}

TEST_CASE("each part has parameters and locals of its own") {
  diag::Sink sink;
  Result<Module> module = ParseDump(
      "ncport-ir 1\nfile m\nprogram M main @m:0\n  @m:1 : call name SUB calls SUB (0: 5)\n"
      "program SUB sub @m:10\n  param A real parameter initial 2:real\n  var L real local\n"
      "  @m:11 : axis X = variable A\n  @m:12 : tool = 2\n  @m:13 : axis X = add(variable A, variable L)\n",
      sink);
  REQUIRE(module.Ok());
  REQUIRE(SplitAtToolChange(module.Value(), sink).ok);
  const Module& made = module.Value();
  REQUIRE(made.programs.Size() == 3);
  const ProgramId part{2U};
  REQUIRE(made.programs[part].parameters.count == 1);
  const VariableId parameter = made.programs[part].parameters[0];
  CHECK(made.variables[parameter].owner == part);
  CHECK(made.variables[parameter].scope == Scope::kParameter);
  CHECK(made.variables[parameter].initial.Valid());
  for (const BlockId id : made.programs[part].blocks) {
    for (const WordId word : made.blocks[id].words) {
      if (made.words[word].op != WordOp::kAxis) continue;
      VisitReads(made, made.words[word].value, [&](ExprId read) {
        CHECK(made.variables[VariableId{std::size_t{made.exprs[read].a}}].owner == part);
      });
    }
  }
}

TEST_CASE("arguments that may differ when they are passed again are refused") {
  const auto with = [](std::string_view argument) {
    return "program M main @m:0\n  var W real local\n  @m:1 : call name SUB calls SUB (0: " + std::string(argument) +
           ")\n  @m:2 : program-end #30\n";
  };
  const std::string_view sub = "  @m:11 : assign R[1] = 3\n  @m:12 : tool = 2\n  @m:13 : axis X = variable A\n";
  Refused(sub, "whose arguments may change", with("R[1]"));
  Refused(sub, "whose arguments may change", with("variable G"));
  const Split split = OfSub(sub, with("variable W"));
  CHECK(split.ok);
}

TEST_CASE("passes and modal calls have no place for the tool words: refused") {
  const std::string_view sub = "  @m:11 : axis X = 1\n  @m:12 : tool = 2\n  @m:13 : axis X = 2\n";
  Refused(sub, "number of passes",
          "program M main @m:0\n  @m:1 : call name SUB calls SUB passes 3\n  @m:2 : program-end #30\n");
  Refused(sub, "called modally",
          "program M main @m:0\n  @m:1 : modal-call name SUB calls SUB\n  @m:2 : program-end #30\n");
}

TEST_CASE("a program that nothing calls has no place for its tool words: refused") {
  const Split split = Run("program SUB sub @m:10\n  @m:11 : axis X = 1\n  @m:12 : tool = 2\n  @m:13 : axis X = 2\n");
  CHECK(split.findings == "NC6001");
  CHECK(split.messages.find("nothing here calls") != std::string::npos);
}

TEST_CASE("tool words that read the program's own variables mean nothing in its caller: refused") {
  Refused("  @m:11 : axis X = 1\n  @m:12 : tool = variable A\n  @m:13 : axis X = 2\n", "tool");
}

TEST_CASE("locals start in the second part as their definitions say") {
  const Split split = Run(std::string(kMain) +
                          "program SUB sub @m:10\n  param A real parameter\n  var L real local initial variable A\n"
                          "  var K real local definition 1 initial 7:real\n  var I real local\n"
                          "  @m:11 : define L; define K\n"
                          "  @m:12 : define I\n"
                          "  @m:13 : axis X = variable L\n"
                          "  @m:14 : tool = 2\n"
                          "  @m:15 : assign variable I = 1\n"
                          "  @m:16 : axis X = add(variable L, variable I)\n");
  CHECK_MESSAGE(split.ok, split.messages);
  CHECK(split.text.substr(split.text.find("program SUB_2")) ==
        "program SUB_2 sub\n"
        "define L\n"
        "assign variable I = 1\n"
        "axis X = add(variable L, variable I)\n");
  // A start value that the first part may have changed.
  Refused(
      "  @m:11 : define L2\n"
      "  @m:12 : tool = 2\n"
      "  @m:13 : axis X = variable L2\n",
      "between the block that sets L2");
  Refused(
      "  @m:11 : assign variable A = 2\n"
      "  @m:12 : define L3\n"
      "  @m:13 : tool = 2\n"
      "  @m:14 : axis X = variable L3\n",
      "between the block that sets L3");
}

TEST_CASE("an argument by reference may be read again by value: refused") {
  const Split split =
      Run("program M main @m:0\n  var W real local\n  @m:1 : call name SUB calls SUB (0: variable W, 1: variable W)\n"
          "program SUB sub @m:10\n  param A real parameter\n  param B real parameter ref\n"
          "  @m:11 : assign variable B = 3\n  @m:12 : tool = 2\n  @m:13 : axis X = variable A\n");
  CHECK(split.findings == "NC6001");
  CHECK(split.messages.find("whose arguments may change") != std::string::npos);
}

TEST_CASE("a reference that the second part reads crosses the cut") {
  const Split split =
      Run("program M main @m:0\n  var W real local\n  @m:1 : call name SUB calls SUB (0: variable W)\n"
          "program SUB sub @m:10\n  param B real parameter ref\n"
          "  @m:11 : axis X = 1\n  @m:12 : tool = 2\n  @m:13 : axis X = variable B\n");
  CHECK(split.findings == "NC6001");
  CHECK(split.messages.find("reference B") != std::string::npos);
}

}  // namespace
}  // namespace ncport::ir::transform
