#include "backends/fanuc/tool_flow.h"

#include <doctest/doctest.h>

#include "base/diag/sink.h"
#include "ir/parse_dump.h"

namespace ncport::backends::fanuc {
namespace {

/// The tool in force at the block labelled HERE.
std::string AtHere(const std::string& text) {
  diag::Sink sink;
  const Result<ir::Module> module = ir::ParseDump("ncport-ir 1\nfile m\n" + text, sink);
  REQUIRE(module.Ok());
  const ir::Machine machine;
  const ir::analysis::FlowAnalyses analyses(*module, machine, {});
  const ToolFlow flow(analyses.Sources());
  for (const ir::BlockId id : module->blocks.Ids()) {
    if (module->View(module->blocks[id].label) == "HERE") return std::string(flow.Before(id));
  }
  return "no such block";
}

TEST_CASE("the tool of the straight way") {
  CHECK(AtHere("program M main @m:0\n"
               "  @m:1 : tool = 1:int\n"
               "  @m:2 : axis X = 1\n"
               "  @m:3 label HERE : edge = 2:int\n"
               "  @m:4 : program-end #30\n") == "T1");
  CHECK(AtHere("program M main @m:0\n  @m:1 label HERE : edge = 1:int\n").empty());
  CHECK(AtHere("program M main @m:0\n  @m:1 : tool = \"ROUGH\"\n  @m:2 label HERE : edge = 1:int\n") == "T=\"ROUGH\"");
}

TEST_CASE("a tool called in one branch only is not the tool behind it") {
  CHECK(AtHere("program M main @m:0\n"
               "  @m:1 : tool = 1:int\n"
               "  @m:2 : jump forward label HERE = gt:bool(1:int, 0:int)\n"
               "  @m:3 : tool = 2:int\n"
               "  @m:4 label HERE : edge = 2:int\n")
            .empty());
  CHECK(AtHere("program M main @m:0\n"
               "  @m:1 : tool = 1:int\n"
               "  @m:2 : jump forward label HERE = gt:bool(1:int, 0:int)\n"
               "  @m:3 : tool = 1:int\n"
               "  @m:4 label HERE : edge = 2:int\n") == "T1");
  CHECK(AtHere("program M main @m:0\n"
               "  @m:1 : tool = 1:int\n"
               "  @m:2 skip 1 : tool = 2:int\n"
               "  @m:3 label HERE : edge = 2:int\n")
            .empty());
}

TEST_CASE("a loop that changes the tool brings it to its head") {
  CHECK(AtHere("program M main @m:0\n"
               "  @m:1 : tool = 1:int\n"
               "  @m:2 label HERE : edge = 2:int\n"
               "  @m:3 : tool = 2:int\n"
               "  @m:4 : jump backward label HERE = gt:bool(1:int, 0:int)\n")
            .empty());
}

TEST_CASE("calls hand the tool on and bring one back") {
  const std::string caller =
      "program M main @m:0\n"
      "  @m:1 : tool = 1:int\n"
      "  @m:2 : call name SUB calls SUB\n";
  const std::string sub = "program SUB sub @m:10 header\n";
  CHECK(AtHere(caller + "  @m:3 label HERE : edge = 2:int\n" + sub +
               "  @m:11 : tool = 2:int\n  @m:12 : return plain\n") == "T2");
  CHECK(AtHere(caller + "  @m:3 label HERE : edge = 2:int\n" + sub +
               "  @m:11 : axis X = 1\n  @m:12 : return plain\n") == "T1");
  CHECK(AtHere(caller + sub + "  @m:11 label HERE : edge = 2:int\n  @m:12 : return plain\n") == "T1");
  // Called with two tools: neither is the one.
  CHECK(AtHere(caller + "  @m:3 : tool = 2:int\n  @m:4 : call name SUB calls SUB\n" + sub +
               "  @m:11 label HERE : edge = 2:int\n  @m:12 : return plain\n")
            .empty());
}

TEST_CASE("a modal call may bring its tool behind each block with motion") {
  const std::string sub = "program SUB sub @m:10 header\n  @m:11 : tool = 2:int\n  @m:12 : return plain\n";
  const std::string caller = "program M main @m:0\n  @m:1 : modal-call name SUB calls SUB\n  @m:2 : tool = 3:int\n";
  CHECK(AtHere(caller + "  @m:3 label HERE : edge = 2:int\n" + sub) == "T3");
  CHECK(AtHere(caller + "  @m:3 : axis X = 1\n  @m:4 label HERE : edge = 2:int\n" + sub).empty());
}

TEST_CASE("behind a part with computed ends no tool is known") {
  CHECK(AtHere("space R 0..9 real kept all zero\nprogram M main @m:0\n"
               "  @m:1 : repeat-part first expression cell R[1]\n"
               "  @m:2 : tool = 1:int\n"
               "  @m:3 label HERE : edge = 2:int\n")
            .empty());
}

}  // namespace
}  // namespace ncport::backends::fanuc
