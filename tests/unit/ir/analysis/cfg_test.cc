#include "ir/analysis/cfg.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/parse_dump.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

Module Parse(std::string_view text) {
  diag::Sink sink;
  Result<Module> module = ParseDump("ncport-ir 1\n" + std::string(text), sink);
  for (const auto& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
  REQUIRE(module.Ok());
  return std::move(*module);
}

constexpr std::string_view kNames[] = {
    "next",    "jump",     "arm", "false",  "then-end",         "back",  "part",     "part-end",
    "restart", "computed", "end", "return", "return-to-target", "alarm", "text-end", "missing"};

// Edges of the blocks of the first program: "0: next 1, jump 3".
std::vector<std::string> Edges(const Module& module) {
  const FlowGraphs graphs(module);
  const Cfg& cfg = graphs.Of(ProgramId{std::size_t{0}});
  std::vector<std::string> lines;
  for (const BlockId block : cfg.Blocks()) {
    std::string line;
    for (const Edge& edge : cfg.Successors(block)) {
      if (!line.empty()) line += ", ";
      line += kNames[static_cast<std::size_t>(edge.kind)];
      if (edge.to.Valid()) line += " " + std::to_string(edge.to.value);
    }
    if (!cfg.Reachable(block)) line += " (unreachable)";
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> EdgesOf(std::string_view blocks) {
  return Edges(Parse("space R 0..9 real kept all zero\nprogram P main\n" + std::string(blocks)));
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("ir cfg: straight text, its end, and what stops a run") {
  CHECK(EdgesOf("@- : motion rapid\n@-\n") == Lines{"next 1", "text-end"});
  CHECK(EdgesOf("@- : program-end #30\n@- : return plain\n") == Lines{"end", "return (unreachable)"});
  CHECK(EdgesOf("@- skip 0 : program-end #30\n@- : restart\n") == Lines{"end, next 1", "restart 0"});
  CHECK(EdgesOf("@- : when = 1; program-end\n@- : skip-rest 1; return to-caller = 5\n") ==
        Lines{"end, next 1", "return-to-target, text-end"});
  CHECK(EdgesOf("@- : alarm shows = 1\n@- : alarm by-number = 2\n@- : alarm stops = 3\n@-\n") ==
        Lines{"next 1", "alarm, next 2", "alarm", "text-end (unreachable)"});
}

TEST_CASE("ir cfg: structures") {
  CHECK(EdgesOf("@- link +2 : if = 1\n@-\n@- link +2 : else\n@-\n@- link -4 : end-if\n@-\n") ==
        Lines{"false 3, next 1", "next 2", "then-end 4", "next 4", "next 5", "text-end"});
  CHECK(EdgesOf("@- link +2 : if = 1\n@-\n@- link -2 : end-if\n") == Lines{"text-end, next 1", "next 2", "text-end"});
  CHECK(EdgesOf("@- link +1 : while = 1\n@- link -1 : end-while\n@-\n") ==
        Lines{"false 2, next 1", "back 0", "text-end"});
  CHECK(EdgesOf("@- link +1 : for cell R[1] to 5 = 1\n@- link -1 : end-for\n@-\n") ==
        Lines{"false 2, next 1", "back 0", "text-end"});
  CHECK(EdgesOf("@- link +1 : loop\n@- link -1 : end-loop\n@-\n") ==
        Lines{"next 1", "back 0", "text-end (unreachable)"});
  CHECK(EdgesOf("@- link +2 : repeat\n@-\n@- link -2 : until = 1\n@-\n") ==
        Lines{"next 1", "next 2", "false 1, next 3", "text-end"});
  // A mark that could not be read still closes its structure.
  CHECK(EdgesOf("@- link +1 refused : verbatim mark while \"WHILE ?\"\n@- link -1 : end-while\n@-\n") ==
        Lines{"false 2, next 1", "back 0", "text-end"});
}

TEST_CASE("ir cfg: jumps search as the control does") {
  CHECK(EdgesOf("@- label A\n@- : jump forward label A\n@- label A\n") == Lines{"next 1", "jump 2", "text-end"});
  CHECK(EdgesOf("@- label A\n@- : jump backward label A = 1\n@- label A\n") ==
        Lines{"next 1", "jump 0, next 2", "text-end"});
  CHECK(EdgesOf("@- : jump forward label B\n@- : jump forward label B quiet\n@-\n") ==
        Lines{"missing", "next 2 (unreachable)", "text-end (unreachable)"});
  CHECK(EdgesOf("@- : jump forward number 20 = 1; jump forward number 30 = 0; jump forward program-start\n"
                "@- N20\n@- N030\n") == Lines{"jump 1, jump 2, jump 0", "next 2", "text-end"});
}

TEST_CASE("ir cfg: labels in blocks that can be skipped may be hidden") {
  CHECK(EdgesOf("@- : jump forward label A\n@- skip 1 label A\n@- skip 1 label A\n@- label A\n") ==
        Lines{"jump 1, jump 3", "next 2", "next 3", "text-end"});
  CHECK(EdgesOf("@- : jump forward label A\n@- skip 1 label A\n") == Lines{"jump 1, missing", "text-end"});
}

TEST_CASE("ir cfg: switches") {
  CHECK(EdgesOf("@- : switch (1 => forward label A, 2 => forward label B, - => forward label C) = cell R[1]\n"
                "@- label A\n@- label B\n@- label C\n") ==
        Lines{"arm 1, arm 2, arm 3", "next 2", "next 3", "text-end"});
  CHECK(EdgesOf("@- : switch (1 => forward label A) = cell R[1]\n@-\n@- label A\n") ==
        Lines{"arm 2, next 1", "next 2", "text-end"});
}

TEST_CASE("ir cfg: repeated parts go in and come back behind their word") {
  CHECK(EdgesOf("@- label A\n@-\n@- : repeat-part first label A = 3\n@-\n") ==
        Lines{"next 1", "next 2, part-end 3, part 0", "part 0, next 3", "text-end"});
  CHECK(EdgesOf("@- label A\n@- label B\n@- : repeat-part first label A last label A\n") ==
        Lines{"next 1, text-end", "next 2", "part 0, text-end"});
  CHECK(EdgesOf("@- : repeat-part first label X\n@-\n") == Lines{"missing, next 1", "text-end"});
}

TEST_CASE("ir cfg: computed targets may be any label or number") {
  const Module module = Parse(
      "space R 0..9 real kept all zero\nprogram P main\n"
      "@- : jump forward expression cell R[1]\n@-\n@- label A\n@- : program-end\n@- N10\n");
  CHECK(Edges(module) == Lines{"computed", "next 2 (unreachable)", "next 3", "end", "text-end"});
  const FlowGraphs graphs(module);
  CHECK(graphs.Of(ProgramId{std::size_t{0}}).ComputedTargets().size() == 2);
  CHECK(EdgesOf("@- label A\n@- : jump backward expression \"a\"\n") == Lines{"next 1", "jump 0"});
}

TEST_CASE("ir cfg: a call may come back at a label when the callee returns there") {
  const Module module = Parse(
      "program P main\n@- : call name S calls S\n@- : program-end\n@- N10\n"
      "program S sub\n@- : return to-caller = 10\n");
  CHECK(Edges(module) == Lines{"computed, next 1", "end", "text-end"});
}

TEST_CASE("ir cfg: predecessors mirror successors") {
  const Module module =
      Parse("program P main\n@- link +2 : if = 1\n@-\n@- link -2 : end-if\n@- : jump backward label A\n");
  const FlowGraphs graphs(module);
  const Cfg& cfg = graphs.Of(ProgramId{std::size_t{0}});
  const auto ways = cfg.Predecessors(BlockId{std::size_t{3}});
  REQUIRE(ways.size() == 2);
  CHECK(ways[0] == BlockId{std::size_t{0}});
  CHECK(ways[1] == BlockId{std::size_t{2}});
  CHECK(cfg.Predecessors(BlockId{std::size_t{0}}).empty());
}

TEST_CASE("ir cfg: the graph as text joins straight runs") {
  const Module module = Parse(
      "file p.mpf\nprogram P main @p.mpf:1\n"
      "@p.mpf:1 : motion rapid\n@p.mpf:2 : call name S calls S; call name GONE\n"
      "@p.mpf:3 link +2 : while = 1\n@p.mpf:4\n@p.mpf:5 link -2 : end-while\n@p.mpf:6 : program-end\n"
      "@p.mpf:7\n@-\nprogram S sub\n@p.mpf:9 : return plain\nprogram EMPTY sub\n");
  TextBuffer out;
  DumpCfg(module, out);
  CHECK(std::string(out.View()) ==
        "program P\n"
        "  1 @p.mpf:1 to @p.mpf:2\n"
        "    call S\n"
        "    call GONE unknown\n"
        "    next 2\n"
        "  2 @p.mpf:3\n"
        "    false 4\n"
        "    next 3\n"
        "  3 @p.mpf:4 to @p.mpf:5\n"
        "    back 2\n"
        "  4 @p.mpf:6\n"
        "    end\n"
        "  5 @p.mpf:7 to @- unreachable\n"
        "    text-end\n"
        "program S\n"
        "  1 @p.mpf:9\n"
        "    return\n"
        "program EMPTY\n");
}

TEST_CASE("ir call_graph: sites, order, recursion and depth") {
  const Module module = Parse(
      "program MAIN main\n@- : call name A calls A; modal-call name B calls B\n@- : call name X\n"
      "program A sub\n@- : call name B calls B\n"
      "program B sub\n@-\n"
      "program C sub\n@- : call name D calls D\n"
      "program D sub\n@- : call name C calls C\n@- : call name B calls B\n"
      "program E sub\n@- : call block-range E calls E from number 1 to number 2\n"
      "program F sub\n@- : call name C calls C\n");
  const CallGraph graph(module);
  const auto id = [](std::size_t index) { return ProgramId{index}; };
  REQUIRE(graph.SitesOf(id(0)).size() == 3);
  CHECK(graph.SitesOf(id(0))[0].callee == id(1));
  CHECK_FALSE(graph.SitesOf(id(0))[0].modal);
  CHECK(graph.SitesOf(id(0))[1].modal);
  CHECK_FALSE(graph.SitesOf(id(0))[2].callee.Valid());
  CHECK(graph.SitesOf(id(2)).empty());
  CHECK(graph.AllSites().size() == 9);

  const auto& order = graph.BottomUp();
  REQUIRE(order.size() == 7);
  const auto place = [&](std::size_t program) {
    return std::find(order.begin(), order.end(), id(program)) - order.begin();
  };
  CHECK(place(2) < place(1));
  CHECK(place(1) < place(0));
  CHECK(place(3) < place(6));
  CHECK(graph.GroupOf(id(3)) == graph.GroupOf(id(4)));
  CHECK(graph.GroupOf(id(1)) != graph.GroupOf(id(2)));

  CHECK(graph.Recursive(id(3)));
  CHECK(graph.Recursive(id(4)));
  CHECK_FALSE(graph.Recursive(id(5)));
  CHECK_FALSE(graph.Recursive(id(6)));
  CHECK(graph.DepthOf(id(0)) == 2);
  CHECK(graph.DepthOf(id(1)) == 1);
  CHECK(graph.DepthOf(id(2)) == 0);
  CHECK(graph.DepthOf(id(4)) == CallGraph::kUnbounded);
  CHECK(graph.DepthOf(id(5)) == 0);
  CHECK(graph.DepthOf(id(6)) == CallGraph::kUnbounded);
}

TEST_CASE("ir call_graph: long chains of calls need no deep stack") {
  std::string text;
  constexpr int kPrograms = 20000;
  for (int i = 0; i < kPrograms; ++i) {
    text += "program P" + std::to_string(i) + " sub\n";
    if (i + 1 < kPrograms) text += "@- : call name X calls P" + std::to_string(i + 1) + "\n";
  }
  const CallGraph graph(Parse(text));
  CHECK(graph.DepthOf(ProgramId{std::size_t{0}}) == kPrograms - 1);
  CHECK(graph.BottomUp().front() == ProgramId{std::size_t{kPrograms - 1}});
}
