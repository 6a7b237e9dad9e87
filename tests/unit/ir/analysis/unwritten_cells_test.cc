#include "ir/analysis/unwritten_cells.h"

#include <doctest/doctest.h>

#include <string>

#include "base/diag/sink.h"
#include "ir/parse_dump.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

/// Numbers of the cells that are read before they are written: "1 3 ?".
std::string Unwritten(const std::string& text) {
  diag::Sink sink;
  Result<Module> module = ParseDump("ncport-ir 1\nspace R 0..9 real kept all zero\n" + text, sink);
  for (const auto& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
  REQUIRE(module.Ok());
  std::string cells;
  for (const UnwrittenRead& read : UnwrittenCells(*module, FlowGraphs(*module), CallGraph(*module))) {
    if (!cells.empty()) cells += ' ';
    cells += read.cell == UnwrittenRead::kComputed ? "?" : std::to_string(read.cell);
  }
  return cells;
}

std::string Main(const std::string& blocks) { return "program M main\n" + blocks; }
std::string Sub(const std::string& blocks) { return "program S sub\n" + blocks; }

const std::string kRead2 = "@- : axis X = cell R[2]\n";

}  // namespace

TEST_CASE("ir unwritten_cells: read before written on some way") {
  CHECK(Unwritten(Main("@- : assign cell R[2] = 1\n" + kRead2)).empty());
  CHECK(Unwritten(Main(kRead2 + "@- : assign cell R[2] = cell R[1]\n")) == "1 2");
  CHECK(Unwritten(Main("@- : jump forward label A = 1\n@- : assign cell R[2] = 1\n@- label A\n" + kRead2)) == "2");
  CHECK(Unwritten(Main("@- skip 1 : assign cell R[2] = 1\n" + kRead2)) == "2");
  CHECK(Unwritten(Main("@- : axis X = cell-at R[1]\n")) == "?");
}

TEST_CASE("ir unwritten_cells: calls add what they write and ask for what they read") {
  const std::string call = "@- : call name S calls S\n";
  CHECK(Unwritten(Main(call + kRead2) + Sub("@- : assign cell R[2] = cell R[1]\n")) == "1");
  CHECK(Unwritten(Main("@- : assign cell R[2] = 1\n" + call + call) + Sub(kRead2)).empty());
  // What one caller wrote, another did not.
  CHECK(Unwritten(Main("@- : assign cell R[2] = 1\n" + call) + Sub(kRead2) + "program T sub\n" + call) == "2");
  // A modal call runs behind the next move, or never.
  CHECK(Unwritten(Main("@- : modal-call name S calls S\n@- : axis Y = 1\n" + kRead2) +
                  Sub("@- : assign cell R[2] = 1\n")) == "2");
  CHECK(Unwritten(Main("@- : call name GONE\n" + kRead2)) == "2");
}

TEST_CASE("ir unwritten_cells: programs that call each other and that nothing else calls are started from outside") {
  CHECK(Unwritten(Sub(kRead2 + "@- : call name T calls T\n") + "program T sub\n@- : call name S calls S\n") == "2");
}

TEST_CASE("ir unwritten_cells: behind a part with computed ends nothing is written for sure") {
  CHECK(Unwritten(Main("@- : assign cell R[1] = 1\n"
                       "@- : repeat-part first expression cell R[1]\n@- : assign cell R[2] = 1\n" +
                       kRead2)) == "1 2");
}

TEST_CASE("ir unwritten_cells: inside a block the order of the text decides") {
  CHECK(Unwritten(Main("@- : assign cell R[2] = 1; axis X = cell R[2]\n")).empty());
  CHECK(Unwritten(Main("@- : axis X = cell R[2]; assign cell R[2] = 1\n")) == "2");
  CHECK(Unwritten(Main("@- : assign cell R[2] = add(cell R[2], 1)\n")) == "2");
}

TEST_CASE("ir unwritten_cells: writes under a condition, in a loop of no pass, or to a computed number count as none") {
  const std::string one = "@- : assign cell R[1] = 1\n";
  CHECK(Unwritten(Main(one + "@- : when = lt:bool(cell R[1], 2); assign cell R[2] = 1\n" + kRead2)) == "2");
  CHECK(Unwritten(Main("@- : axis Y = 1; skip-rest 1; assign cell R[2] = 1\n" + kRead2)) == "2");
  CHECK(Unwritten(Main(one +
                       "@- link +2 : while = lt:bool(cell R[1], 2)\n@- : assign cell R[2] = 1\n"
                       "@- link -2 : end-while\n" +
                       kRead2)) == "2");
  CHECK(Unwritten(Main(one +
                       "@- link +2 : if = lt:bool(cell R[1], 2)\n@- : assign cell R[2] = 1\n@- link +2 : else\n"
                       "@- : assign cell R[2] = 2\n@- link -4 : end-if\n" +
                       kRead2))
            .empty());
  CHECK(Unwritten(Main(one + "@- : assign cell-at R[cell R[1]] = 1\n" + kRead2)) == "2");
  CHECK(Unwritten(Main("@- : assign cell-at R[cell R[3]] = 1\n")) == "3");
  CHECK(Unwritten(Main(one + "@- skip 1 : call name S calls S\n" + kRead2) + Sub("@- : assign cell R[2] = 1\n")) ==
        "2");
}

TEST_CASE("ir unwritten_cells: every word that takes a value reads") {
  for (const char* word : {"message = call to-text(cell R[1])",
                           "alarm stops cell R[1] = 1",
                           "alarm stops = cell R[1]",
                           "jump forward expression cell R[1]",
                           "switch (1 => forward label A) = cell R[1]",
                           "switch (cell R[1] => forward label A) = 2",
                           "call name S (0: cell R[1])",
                           "call name S passes cell R[1]",
                           "modal-call name S (0: cell R[1])",
                           "call text - by cell R[1]",
                           "repeat-part first label A single = cell R[1]",
                           "data-setting name - (0 X: cell R[1])",
                           "workpiece name - (0: cell R[1])",
                           "assign-list place element V(0:int) (cell R[1])",
                           "assign-list place element V(cell R[1]) (1)",
                           "assign-list place element V(0:int) (1) repeat count cell R[1]",
                           "assign element V(cell R[1]) = 1",
                           "axis-computed call axis-from-text(cell R[1]) = 1",
                           "define W",
                           "define U"}) {
    CAPTURE(word);
    CHECK(Unwritten("program M main\n  var V real local dims 3\n  var W real local initial cell R[1]\n"
                    "  var U real local dims 3 initial-list (cell R[1])\n  @- : " +
                    std::string(word) + "\n  @- label A : axis X = 1\n") == "1");
  }
}

TEST_CASE("ir unwritten_cells: FOR writes its counter and reads its bounds") {
  CHECK(Unwritten(Main("@- link +2 : for cell R[1] to cell R[3] step cell R[4] = cell R[5]\n@- : axis X = cell R[1]\n"
                       "@- link -2 : end-for\n")) == "3 4 5");
}
