#include "ir/transform/names_to_numbers.h"

#include <fmt/format.h>

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

/// Letters A, B, C (cells 1 to 3) and F (9); 4 to 33 are free locals, 100 to 149 scratch.
NamesToNumbersConfig Config() {
  NamesToNumbersConfig config;
  config.letters = {{'A', 1}, {'B', 2}, {'C', 3}};
  config.feed_letter = {'F', 9};
  config.free_locals_first = {10, 12, 30};
  config.scratch = {{100, 149}};
  return config;
}

struct Numbers {
  std::string text;
  std::string map;  // "PROG.NAME=#n PROG.NAME=Xn", common ones with a star
  std::string findings;
  std::string messages;
  bool ok = false;
};

Numbers Run(std::string_view programs, const NamesToNumbersConfig& config = Config(),
            std::string_view head = "space R 0..99 real kept all zero\n") {
  Numbers numbers;
  diag::Sink sink;
  numbers.text = test::After("ncport-ir 1\nfile m\n" + std::string(head) + test::WithCells(programs), sink,
                             [&](Module& module, diag::Sink& findings) {
                               const NamesToNumbersResult result = NamesToNumbers(module, config, findings);
                               numbers.ok = result.ok;
                               for (const CellMapping& mapping : result.map) {
                                 if (!numbers.map.empty()) numbers.map += ' ';
                                 if (mapping.program.Valid())
                                   numbers.map +=
                                       fmt::format("{}.", module.View(module.programs[mapping.program].name));
                                 numbers.map += fmt::format("{}={}", mapping.source, mapping.first);
                                 if (mapping.count > 1) numbers.map += fmt::format("+{}", mapping.count);
                                 if (mapping.letter != 0) numbers.map += mapping.letter;
                                 if (mapping.common) numbers.map += '*';
                                 if (mapping.outlives) numbers.map += '!';
                               }
                               // What the header promises of the text behind the pass.
                               if (result.ok) {
                                 for (const ProgramId program : module.programs.Ids()) {
                                   for (const BlockId block : module.programs[program].blocks) {
                                     for (const WordId word : module.blocks[block].words) {
                                       const ExprId value = module.words[word].value;
                                       if (value.Valid()) CHECK(module.exprs[value].op != ExprOp::kVariable);
                                       if (value.Valid()) CHECK(module.exprs[value].op != ExprOp::kElement);
                                     }
                                   }
                                 }
                               }
                               return result.ok;
                             });
  numbers.text = std::regex_replace(test::WithoutTypes(numbers.text), std::regex("cell (#|R)\\["), "$1[");
  numbers.text = std::regex_replace(numbers.text, std::regex("cell-at #"), "#");
  numbers.findings = test::CodesOf(sink);
  for (const diag::Diagnostic& finding : sink.All()) numbers.messages += finding.message + "\n";
  CHECK(numbers.ok == sink.Empty());
  return numbers;
}

void Refused(std::string_view programs, std::string_view why, const NamesToNumbersConfig& config = Config(),
             std::string_view head = "space R 0..99 real kept all zero\n") {
  CAPTURE(programs);
  const Numbers numbers = Run(programs, config, head);
  CHECK_FALSE(numbers.ok);
  CHECK(numbers.findings.starts_with("NC6001"));
  CHECK_MESSAGE(numbers.messages.find(why) != std::string::npos, numbers.messages);
}

TEST_CASE("parameters take the cells of letters in their order, a feed its own letter, locals free cells") {
  const Numbers numbers =
      Run("program M main @m:0\n"
          "  @m:1 : call name SUB calls SUB (0: 5, 1: 100, 2: R[7])\n"
          "program SUB sub @m:10\n  param A real parameter\n  param B real parameter\n  param C real parameter\n"
          "  var L real local\n  var K real local\n"
          "  @m:11 : assign variable L = variable A; assign variable K = 1\n"
          "  @m:12 : axis X = variable L; axis Y = variable C; feed = variable B\n");
  CHECK(numbers.map == "R7=107*! SUB.A=1A SUB.B=9F SUB.C=2B SUB.L=10 SUB.K=12");
  CHECK(numbers.text ==
        "program M main\n"
        "call name SUB calls SUB (0 A: 5, 1 F: 100, 2 B: #[107])\n"
        "program SUB sub\n"
        "assign #[10] = #[1]; assign #[12] = 1\n"
        "axis X = #[10]; axis Y = #[2]; feed = #[9]\n");
}

