#include "ir/analysis/number_kinds.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "ir/parse_dump.h"

namespace ncport::ir::analysis {
namespace {

constexpr std::string_view kHead =
    "ncport-ir 1\nspace R 0..9 real kept all zero\nspace N 0..9 int kept all zero\n"
    "system $P_EP programmed-position real\n";

/// Kinds of the values of the `feed` words of all programs, in the order of the text: N W w c for never, whole,
/// written, computed.
std::string Feeds(std::string_view programs, bool counters_round = true) {
  diag::Sink sink;
  Result<Module> parsed = ParseDump(std::string(kHead) + std::string(programs), sink);
  REQUIRE_MESSAGE(parsed.Ok(), (sink.Empty() ? "" : sink.All().front().message));
  const Module& module = parsed.Value();
  const CallGraph calls(module);
  NumberKinds kinds(module, calls, counters_round);
  std::string feeds;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId block : module.programs[program].blocks) {
      for (const WordId word : module.blocks[block].words) {
        if (module.words[word].op != WordOp::kFeed) continue;
        feeds += "NWwc"[static_cast<int>(kinds.At(program, block, module.words[word].value))];
      }
    }
  }
  return feeds;
}

/// Of one expression in a main program with a REAL A, an INT I and an array V.
std::string Of(std::string_view expr) {
  return Feeds("program M main\n  var A real local\n  var I int local\n  var V real local dims 3\n  @- : feed = " +
               std::string(expr) + "\n");
}

TEST_CASE("number_kinds: literals are whole, written up to twelve digits, else computed") {
  CHECK(Of("5") == "W");
  CHECK(Of("5.0") == "W");
  CHECK(Of("-3") == "W");
  CHECK(Of("0.1") == "w");
  CHECK(Of("12345.678901") == "w");
  CHECK(Of("1234567.890123") == "c");  // thirteen digits
  CHECK(Of("1000000000000") == "c");   // beyond what counts are taken for
  CHECK(Of("literal(0.1, computed)") == "c");
  CHECK(Of("literal(1500, as \"1.5EX3\")") == "W");
  CHECK(Of("literal(0.0015, as \"1.5EX-3\")") == "c");
}

TEST_CASE("number_kinds: sums of counts are counts, all other arithmetic on reals computes") {
  CHECK(Of("add(2, 3)") == "W");
  CHECK(Of("sub(variable:int I, 1)") == "W");
  CHECK(Of("add(0.1, 1)") == "c");
  CHECK(Of("sub(0.3, 0.1)") == "c");
  CHECK(Of("mul(variable:int I, 2)") == "W");
  CHECK(Of("mul(variable A, variable A)") == "c");  // may grow beyond what doubles tell apart
  CHECK(Of("mul(0.5, 2)") == "c");
  CHECK(Of("div(4, 2)") == "c");
  CHECK(Of("idiv(0.7, 0.2)") == "W");
  CHECK(Of("mod(7, 3)") == "W");
  CHECK(Of("mod(0.7, 0.2)") == "c");
  CHECK(Of("negate(0.1)") == "w");
  CHECK(Of("group(plus(0.1))") == "w");
  CHECK(Of("bit-and(5, 3)") == "W");
  CHECK(Of("lt:bool(0.1, 0.2)") == "W");
}

TEST_CASE("number_kinds: rounding makes whole numbers, choices keep the worst of what they choose from") {
  CHECK(Of("call round(mul(0.1, 3))") == "W");
  CHECK(Of("call truncate(div(1, 3))") == "W");
  CHECK(Of("call abs(0.1)") == "w");
  CHECK(Of("call min(1, 0.1)") == "w");
  CHECK(Of("call max(1, div(1, 3))") == "c");
  CHECK(Of("call bound(0, 5, 2)") == "W");
  CHECK(Of("call sin(30)") == "c");
  CHECK(Of("call sqrt(4)") == "c");
  CHECK(Of("call round-to-increment(0.1)") == "c");
  CHECK(Of("convert:int(div(1, 3))") == "W");
  CHECK(Of("convert:real(0.1)") == "w");
  CHECK(Of("system $P_EP(axis-name X)") == "c");
}

TEST_CASE("number_kinds: a variable never written holds its zero; INT is whole whatever is written") {
  CHECK(Of("variable A") == "W");
  CHECK(Of("element V(1:int)") == "W");
  CHECK(Feeds("program M main\n  var I int local\n  @- : assign variable:int I = div(1, 3)\n  @- : feed = variable:int "
              "I\n") == "W");
  CHECK(Feeds("program M main\n  @- : assign cell:int N[1] = div(1, 3)\n  @- : feed = cell:int N[1]\n") == "W");
}

