#include "ir/analysis/forward_flow.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "ir/parse_dump.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

constexpr int kNone = 0, kMixed = -1;

/// The number of the last tool word.
struct Tools {
  using State = int;
  const Module& module;

  State Entry(ProgramId) const { return kNone; }
  State Unknown(ProgramId) const { return kMixed; }
  bool Join(BlockId, State& into, State from) const {
    const State before = into;
    if (into != from) into = kMixed;
    return into != before;
  }
  void Transfer(ProgramId, BlockId block, State& state) const {
    for (const WordId id : module.blocks[block].words) {
      const Word& word = module.words[id];
      if (word.op == WordOp::kTool) state = static_cast<int>(module.exprs[word.value].number);
    }
  }
};

/// As Tools, but a jump is known to be taken with tool 7 only, and modal calls hand on 9 where they are written.
struct Choosy : Tools {
  std::optional<State> Into(const CallSite&, CallMoment moment, State at) const {
    return moment == CallMoment::kModalStart ? 9 : at;
  }
  State Back(const CallSite&, State at, State exit) const { return exit == 5 ? at : exit; }
  bool Along(ProgramId, BlockId, const Edge& edge, State& state) const {
    if (edge.kind != EdgeKind::kJump) return true;
    if (state != 7 && state != kMixed) return false;
    state = 7;
    return true;
  }
};

std::string Text(const int* state) { return state == nullptr ? "-" : *state == kMixed ? "?" : std::to_string(*state); }

using Lines = std::vector<std::string>;

/// The state before each block, in the order of the text; then entry and exit of each program.
template <class Client = Tools>
Lines Flow(const std::string& text, const Machine& machine = {}) {
  diag::Sink sink;
  Result<Module> parsed = ParseDump("ncport-ir 1\nspace R 0..9 real kept all zero\n" + text, sink);
  for (const auto& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
  REQUIRE(parsed.Ok());
  const Module& module = *parsed;
  const FlowAnalyses analyses(module, machine, {machine.start, {}});
  Client client{{module}};
  ForwardFlow<Client> flow(analyses.Sources(), client);
  flow.Run();
  Lines lines;
  for (const ProgramId program : module.programs.Ids()) {
    std::string line;
    for (const BlockId block : module.programs[program].blocks) line += Text(flow.Before(block)) + " ";
    lines.push_back(line + "in " + Text(flow.Entry(program)) + " out " + Text(flow.Exit(program)));
  }
  return lines;
}

std::string Main(const std::string& blocks) { return "program M main\n" + blocks; }
std::string Sub(const std::string& blocks) { return "program S sub\n" + blocks; }

}  // namespace

TEST_CASE("ir forward_flow: straight text, branches and dead text") {
  CHECK(Flow(Main("@- : tool = 1\n@-\n@- : program-end\n@-\n")) == Lines{"0 1 1 - in 0 out 1"});
  CHECK(Flow(Main("@- : tool = 1\n@- : jump forward label A = 1\n@- : tool = 2\n@- label A\n")) ==
        Lines{"0 1 1 ? in 0 out ?"});
  CHECK(Flow(Main("@- : tool = 1\n@- : jump forward label A = 1\n@- : tool = 1\n@- label A\n")) ==
        Lines{"0 1 1 1 in 0 out 1"});
  CHECK(Flow(Main("")) == Lines{"in 0 out 0"});
}

TEST_CASE("ir forward_flow: loops reach a fixed point") {
  // What the body makes comes to its head again.
  CHECK(Flow(Main("@- : tool = 1\n@- link +3 : while = 1\n@-\n@- : tool = 2\n@- link -3 : end-while\n@-\n")) ==
        Lines{"0 ? ? ? 2 ? in 0 out ?"});
  CHECK(Flow(Main("@- : tool = 1\n@- link +2 : while = 1\n@-\n@- link -2 : end-while\n@-\n")) ==
        Lines{"0 1 1 1 1 in 0 out 1"});
}

TEST_CASE("ir forward_flow: what may be left out joins both") {
  CHECK(Flow(Main("@- : tool = 1\n@- skip 1 : tool = 2\n@-\n")) == Lines{"0 1 ? in 0 out ?"});
  CHECK(Flow(Main("@- : tool = 1\n@- : when = 1; tool = 2\n@-\n")) == Lines{"0 1 ? in 0 out ?"});
  CHECK(Flow(Main("@- : tool = 1\n@- : skip-rest 1; tool = 2\n@-\n")) == Lines{"0 1 ? in 0 out ?"});
}