TEST_CASE("a missing argument is its default value or 0: an empty one would be another thing on the target") {
  const Numbers numbers =
      Run("program M main @m:0\n"
          "  @m:1 : call name SUB calls SUB (0: -)\n"
          "program SUB sub @m:10\n  param A real parameter\n  param B real parameter initial 7:real\n"
          "  @m:11 : axis X = variable A; axis Y = variable B\n");
  CHECK(numbers.text.starts_with("program M main\ncall name SUB calls SUB (0 A: 0, 1 B: 7)\n"));
}

TEST_CASE("a definition is an assignment, unless the next lines set the variable anyway") {
  const Numbers numbers =
      Run("program M main @m:0\n"
          "  var A real local initial 5:real\n  var B real local\n  var C real local\n  var D real local\n"
          "  var U real local\n"
          "  @m:1 N10 : define A; define B\n    ; end-of-block \"note\"\n"
          "  @m:2 : define C; define D; define U\n"
          "  @m:3 : assign variable B = variable C\n"
          "  @m:4 link +2 : if = lt(variable A, variable B)\n"
          "  @m:5 : assign variable D = 1\n"
          "  @m:6 link -2 : end-if\n"
          "  @m:7 : axis X = variable D\n");
  CHECK(numbers.text ==
        "program M main\n"
        "N10 assign #[10] = 5\n"
        "assign #[30] = 0\n"
        "assign #[1] = 0\n"
        "assign #[12] = #[30]\n"
        "if = lt(#[10], #[12])\n"
        "assign #[1] = 1\n"
        "end-if\n"
        "axis X = #[1]\n");
}

TEST_CASE("a variable that a list, a message or an alarm reads first is not set by the next lines") {
  for (const std::string_view reads :
       {"assign-list place element V(0:int) (variable A)", "message = call to-text(variable A)",
        "alarm stops variable A = 61000", "call name M (0: variable A)"}) {
    CAPTURE(reads);
    const Numbers numbers =
        Run("program M main @m:0\n  var A real local\n  var V real local dims 2\n  @m:1 : define A\n  @m:2 : " +
            std::string(reads) + "\n  @m:3 : assign variable A = 1\n");
    CHECK(numbers.text.find("assign #[10] = 0\n") != std::string::npos);
  }
}

TEST_CASE("arrays are rows of cells, the last index fastest (sinumerik-3.5)") {
  const Numbers numbers = Run(
      "program M main @m:0\n"
      "  var V real local dims 2 3 initial-list (1, -, 3)\n"
      "  @m:1 : define V\n"
      "  @m:2 : axis X = element V(1:int, 2:int); axis Y = element V(R[1], 1:int); axis Z = element V(1:int, R[2])\n");
  CHECK(numbers.map == "R1=101*! R2=102*! M.V[0] to [5]=1+6");
  CHECK(numbers.text ==
        "program M main\n"
        "assign #[1] = 1\nassign #[2] = 0\nassign #[3] = 3\nassign #[4] = 0\nassign #[5] = 0\nassign #[6] = 0\n"
        "axis X = #[6]; axis Y = #[add(mul(3, #[101]), 2)]; axis Z = #[add(#[102], 4)]\n");
}

TEST_CASE("a repeated start value fills as many elements as it says, all without a count") {
  const auto start = [](std::string_view list) {
    return Run("program M main @m:0\n  var V real local dims 3 initial-list " + std::string(list) +
               "\n  @m:1 : define V\n  @m:2 : axis X = element V(R[1])\n")
        .text;
  };
  CHECK(start("(5) repeat").find("assign #[1] = 5\nassign #[2] = 5\nassign #[3] = 5\n") != std::string::npos);
  CHECK(start("(5) repeat count 2").find("assign #[1] = 5\nassign #[2] = 5\nassign #[3] = 0\n") != std::string::npos);
}

