#include "ir/analysis/value_range.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "ir/parse_dump.h"

namespace ncport::ir::analysis {
namespace {

std::string Text(const Interval& value) {
  const auto bound = [](double b) {
    return b == kInfinity ? "inf" : b == -kInfinity ? "-inf" : fmt::format("{:.6g}", b);
  };
  std::string text = !value.HasNumber()        ? std::string("none")
                     : value.IsPoint()         ? bound(value.low)
                     : value.low == value.high ? bound(value.low)
                                               : fmt::format("{}..{}", bound(value.low), bound(value.high));
  if (value.Has(Interval::kVacant)) text += "?";
  return text;
}

/// What the `feed` words can be, in the order of the text; a block of several contexts once for each.
class Feeds : public RangeObserver {
 public:
  explicit Feeds(const Module& module) : module_(module) {}
  void Block(const RangeSite& site, RangeLookup& values) override {
    for (const WordId word : module_.blocks[site.block].words) {
      if (module_.words[word].op != WordOp::kFeed) continue;
      if (!text.empty()) text += ' ';
      text += Text(values.Evaluate(module_.words[word].value));
    }
  }
  void Exit(const RangeSite&, RangeLookup&) override { ++exits; }
  std::string text;
  int exits = 0;

 private:
  const Module& module_;
};

struct Setting {
  RangeOptions options;
  std::function<void(const Module&, RangeOptions&)> declare;
  bool counter_rounds = true;
};

std::string Ranges(std::string_view programs, const Setting& setting = {}) {
  diag::Sink sink;
  const std::string cells = std::regex_replace(std::string(programs), std::regex("\\bR\\["), "cell:real R[");
  const std::string text = std::regex_replace(cells, std::regex("cell-at cell:real R"), "cell-at:real R");
  Result<Module> parsed = ParseDump(
      "ncport-ir 1\nspace R 0..99 real kept all unknown\nspace # 1..33 number call level vacant\n" + text, sink);
  REQUIRE_MESSAGE(parsed.Ok(), (sink.Empty() ? "" : sink.All().front().message));
  const Module& module = parsed.Value();
  Machine machine;
  machine.for_counter_rounds = setting.counter_rounds;
  machine.shown_alarms = {{67000, 67999}};
  const FlowGraphs graphs(module);
  const CallGraph calls(module);
  RangeOptions options = setting.options;
  if (setting.declare) setting.declare(module, options);
  Feeds feeds(module);
  const RangeStatistics statistics = FindValueRanges(module, machine, graphs, calls, options, feeds);
  if (statistics.given_up != 0) return "given up";
  return feeds.text;
}

std::string Main(std::string_view blocks) {
  return Ranges(
      "program M main\n  var A real local\n  var B real local\n  var I int local\n  var V real local dims 3\n" +
      std::string(blocks));
}

TEST_CASE("value_range: assignments and arithmetic") {
  CHECK(Main("  @- : assign variable:real A = 5\n  @- : feed = variable:real A\n"
             "  @- : feed = add:real(mul:real(variable:real A, 2), 1)\n") == "5 11");
  CHECK(Main("  @- : define A\n  @- : feed = variable:real A\n") == "0");  // a local starts with zero
  CHECK(Main("  @- : feed = R[1]\n") == "-inf..inf");
  CHECK(Main("  @- : feed = call:real sin(R[1])\n") == "-1..1");
  CHECK(Main("  @- : feed = call:real abs(R[1])\n") == "0..inf");
}

TEST_CASE("value_range: conditions narrow what they test, on both ways") {
  CHECK(Main("  @- : assign R[1] = R[2]\n  @- link +2 : if = lt:bool(R[1], 5)\n  @- : feed = R[1]\n"
             "  @- link +2 : else\n  @- : feed = R[1]\n  @- link -4 : end-if\n  @- : feed = R[1]\n") ==
        "-inf..5 5..inf -inf..inf");
  CHECK(Main("  @- : jump forward label OUT = or:bool(lt:bool(R[1], 1), gt:bool(R[1], 9))\n  @- : feed = R[1]\n"
             "  @- label OUT : axis X = 1\n") == "1..9");
  CHECK(Main("  @- link +2 : if = and:bool(ge:bool(R[1], 1), le:bool(R[1], 9))\n  @- : feed = R[1]\n"
             "  @- link -2 : end-if\n") == "1..9");
  CHECK(
      Main("  @- link +2 : if = not:bool(group:bool(gt:bool(R[1], 9)))\n  @- : feed = R[1]\n  @- link -2 : end-if\n") ==
      "-inf..9");
  // The other side narrows too.
  CHECK(
      Main("  @- : assign variable:real A = 3\n  @- link +2 : if = gt:bool(variable:real A, R[1])\n  @- : feed = R[1]\n"
           "  @- link -2 : end-if\n") == "-inf..3");
}

TEST_CASE("value_range: a way that no run takes is not seen") {
  CHECK(Main("  @- : assign variable:real A = 3\n  @- link +2 : if = gt:bool(variable:real A, 5)\n"
             "  @- : feed = variable:real A\n  @- link -2 : end-if\n  @- : feed = 1\n") == "1");
  CHECK(Main("  @- : jump forward label OUT\n  @- : feed = 2\n  @- label OUT : feed = 1\n") == "1");
}

TEST_CASE("value_range: ways that meet give all values of both") {
  CHECK(Main("  @- : assign variable:real A = 3\n  @- link +2 : if = gt:bool(R[1], 5)\n"
             "  @- : assign variable:real A = 8\n  @- link -2 : end-if\n  @- : feed = variable:real A\n") == "3..8");
  CHECK(Main("  @- : assign variable:real A = 3\n  @- skip 1 : assign variable:real A = 8\n"
             "  @- : feed = variable:real A\n") == "3..8");
  CHECK(Main("  @- : assign variable:real A = 3\n  @- : when = lt:bool(R[1], 2); assign variable:real A = 8\n"
             "  @- : feed = variable:real A\n") == "3..8");
  CHECK(Main("  @- : assign variable:real A = 3; skip-rest 1; assign variable:real A = 8\n"
             "  @- : feed = variable:real A\n") == "3..8");
  CHECK(Main("  @- : assign variable:real A = 3\n"
             "  @- : switch (1 => forward label B, - => forward label C) = R[1]\n"
             "  @- label B : assign variable:real A = 5\n  @- label C : feed = variable:real A\n") == "3..5");
}

TEST_CASE("value_range: loops hold every pass, and end where their test says") {
  CHECK(Main("  @- : assign variable:real A = 0\n  @- link +3 : while = lt:bool(variable:real A, 10)\n"
             "  @- : feed = variable:real A\n  @- : assign variable:real A = add:real(variable:real A, 1)\n"
             "  @- link -3 : end-while\n  @- : feed = variable:real A\n") == "0..9 10");
  const std::string open = Main(
      "  @- : assign variable:real A = 0\n  @- label L : assign variable:real A = add:real(variable:real A, 1)\n"
      "  @- : feed = variable:real A\n  @- : jump backward label L = lt:bool(R[1], 10)\n");
  CHECK(open == "1..inf");
}

TEST_CASE("value_range: the counter of FOR runs from its start to its end") {
  CHECK(Main("  @- link +2 : for variable:int I to 5:int = 1:int\n  @- : feed = variable:int I\n  @- link -2 : "
             "end-for\n") == "1..5");
  // No pass.
  CHECK(
      Main("  @- link +2 : for variable:int I to 0:int = 1:int\n  @- : feed = variable:int I\n  @- link -2 : end-for\n"
           "  @- : feed = 7\n") == "7");
}

TEST_CASE("value_range: elements of an array hold what any index may have written") {
  CHECK(Main("  @- : define V\n  @- : assign element:real V(0:int) = 1\n  @- : assign element:real V(1:int) = 5\n"
             "  @- : feed = element:real V(1:int)\n  @- : feed = element:real V(variable:int I)\n") == "0..5 0..5");
  CHECK(Main("  @- : define V\n  @- : assign-list place element:real V(0:int) (1, 9)\n"
             "  @- : feed = element:real V(1:int)\n") == "0..9");
  CHECK(Main("  @- : feed = element:real V(1:int)\n") == "-inf..inf");  // no definition was run
}

TEST_CASE("value_range: a computed cell may be any of its space") {
  CHECK(Main("  @- : assign R[1] = 5\n  @- : assign cell-at R[R[2]] = 9\n  @- : feed = R[1]\n") == "5..9");
  CHECK(Main("  @- : assign R[1] = 5\n  @- : feed = cell-at R[R[1]]\n") != "5");
}

TEST_CASE("value_range: calls are followed with the values of each call") {
  const std::string_view sub =
      "program S sub\n  param P real parameter\n  @- : feed = variable:real P\n  @- : return plain\n";
  CHECK(Ranges("program M main\n  @- : call name S calls S (0: 5)\n  @- : call name S calls S (0: 7)\n" +
               std::string(sub)) == "5 7");
  // More calls than are followed one by one are taken together.
  Setting few;
  few.options.contexts_per_program = 1;
  const std::string together = Ranges(
      "program M main\n  @- : call name S calls S (0: 5)\n  @- : call name S calls S (0: 7)\n" + std::string(sub), few);
  CHECK_MESSAGE((together.find("5..7") != std::string::npos || together.find("inf") != std::string::npos), together);
}

TEST_CASE("value_range: what a call does to cells and references is seen behind it") {
  CHECK(Ranges("program M main\n  @- : assign R[1] = 5\n  @- : call name S calls S\n  @- : feed = R[1]\n"
               "program S sub\n  @- : assign R[1] = add:real(R[1], 2)\n") == "7");
  CHECK(Ranges("program M main\n  var W real local\n  @- : assign variable:real W = 5\n"
               "  @- : call name S calls S (0: variable:real W)\n  @- : feed = variable:real W\n"
               "program S sub\n  param P real parameter ref\n  @- : assign variable:real P = 9\n") == "9");
  const std::string unknown =
      Ranges("program M main\n  @- : assign R[1] = 5\n  @- : call name NOWHERE\n  @- : feed = R[1]\n");
  CHECK(unknown == "-inf..inf");
  // By value the caller's variable stays.
  CHECK(Ranges("program M main\n  var W real local\n  @- : assign variable:real W = 5\n"
               "  @- : call name S calls S (0: variable:real W)\n  @- : feed = variable:real W\n"
               "program S sub\n  param P real parameter\n  @- : assign variable:real P = 9\n") == "5");
}

TEST_CASE("value_range: a modal call runs behind blocks of motion") {
  CHECK(Ranges("program M main\n  @- : assign R[1] = 5\n  @- : modal-call name S calls S\n  @- : axis X = 1\n"
               "  @- : feed = R[1]\n"
               "program S sub\n  @- : assign R[1] = 9\n") != "5");
}

TEST_CASE("value_range: an alarm ends the run where none of its numbers only shows") {
  const auto behind = [](std::string_view kind, std::string_view number) {
    return Main("  @- : assign R[1] = 5\n  @- link +3 : if = gt:bool(R[2], 0)\n  @- : assign R[1] = 9\n  @- : alarm " +
                std::string(kind) + " = " + std::string(number) + "\n  @- link -3 : end-if\n  @- : feed = R[1]\n");
  };
  CHECK(behind("stops", "67000") == "5");
  CHECK(behind("shows", "61000") == "5..9");
  CHECK(behind("by-number", "61000") == "5");
  CHECK(behind("by-number", "67000") == "5..9");
  CHECK(behind("by-number", "R[3]") == "5..9");
}

TEST_CASE("value_range: a modal call begins with what it is given, and goes on with what it left") {
  const auto sub = [](std::string_view body) {
    return Ranges(
        "program M main\n  @- : modal-call name S calls S (0: 1)\n  @- : axis X = 1\n"
        "program S sub\n  param P real parameter\n" +
        std::string(body));
  };
  CHECK(sub("  @- : feed = variable:real P\n") == "1");
  CHECK(sub("  @- : feed = variable:real P\n  @- : assign variable:real P = 1\n") == "1");
  CHECK(sub("  @- : feed = variable:real P\n  @- : assign variable:real P = 2\n") == "-inf..inf");
}

TEST_CASE("value_range: a program that nothing calls starts with unknown arguments, narrowed by what is declared") {
  const std::string_view sub = "program S sub\n  param P real parameter\n  @- : feed = variable:real P\n";
  CHECK(Ranges(sub) == "-inf..inf");
  Setting declared;
  declared.declare = [](const Module& module, RangeOptions& options) {
    options.declared.push_back({module.programs[ProgramId{0U}].parameters[0], 20, 300});
  };
  // A call may leave the argument out: that is 0.
  CHECK(Ranges(sub, declared) == "0..300");
  // A call outside of the range is a call all the same.
  CHECK(Ranges("program S sub\n  param P real parameter\n  @- : feed = variable:real P\n"
               "program M main\n  @- : call name S calls S (0: 5)\n",
               declared)
            .find("5") != std::string::npos);
}

TEST_CASE("value_range: a missing argument is its default or zero") {
  CHECK(Ranges("program M main\n  @- : call name S calls S\n"
               "program S sub\n  param P real parameter\n  param Q real parameter initial 7:real\n"
               "  @- : feed = variable:real P\n  @- : feed = variable:real Q\n") == "0 7");
}

TEST_CASE("value_range: cells of a call level start empty, anew in each call") {
  CHECK(Ranges("program M main\n  @- : feed = cell:number #[1]\n  @- : assign cell:number #[1] = 5\n"
               "  @- : call name S calls S\n  @- : feed = cell:number #[1]\n"
               "program S sub\n  @- : feed = cell:number #[1]\n  @- : assign cell:number #[1] = 9\n") ==
        "none? 5 none?");
  // Shared with the caller (M98).
  CHECK(Ranges("program M main\n  @- : assign cell:number #[1] = 5\n"
               "  @- : call name S same-level calls S\n  @- : feed = cell:number #[1]\n"
               "program S sub\n  @- : assign cell:number #[1] = 9\n") == "9");
}

TEST_CASE("value_range: recursion, computed jumps and repeated parts stay sound") {
  const std::string deep = Ranges(
      "program M main\n  @- : assign R[1] = 0\n  @- : call name S calls S\n  @- : feed = R[1]\n"
      "program S sub\n  @- : assign R[1] = add:real(R[1], 1)\n"
      "  @- : jump forward label OUT = gt:bool(R[1], 5)\n  @- : call name S calls S\n  @- label OUT : return plain\n");
  CHECK_MESSAGE((deep == "given up" || deep.ends_with("inf") || deep == "1..7" || deep == "5..7"), deep);
  CHECK(Main("  @- : assign variable:real A = 3\n  @- : jump forward expression R[1] = lt:bool(R[2], 1)\n"
             "  @- : assign variable:real A = 8\n  @- N10 : feed = variable:real A\n") == "3..8");
  const std::string part = Main(
      "  @- : assign variable:real A = 0\n  @- label P : assign variable:real A = add:real(variable:real A, 1)\n"
      "  @- : repeat-part first label P = 3\n  @- : feed = variable:real A\n");
  CHECK_MESSAGE((part.ends_with("inf") || part == "1..4" || part == "4"), part);
}

}  // namespace
}  // namespace ncport::ir::analysis