TEST_CASE("ir forward_flow: alarms and missing targets lead nowhere") {
  const std::string call = "@- : tool = 1\n@- : call name S calls S\n@-\n";
  CHECK(Flow(Main(call) + Sub("@- : jump forward label A = 1\n@- : tool = 2; alarm stops = 1\n@- label A\n")) ==
        Lines{"0 1 1 in 0 out 1", "1 1 1 in 1 out 1"});
  CHECK(Flow(Main(call) + Sub("@- : tool = 2\n@- : jump forward label A = 1\n@- : tool = 1\n")) ==
        Lines{"0 1 1 in 0 out 1", "1 2 2 in 1 out 1"});
  // No way back: nothing is behind the call.
  CHECK(Flow(Main(call) + Sub("@- : alarm stops = 1\n")) == Lines{"0 1 - in 0 out -", "1 in 1 out -"});
}

TEST_CASE("ir forward_flow: calls join where they enter, and leave what the callee leaves") {
  CHECK(Flow(Main("@- : tool = 1\n@- : call name S calls S\n@- : tool = 3\n@- : call name S calls S\n@-\n") +
             Sub("@-\n@- : tool = 2\n@- : return plain\n")) == Lines{"0 1 2 3 2 in 0 out 2", "? ? 2 in ? out 2"});
  // A block that also leaves may do so before its call.
  CHECK(Flow(Main("@- : tool = 1\n@- : jump forward label A = 1; call name S calls S\n@-\n@- label A\n") +
             Sub("@- : tool = 2\n")) == Lines{"0 1 ? ? in 0 out ?", "1 in 1 out 2"});
  // Nothing is known behind a program that is not found, or a range of blocks; the range is entered.
  CHECK(Flow(Main("@- : tool = 1\n@- : call name GONE\n@-\n")) == Lines{"0 1 ? in 0 out ?"});
  CHECK(Flow(Main("@- : tool = 1\n@- : call block-range S calls S from number 1 to number 1\n@-\n") +
             Sub("@-\n@- N1\n@-\n")) == Lines{"0 1 ? in 0 out ?", "0 ? ? in 0 out ?"});
  // A call that names a block enters there, or at another one that has a name.
  CHECK(Flow(Main("@- : tool = 1\n@- : call name - from-block calls M from number 10\n@- : program-end\n@-\n"
                  "@- N10 : tool = 2\n@- : return plain\n")) == Lines{"0 1 2 - 1 2 in 0 out 2"});
  // A further pass starts with what the one before left.
  CHECK(Flow(Main("@- : tool = 1\n@- : call name S calls S passes 2\n@-\n") + Sub("@-\n@- : tool = 2\n")) ==
        Lines{"0 1 2 in 0 out 2", "? ? in ? out 2"});
}

TEST_CASE("ir forward_flow: circles of calls end") {
  CHECK(Flow(Main("@- : tool = 1\n@- : call name S calls S\n@-\n") +
             Sub("@- link +2 : if = 1\n@- : tool = 2; call name S calls S\n@- link -2 : end-if\n@-\n")) ==
        Lines{"0 1 ? in 0 out ?", "? ? ? ? in ? out ?"});
  // For ever: no way back.
  CHECK(Flow(Main("@- : call name S calls S\n@-\n") + Sub("@- : call name S calls S\n@-\n")) ==
        Lines{"0 - in 0 out -", "0 - in 0 out -"});
  // A circle that nothing else calls is started from outside, and so is what only dead text calls.
  CHECK(Flow(Sub("@- link +1 : if = 1\n@- link -1 : end-if\n@- : call name T calls T\n"
                 "program T sub\n@- : call name S calls S\n")) == Lines{"0 0 0 in 0 out -", "0 in 0 out -"});
  CHECK(Flow(Main("@- : program-end\n@- : call name S calls S\n") + Sub("@- : tool = 2\n")) ==
        Lines{"0 - in 0 out 0", "0 in 0 out 2"});
}

TEST_CASE("ir forward_flow: long chains of calls and jumps take linear work") {
  std::string text;
  constexpr int kPrograms = 5000;
  for (int i = 0; i < kPrograms; ++i) {
    text += "program P" + std::to_string(i) + " sub\n@- : tool = " + std::to_string(i) + "\n";
    if (i + 1 < kPrograms) text += "@- : call name X calls P" + std::to_string(i + 1) + "\n";
  }
  CHECK(Flow(text).front() == "0 0 in 0 out 4999");
  // Each computed jump may go to each of the labels.
  text = "program M main\n";
  for (int i = 0; i < 20000; ++i) text += "@- N" + std::to_string(i) + " : jump forward expression cell R[1] = 1\n";
  CHECK(Flow(text).front().starts_with("0 0 0 "));
}

TEST_CASE("ir forward_flow: computed jumps go to every label and number") {
  CHECK(Flow(Main("@- : tool = 1\n@- : jump forward expression cell R[1]\n@- N10\n@- : tool = 2\n@-\n@- label A\n")) ==
        Lines{"0 1 1 1 2 ? in 0 out ?"});
}