TEST_CASE("by reference means copied in before the call and out behind it") {
  const Numbers numbers =
      Run("program M main @m:0\n  var W real local\n  var V real local dims 2\n"
          "  @m:1 N10 : call name SUB calls SUB (0: variable W, 1: variable V)\n"
          "  @m:2 : axis X = variable W\n"
          "program SUB sub @m:10\n  param A real parameter ref\n  param B real parameter ref dims 2\n"
          "  @m:11 : assign variable A = element B(1:int)\n");
  CHECK(numbers.map == "M.W=10 M.V[0] to [1]=1+2 SUB.A=100* SUB.B=101+2*");
  CHECK(numbers.text ==
        "program M main\n"
        "N10 assign #[100] = #[10]\n"
        "assign #[101] = #[1]\n"
        "assign #[102] = #[2]\n"
        "call name SUB same-level calls SUB\n"
        "assign #[10] = #[100]\n"
        "assign #[1] = #[101]\n"
        "assign #[2] = #[102]\n"
        "axis X = #[10]\n"
        "program SUB sub\n"
        "assign #[100] = #[102]\n");
}

TEST_CASE("references that alias, that a modal call gives, or that are no variable are refused") {
  const std::string sub =
      "program SUB sub @m:10\n  param A real parameter ref\n  param B real parameter ref\n"
      "  @m:11 : assign variable A = variable B\n";
  const std::string main = "program M main @m:0\n  var W real local\n  var V real local dims 2\n  @m:1 : ";
  Refused(main + "call name SUB calls SUB (0: variable W, 1: variable W)\n" + sub, "reach another way");
  Refused(main + "call name SUB calls SUB (0: R[1], 1: R[1])\n" + sub, "reach another way");
  Refused(main + "call name SUB calls SUB (0: element V(0:int), 1: element V(0:int))\n" + sub, "reach another way");
  Refused(main + "call name SUB calls SUB (0: variable W, 1: element V(variable W))\n" + sub, "by reference");
  // Below the call the cell has its own name too, or may have by an index.
  Refused(main + "call name SUB calls SUB (0: variable W, 1: R[1])\n" + sub + "  @m:12 : axis X = R[1]\n",
          "reach another way");
  const Numbers indexed =
      Run(main + "call name SUB calls SUB (0: variable W, 1: R[1])\n" + sub + "  @m:12 : axis X = cell-at R[R[3]]\n",
          Config(), "space R 0..9 real kept all zero\n");
  CHECK_FALSE(indexed.ok);
  CHECK(indexed.messages.find("reach another way") != std::string::npos);
}

TEST_CASE("a cell and an element by reference that nothing below the call names are copied in and out") {
  CHECK(Run("program M main @m:0\n  var V real local dims 2\n"
            "  @m:1 : call name SUB calls SUB (0: R[1], 1: element V(0:int))\n"
            "program SUB sub @m:10\n  param A real parameter ref\n  param B real parameter ref\n"
            "  @m:11 : assign variable A = variable B\n")
            .ok);
}

TEST_CASE("a program that calls itself shares no common cells with its own calls") {
  Refused(
      "program M main @m:0\n  var W real local\n  @m:1 : call name SUB calls SUB (0: variable W)\n"
      "program SUB sub @m:10\n  param A real parameter ref\n  var L real local\n"
      "  @m:11 : call name SUB calls SUB (0: variable L)\n"
      "  @m:12 : assign variable A = 3\n",
      "itself");
  // By value every level has its own.
  CHECK(Run("program M main @m:0\n  @m:1 : call name SUB calls SUB (0: 3)\n"
            "program SUB sub @m:10\n  param A real parameter\n  var L real local\n"
            "  @m:11 : call name SUB calls SUB (0: variable L)\n"
            "  @m:12 : axis X = variable A\n")
            .ok);
}

TEST_CASE("an array by reference without its size is refused") {
  Refused(
      "program M main @m:0\n  var V real local dims 2\n  @m:1 : call name SUB calls SUB (0: variable V)\n"
      "program SUB sub @m:10\n  param A real parameter ref dims 0\n  @m:11 : axis X = element A(1:int)\n",
      "A");
  Refused(
      "program M main @m:0\n  var V real local dims 2\n  @m:1 : call name SUB calls SUB (0: variable V)\n"
      "program SUB sub @m:10\n  param A real parameter ref dims 3\n  @m:11 : axis X = element A(1:int)\n",
      "A");
}

