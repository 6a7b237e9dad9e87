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