TEST_CASE("ir forward_flow: returns to a target of the caller") {
  const std::string sub = Sub("@- : tool = 2\n@- : return to-caller = 10\n");
  CHECK(Flow(Main("@- : call name S calls S\n@- : program-end\n@- N10\n") + sub) ==
        Lines{"0 2 2 in 0 out 2", "0 2 in 0 out 2"});
  // Out of a modal call as well, and in a main program it is a jump.
  CHECK(Flow(Main("@- : modal-call name S calls S\n@- : axis X = 1\n@- : program-end\n@- N10\n") + sub) ==
        Lines{"0 0 ? 2 in 0 out ?", "? 2 in ? out 2"});
  CHECK(Flow(Main("@- : tool = 3\n@- : return to-caller = 10\n@- N10\n")) == Lines{"0 3 3 in 0 out 3"});
}

TEST_CASE("ir forward_flow: what ends a program is the machine's") {
  const std::string text = Main("@- : call name S calls S\n@-\n") + Sub("@- : tool = 2\n@- : program-end\n");
  CHECK(Flow(text) == Lines{"0 2 in 0 out 2", "0 2 in 0 out 2"});
  Machine machine;
  machine.end_in_called_program_returns = false;
  CHECK(Flow(text, machine) == Lines{"0 - in 0 out -", "0 2 in 0 out -"});
  machine.return_in_main_restarts = true;
  const std::string back = "@-\n@- : tool = 2\n@- : return plain\n";
  CHECK(Flow(Main(back), machine) == Lines{"? ? 2 in 0 out 2"});
  CHECK(Flow(Sub(back), machine) == Lines{"0 0 2 in 0 out 2"});
}

TEST_CASE("ir forward_flow: modal calls may run behind blocks with motion, with what holds there") {
  const std::string sub = Sub("@-\n@- : tool = 5\n");
  // Not where they are written, nor behind blocks without motion, nor when they are cancelled.
  CHECK(Flow(Main("@- : tool = 1\n@- : modal-call name S calls S\n@- : feed = 1\n@- : tool = 2\n@-\n"
                  "@- : axis X = 1\n@-\n@- : modal-call\n@- : tool = 3\n@- : axis X = 1\n@-\n") +
             sub) == Lines{"0 1 1 1 2 2 ? ? ? 3 3 in 0 out 3", "? ? in ? out 5"});
  // Two of them: each is entered with its own state only.
  CHECK(Flow(Main("@- : tool = 1\n@- : modal-call name S calls S\n@- : axis X = 1\n@- : modal-call\n@- : tool = 2\n"
                  "@- : modal-call name T calls T\n@- : axis X = 1\n") +
             "program S sub\n@-\nprogram T sub\n@-\n") ==
        Lines{"0 1 1 1 1 2 2 in 0 out 2", "1 in 1 out 1", "2 in 2 out 2"});
  // Also in programs that are called meanwhile, and in the block that starts one if it moves.
  CHECK(Flow(Main("@- : modal-call name S calls S\n@- : call name P calls P\n@-\n") + sub +
             "program P sub\n@- : axis X = 1\n@-\n") == Lines{"0 0 ? in 0 out ?", "? ? in ? out 5", "0 ? in 0 out ?"});
  CHECK(Flow(Main("@- : axis X = 1; modal-call name S calls S\n@-\n") + sub) ==
        Lines{"0 ? in 0 out ?", "? ? in ? out 5"});
  // A program that is not found may do anything.
  CHECK(Flow(Main("@- : modal-call name GONE\n@- : tool = 1\n@- : axis X = 1\n@-\n")) == Lines{"0 0 1 ? in 0 out ?"});
}

TEST_CASE("ir forward_flow: a part with computed ends may do anything with the blocks of its program") {
  CHECK(Flow(Main("@- : tool = 1\n@- : repeat-part first expression cell R[1]\n@-\n")) == Lines{"? ? ? in 0 out ?"});
  CHECK(Flow(Main("@- : tool = 1\n@- : call name S calls S\n@-\n") +
             Sub("@- : repeat-part first expression cell R[1]\n@- : tool = 2\n@- : call name T calls T\n") +
             "program T sub\n@-\n") == Lines{"0 1 ? in 0 out ?", "? ? ? in 1 out ?", "? in ? out ?"});
}

TEST_CASE("ir forward_flow: a client may refine calls and ways") {
  const std::string sub = Sub("@-\n@- : tool = 5\n");
  CHECK(Flow<Choosy>(Main("@- : tool = 1\n@- : call name S calls S\n@-\n") + sub) ==
        Lines{"0 1 1 in 0 out 1", "1 1 in 1 out 5"});
  CHECK(Flow<Choosy>(Main("@- : tool = 1\n@- : modal-call name S calls S\n@-\n") + sub) ==
        Lines{"0 1 1 in 0 out 1", "9 9 in 9 out 5"});
  CHECK(Flow<Choosy>(Main("@- : tool = 1\n@- : jump forward label A = 1\n@- : tool = 7\n"
                          "@- : jump forward label A = 1\n@-\n@- label A\n")) == Lines{"0 1 1 7 7 7 in 0 out 7"});
}