TEST_CASE("what is no number, and what has no place, is refused where it is defined") {
  Refused("program SUB sub @m:10\n  param A string parameter length 10\n  @m:11 : message = variable A\n", "no number");
  Refused("program M main @m:0\n  var T string local length 10\n  @m:11 : message = variable T\n", "no number");
  Refused(
      "program SUB sub @m:10\n  param A real parameter\n  param B real parameter\n  param C real parameter\n"
      "  param D real parameter\n  @m:11 : axis X = variable D\n",
      "more parameters than");
  Refused("program M main @m:0\n  var V real local dims 60\n  @m:1 : axis X = element V(R[1])\n", "no free cells");
  NamesToNumbersConfig none = Config();
  none.scratch = {};
  Refused("program M main @m:0\n  @m:1 : axis X = R[1]\n", "used up", none);
  Refused("program M main @m:0\n  @m:1 : axis X = cell-at R[1]\n", "move together");
}

TEST_CASE("a space that an index reaches moves as one piece") {
  const Numbers numbers = Run("program M main @m:0\n  @m:1 : assign cell-at R[R[3]] = R[5]\n", Config(),
                              "space R 0..9 real kept all zero\n");
  CHECK(numbers.map == "R0 to R9=100+10*!");
  CHECK(numbers.text == "program M main\nassign #[add(#[103], 100)] = #[105]\n");
}

TEST_CASE("a variable that other programs may use needs a cell from the user") {
  const std::string_view text = "program M main @m:0\n  @m:1 : assign variable G = 1\n";
  const std::string_view head = "var G real global\n";
  Refused(text, "no [variables] line", Config(), head);
  NamesToNumbersConfig config = Config();
  config.pins = {{"g", 510}};
  CHECK(Run(text, config, head).map == "G=510*");
}

TEST_CASE("a variable of the main program that its subprograms see lives outside of the levels") {
  const Numbers numbers = Run(
      "program M main @m:0\n  var G real program\n  @m:1 : assign variable G = 1\n  @m:2 : call name SUB calls SUB\n"
      "program SUB sub @m:10\n  var L real local\n  @m:11 : assign variable L = variable G~1\n");
  CHECK(numbers.map == "M.G=100* SUB.L=10");
  // One that only the main program names is a local like any other.
  CHECK(Run("program M main @m:0\n  var G real program\n  @m:1 : assign variable G = 1\n").map == "M.G=10");
}

TEST_CASE("pins hold, whatever else is placed before them") {
  NamesToNumbersConfig config = Config();
  config.pins = {{"R10", 105}, {"M.B", 10}, {"V", 110}};
  const Numbers numbers =
      Run("program M main @m:0\n  var A real local\n  var B real local\n  var V real local dims 3\n"
          "  @m:1 : assign variable A = R[10]; assign variable B = R[5]; assign element V(R[12]) = R[11]\n",
          config);
  CHECK(numbers.map == "R5=100*! R10=105*! R11=101*! R12=102*! M.A=12 M.B=10 M.V[0] to [2]=110+3*");
}

TEST_CASE("two variables pinned to one cell, or one to a cell that does not exist, are refused") {
  const std::string_view text = "program M main @m:0\n  @m:1 : assign R[1] = R[2]\n";
  NamesToNumbersConfig config = Config();
  config.pins = {{"R1", 510}, {"R2", 510}};
  Refused(text, "510", config);
  config.pins = {{"R1", 5041}};
  Refused(text, "5041", config);
  config.pins = {{"R1", 10}};  // local: another one at each call
  Refused(text, "R1 in #10", config);
  config.pins = {{"V", 30}};
  Refused("program M main @m:0\n  var V real local dims 9\n  @m:1 : axis X = element V(R[1])\n", "V in #30", config);
}

TEST_CASE("a program without names and cells of a source stays as it is") {
  const Numbers numbers = Run("program M main @m:0\n  @m:1 : axis X = 5; motion linear\n  @m:2 : call name SUB\n");
  CHECK(numbers.ok);
  CHECK(numbers.map.empty());
  CHECK(numbers.text == "program M main\naxis X = 5; motion linear\ncall name SUB\n");
}

}  // namespace
}  // namespace ncport::ir::transform
