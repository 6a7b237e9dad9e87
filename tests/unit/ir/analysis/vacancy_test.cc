#include "ir/analysis/vacancy.h"

#include <doctest/doctest.h>

#include <string>

#include "base/diag/sink.h"
#include "ir/parse_dump.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

constexpr std::uint32_t kGiven = 7;  // declared as an argument that is always there

/// What #1, #2 ... of the programs may be at the block labelled HERE: e empty, n number, ? either, - no run.
std::string AtHere(const std::string& text, const Machine& machine = {}) {
  diag::Sink sink;
  Result<Module> parsed = ParseDump(
      "ncport-ir 1\nspace # 1..33 number call level vacant\nspace C 100..199 number kept all vacant\n" + text, sink);
  for (const auto& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
  REQUIRE(parsed.Ok());
  const Module& module = *parsed;
  const FlowGraphs graphs(module);
  const CallGraph calls(module);
  const Vacancy vacancy(module, machine, graphs, calls,
                        {{}, [](ProgramId, std::uint32_t cell) { return cell == kGiven; }});
  for (const BlockId id : module.blocks.Ids()) {
    if (module.View(module.blocks[id].label) != "HERE") continue;
    const Vacancy::State* state = vacancy.Before(id);
    if (state == nullptr) return "no way";
    std::string line;
    for (std::size_t i = 0; i < vacancy.Size(); ++i) line += "-en?"[(*state)[i] & Vacancy::kUnsure];
    return line;
  }
  return "no such block";
}

std::string Main(const std::string& blocks) { return "program M main\n" + blocks; }
std::string Sub(const std::string& blocks) { return "program S sub\n" + blocks; }

const std::string kHere = "@- label HERE : feed = cell #[1]\n";

}  // namespace

TEST_CASE("ir vacancy: a main program starts with empty locals; what it writes holds a number") {
  CHECK(AtHere(Main(kHere)) == "e");
  CHECK(AtHere(Main("@- : assign cell #[1] = 1\n" + kHere)) == "n");
  CHECK(AtHere(Main("@- skip 1 : assign cell #[1] = 1\n" + kHere)) == "?");
  CHECK(AtHere(Main("@- : assign cell #[1] = 1\n@- : assign cell #[1] = vacant\n" + kHere)) == "e");
  CHECK(AtHere(Main("@- : assign cell #[2] = cell C[100]\n" + kHere)) == "e??");
}

TEST_CASE("ir vacancy: a test for emptiness tells what holds behind it") {
  const std::string test = "@- : jump forward label HERE = eq!vacant-differs:bool(cell #[1], vacant)\n@-\n";
  CHECK(AtHere(Sub(test + "@- : jump forward label OTHER\n" + kHere + "@- label OTHER\n")) == "e");
  // No run gets there.
  CHECK(AtHere(Main("@- : assign cell #[1] = 1\n" + test + "@- : program-end\n" + kHere)) == "no way");
}

TEST_CASE("ir vacancy: calls start locals anew, and leave common cells as they come back") {
  const std::string call = "@- : call name S calls S (1 A: 5)\n";
  CHECK(AtHere(Main(call) + Sub("@- label HERE : feed = add(cell #[1], cell #[2])\n")) == "ne");
  CHECK(AtHere(Main("@- : assign cell #[2] = 1\n" + call + "@- label HERE : feed = cell C[100]\n") +
               Sub("@- : assign cell C[100] = 1\n@- : assign cell #[1] = vacant\n")) == "enn");
  // Given as the user declares, where no caller is known.
  CHECK(AtHere(Sub("@- label HERE : feed = add(cell #[1], cell #[7])\n")) == "?n");
}

TEST_CASE("ir vacancy: the program of a modal call finds what its own run before left in its locals") {
  const std::string main =
      Main("@- : modal-call name S calls S (1 A: 5)\n@- : assign cell C[100] = 1\n@- : axis X = 1\n");
  CHECK(AtHere(main + Sub("@- label HERE : feed = cell #[2]\n@- : assign cell #[1] = vacant\n"
                          "@- : assign cell #[2] = 1\n")) == "???");
  CHECK(AtHere(main + Sub("@- label HERE : feed = cell #[2]\n@- : assign cell #[3] = 1\n")) == "ne??");
}

TEST_CASE("ir vacancy: further passes find the locals of the one before, or fresh ones") {
  CHECK(AtHere(Main("@- : call name S calls S passes 2\n") +
               Sub("@- label HERE : feed = cell #[1]\n@- : assign cell #[1] = 1\n")) == "?");
}

TEST_CASE("ir vacancy: where a part has computed ends any cell may be empty or not") {
  CHECK(AtHere(Main("@- : repeat-part first expression cell C[100]\n@- : assign cell #[1] = 1\n" + kHere)) == "??");
}