TEST_CASE("number_kinds: the flow inside a program tells which write a block sees") {
  CHECK(Feeds("program M main\n  var A real local\n"
              "  @- : assign variable A = 0.1\n  @- : feed = variable A\n"
              "  @- : assign variable A = div(1, 3)\n  @- : feed = variable A\n"
              "  @- : assign variable A = 7\n  @- : feed = variable A\n") == "wcW");
  // Ways that meet: the worst of them.
  CHECK(Feeds("program M main\n  var A real local\n  @- : assign variable A = 1\n"
              "  @- : jump forward label B = lt:bool(cell:real R[1], 2)\n"
              "  @- : assign variable A = div(1, 3)\n  @- label B : feed = variable A\n") == "c");
  // A block that may be skipped.
  CHECK(Feeds("program M main\n  var A real local\n  @- : assign variable A = div(1, 3)\n"
              "  @- skip 1 : assign variable A = 1\n  @- : feed = variable A\n") == "c");
  CHECK(Feeds("program M main\n  var A real local\n  @- : assign variable A = div(1, 3)\n"
              "  @- : when = lt:bool(cell:real R[1], 2); assign variable A = 1\n  @- : feed = variable A\n") == "c");
  // Inside a block both sides of its assignment count.
  CHECK(Feeds("program M main\n  var A real local\n  @- : assign variable A = 0.1\n"
              "  @- : feed = variable A; assign variable A = div(1, 3)\n") == "c");
}

TEST_CASE("number_kinds: a count in a loop stays one, a sum of fractions does not") {
  const auto loop = [](std::string_view step) {
    return Feeds(
        "program M main\n  var A real local\n  @- : assign variable A = 0\n  @- label L : feed = variable A\n"
        "  @- : assign variable A = add(variable A, " +
        std::string(step) + ")\n  @- : jump backward label L = lt:bool(variable A, 5)\n");
  };
  CHECK(loop("1") == "W");
  CHECK(loop("0.1") == "c");
}

TEST_CASE("number_kinds: a computed index may write any cell of its space") {
  CHECK(Feeds("program M main\n  @- : assign cell:real R[1] = 5\n  @- : assign cell-at R[cell:int N[1]] = div(1, 3)\n"
              "  @- : feed = cell:real R[1]\n") == "c");
  CHECK(Feeds("program M main\n  @- : assign cell:real R[1] = 5\n  @- : assign cell-at R[cell:int N[1]] = 3\n"
              "  @- : feed = cell:real R[1]; feed-once = 1\n") == "W");
  CHECK(Feeds("program M main\n  @- : assign cell:real R[1] = div(1, 3)\n  @- : feed = cell-at R[cell:int N[1]]\n") ==
        "c");
}

TEST_CASE("number_kinds: lists and calls may write: behind them a variable is what anything gives it") {
  CHECK(Feeds("program M main\n  var V real local dims 3\n  @- : assign-list place element V(0:int) (1, 2)\n"
              "  @- : feed = element V(0:int)\n") == "c");
  CHECK(
      Feeds(
          "program M main\n  @- : assign cell:real R[1] = 5\n  @- : call name S calls S\n  @- : feed = cell:real R[1]\n"
          "program S sub\n  @- : assign cell:real R[1] = div(1, 3)\n") == "c");
  CHECK(Feeds("program M main\n  var A real local\n  @- : assign variable A = 1\n  @- : call name S calls S (0: "
              "variable A)\n"
              "  @- : feed = variable A\n"
              "program S sub\n  param P real parameter ref\n  @- : assign variable P = div(1, 3)\n") == "c");
}

TEST_CASE("number_kinds: cells that are read before they are written are what an operator keyed in") {
  CHECK(Feeds("program M main\n  @- : feed = cell:real R[1]\n") == "w");
  CHECK(Feeds("program M main\n  @- : assign cell:real R[1] = 3\n  @- : feed = cell:real R[1]\n") == "W");
}

TEST_CASE("number_kinds: arguments are at least written, a missing one its default or zero") {
  const auto called = [](std::string_view args) {
    return Feeds("program M main\n  @- : call name S calls S " + std::string(args) +
                 "\nprogram S sub\n  param P real parameter\n  param Q real parameter initial 0.5\n"
                 "  @- : feed = variable P; feed-once = 1\n  @- : feed = variable Q\n");
  };
  CHECK(called("(0: 5, 1: 5)") == "ww");
  CHECK(called("(0: div(1, 3))") == "cw");
  CHECK(called("") == "Ww");
  // Nothing calls it: a person writes the arguments.
  CHECK(Feeds("program S sub\n  param P real parameter\n  @- : feed = variable P\n") == "w");
  CHECK(Feeds("program S sub\n  param P real parameter ref\n  @- : feed = variable P\n") == "c");
}

TEST_CASE("number_kinds: a counter is whole where its start is rounded and its step whole") {
  const auto counted = [](std::string_view start, std::string_view step, bool rounds) {
    return Feeds("program M main\n  var A real local\n  @- link +2 : for variable A to 5" + std::string(step) + " = " +
                     std::string(start) + "\n  @- : feed = variable A\n  @- link -2 : end-for\n",
                 rounds);
  };
  CHECK(counted("1", "", true) == "W");
  CHECK(counted("0.5", "", true) == "W");
  CHECK(counted("0.5", "", false) == "c");
  CHECK(counted("1", "", false) == "W");
  CHECK(counted("1", " step 0.1", true) == "c");
  CHECK(counted("1", " step 2", true) == "W");
}

TEST_CASE("number_kinds: which numbers compare exactly") {
  CHECK(IsExact(NumberKind::kWhole));
  CHECK(IsExact(NumberKind::kWritten));
  CHECK_FALSE(IsExact(NumberKind::kComputed));
}

}  // namespace
}  // namespace ncport::ir::analysis
