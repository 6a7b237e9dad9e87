// Forward data flow through all programs of a module: the one solver for what holds on arrival at a block.
//
// A client says what a state is, how two ways join, and what the words of one block do to it. The solver owns the ways
// a run can take, so that all clients agree on them:
//
//   blocks      every edge of the flow graph is taken; a block that may be left out, as a whole (skip level) or from a
//               word on (kWhen, kSkipRest), joins what it found with what it makes.
//   starts      a run starts in main programs, and in what none of those comes to: from outside, callers first.
//   calls       act behind the words of their block. The callee is entered with the state there, and behind the call
//               holds what it leaves; a callee with no way back has nothing behind its call. Programs are entered with
//               the join of all calls, so circles of calls end like loops do. A block that also jumps or ends may leave
//               before its call: such edges carry both states.
//   inside      calls that name a block enter at every block with a label or number.
//   passes      of a call start with what the pass before left.
//   modal calls run behind each block with motion words where ModalFlow does not exclude them, or not: both. Their
//               program may run again, with what its own run before left.
//   unknown     programs, ranges of blocks and opaque graphs lack edges: behind such a call, and in every block of an
//               opaque program, anything may hold (Client::Unknown).
//   jumps       a computed one goes to every block with a label or number, a return to a target of the caller to those
//               of the caller (its calls have such an edge).
//   exits       returns and the end of the text lead back to the caller, an end word where the machine says so. In a
//               main program a return starts it again where the machine says so, and a return to a target is a jump.
//   alarms      and jumps whose target is missing end the run: nothing follows.
//
// Result: for each block a state that covers every run that comes there, or none if no run does. It is the least one,
// if Join only climbs and Transfer keeps order; states must climb a finite number of steps, which bounds the work to
// steps * (blocks + edges + calls). A refused block never runs and its module is not translated: what it means is the
// client's choice.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ir/analysis/flow_analyses.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

/// When a call takes its state from the caller.
enum class CallMoment : std::uint8_t {
  kCall,
  kModalStart,  // where a modal call is written: it does not run there, but its arguments are those of here
  kModalRun,    // behind a block with motion
};

/// What a block does besides its words' own effects.
struct BlockWays {
  bool conditional = false;  // it, or a part of its words, may be left out
  bool calls = false;        // holds calls, or starts a modal call
  bool branches = false;     // holds other words of flow than calls
  bool moves = false;        // holds motion words: a modal call may run behind it
};
BlockWays WaysOf(const Module& module, const Block& block);

/// Client:
///   using State = ...;                                          copyable
///   State Entry(ProgramId);                                     of a program in which a run starts
///   State Unknown(ProgramId);                                   anything may hold; Join with it gives it
///   bool Join(BlockId, State& into, const State& from);         true if `into` changed; at exits the block is none
///   void Transfer(ProgramId, BlockId, State&);                  the words of a block but its calls, as if all run
/// and if it needs them:
///   std::optional<State> Into(const CallSite&, CallMoment, const State& at);  for the callee; none: does not enter it.
///                                                               Else the state itself, and none for kModalStart
///   State Back(const CallSite&, const State& at, const State& exit);          behind the call. Else `exit`. The callee
///                                                               may be none; its exit is Unknown then
///   bool Along(ProgramId, BlockId, const Edge&, State&);        what is known on one way out; false: no run takes it
template <class Client>
class ForwardFlow {
 public:
  using State = typename Client::State;

  ForwardFlow(const FlowSources& sources, Client& client)
      : module_(sources.module),
        machine_(sources.machine),
        graphs_(sources.graphs),
        calls_(sources.calls),
        modal_(sources.modal),
        client_(client),
        program_of_(module_.blocks.Size()),
        in_(module_.blocks.Size()),
        waiting_(module_.blocks.Size(), false),
        entries_(module_.programs.Size()),
        exits_(module_.programs.Size()),
        computed_(module_.programs.Size()),
        callers_(module_.programs.Size()),
        runs_modal_(module_.blocks.Size(), false) {}

  void Run() {
    for (const ProgramId program : module_.programs.Ids()) {
      for (const BlockId block : module_.programs[program].blocks) program_of_[block.value] = program;
    }
    for (const CallSite& site : calls_.AllSites()) {
      if (site.modal && !IsModal(site.callee)) modal_callees_.push_back(site);
      if (site.callee.Valid() && !site.modal) callers_[site.callee.value].push_back(site.block);
    }
    for (const ProgramId program : module_.programs.Ids()) {
      if (module_.programs[program].kind == ProgramKind::kMain) Enter(program, client_.Entry(program));
    }
    Settle();
    // What nothing comes to is started from outside; of a circle of programs, any of them.
    const std::vector<ProgramId>& order = calls_.BottomUp();
    for (std::size_t end = order.size(); end > 0;) {
      std::size_t begin = end - 1;
      while (begin > 0 && calls_.GroupOf(order[begin - 1]) == calls_.GroupOf(order[end - 1])) --begin;
      const std::span<const ProgramId> circle{order.data() + begin, order.data() + end};
      end = begin;
      if (std::ranges::any_of(circle, [&](ProgramId program) { return Entry(program) != nullptr; })) continue;
      for (const ProgramId program : circle) Enter(program, client_.Entry(program));
      Settle();
    }
  }

  /// On arrival; none where no run comes.
  [[nodiscard]] const State* Before(BlockId block) const { return Find(in_, block.value); }
  /// On arrival at the program, from all its callers.
  [[nodiscard]] const State* Entry(ProgramId program) const { return Find(entries_, program.value); }
  /// Where the program goes back to its caller.
  [[nodiscard]] const State* Exit(ProgramId program) const { return Find(exits_, program.value); }

 private:
  using States = std::vector<std::optional<State>>;

  static const State* Find(const States& states, std::uint32_t index) {
    return index < states.size() && states[index] ? &*states[index] : nullptr;
  }

  /// True if it changed.
  bool Join(BlockId block, std::optional<State>& into, const State& from) {
    if (into) return client_.Join(block, *into, from);
    into = from;
    return true;
  }

  void Settle() {
    while (!queue_.empty()) {
      std::ranges::pop_heap(queue_, std::greater<>{});
      const BlockId block{std::size_t{queue_.back()}};
      queue_.pop_back();
      waiting_[block.value] = false;
      Visit(block);
    }
  }

  [[nodiscard]] bool IsModal(ProgramId program) const {
    return std::ranges::any_of(modal_callees_, [&](const CallSite& site) { return site.callee == program; });
  }

  void Push(BlockId block) {
    if (!in_[block.value] || waiting_[block.value]) return;
    waiting_[block.value] = true;
    // Blocks in the order of the text: it is the reverse post-order but for jumps back.
    queue_.push_back(block.value);
    std::ranges::push_heap(queue_, std::greater<>{});
  }

  void Arrive(BlockId block, const State& state) {
    if (Join(block, in_[block.value], state)) Push(block);
  }

  void ArriveAtTargets(ProgramId program, const State& state) {
    // All computed jumps of a program share their targets: one state for them keeps the work linear.
    if (!Join({}, computed_[program.value], state)) return;
    const State joined = *computed_[program.value];
    for (const BlockId target : graphs_.Of(program).ComputedTargets()) Arrive(target, joined);
  }

  void Enter(ProgramId program, const State& state) {
    if (!Join({}, entries_[program.value], state)) return;
    const Cfg& graph = graphs_.Of(program);
    if (graph.Blocks().Empty()) return Leave(program, *entries_[program.value]);
    if (!graph.Opaque()) return Arrive(graph.Blocks()[0], *entries_[program.value]);
    const State unknown = client_.Unknown(program);
    for (const BlockId block : graph.Blocks()) Arrive(block, unknown);
    Leave(program, unknown);
  }

  /// At its start, or at a block that the call names.
  void EnterBy(const Call& call, ProgramId program, const State& state) {
    const bool inside = call.form == CallForm::kBlockRange || call.from_block;
    if (!inside || graphs_.Of(program).Opaque()) return Enter(program, state);
    ArriveAtTargets(program, state);
  }

  void Leave(ProgramId program, const State& state) {
    if (!Join({}, exits_[program.value], state)) return;
    for (const BlockId block : callers_[program.value]) Push(block);
    if (!IsModal(program)) return;
    for (const BlockId block : modal_runs_) Push(block);
  }

  /// The state behind the call; none if there is no way back yet.
  std::optional<State> Through(const CallSite& site, CallMoment moment, const State& at) {
    if (!site.callee.Valid()) return Back(site, at, client_.Unknown(site.caller));
    const std::optional<State> entry = Into(site, moment, at);
    const Call& call = module_.calls[site.call];
    if (entry) EnterBy(call, site.callee, *entry);
    if (call.form == CallForm::kBlockRange) return Back(site, at, client_.Unknown(site.callee));
    const std::optional<State> exit = exits_[site.callee.value];
    if (!exit) return std::nullopt;
    State behind = Back(site, at, *exit);
    const bool again = call.passes.Valid() || moment == CallMoment::kModalRun;
    if (entry && again) {
      // With its own locals kept, or with fresh ones.
      EnterBy(call, site.callee, *exit);
      if (const std::optional<State> next = Into(site, moment, behind)) EnterBy(call, site.callee, *next);
    }
    if (graphs_.ReturnsToTarget(site.callee)) ArriveAtTargets(site.caller, behind);
    return behind;
  }

  std::optional<State> Into(const CallSite& site, CallMoment moment, const State& at) {
    if constexpr (requires { client_.Into(site, moment, at); }) {
      return client_.Into(site, moment, at);
    } else {
      return moment == CallMoment::kModalStart ? std::nullopt : std::optional<State>(at);
    }
  }

  State Back(const CallSite& site, const State& at, const State& exit) {
    if constexpr (requires { client_.Back(site, at, exit); }) {
      return client_.Back(site, at, exit);
    } else {
      return exit;
    }
  }

  /// The calls of a block, one behind the other.
  std::optional<State> ThroughCalls(ProgramId program, BlockId block, State state) {
    for (const WordId id : module_.blocks[block].words) {
      const Word& word = module_.words[id];
      const bool modal = word.op == WordOp::kModalCall;
      if ((word.op != WordOp::kCall && !modal) || !module_.calls.Contains(word.Extra<CallId>())) continue;
      const auto call = word.Extra<CallId>();
      const CallSite site{program, block, id, call, module_.calls[call].program, modal};
      if (modal) {
        if (!site.callee.Valid()) continue;
        if (const auto entry = Into(site, CallMoment::kModalStart, state)) Enter(site.callee, *entry);
        continue;
      }
      std::optional<State> behind = Through(site, CallMoment::kCall, state);
      if (!behind) return std::nullopt;
      state = std::move(*behind);
    }
    return state;
  }

  /// Modal calls that may run behind a block with motion. A run takes nothing from where the call was written: one a
  /// program is enough.
  void ThroughModalCalls(ProgramId program, BlockId block, State& state) {
    if (modal_callees_.empty() || (modal_ != nullptr && !modal_->ModalCallPossible(program, block))) return;
    if (!runs_modal_[block.value]) modal_runs_.push_back(block);
    runs_modal_[block.value] = true;
    const CallId active = modal_ != nullptr ? modal_->ActiveModalCall(program, block) : CallId{};
    const State before = state;
    for (CallSite site : modal_callees_) {
      if (active.Valid() && site.callee != module_.calls[active].program) continue;
      site.caller = program;
      const std::optional<State> behind = Through(site, CallMoment::kModalRun, before);
      if (behind) static_cast<void>(client_.Join({}, state, *behind));
    }
  }

  void Visit(BlockId block) {
    const ProgramId program = program_of_[block.value];
    const BlockWays ways = WaysOf(module_, module_.blocks[block]);
    std::optional<State> elsewhere;  // where not all of the block runs
    if (ways.conditional) elsewhere = in_[block.value];
    std::optional<State> after = in_[block.value];
    client_.Transfer(program, block, *after);
    if (ways.calls) {
      if (ways.branches) Join({}, elsewhere, *after);
      after = ThroughCalls(program, block, std::move(*after));
    }
    if (after && ways.moves) ThroughModalCalls(program, block, *after);
    if (elsewhere) Join({}, after, *elsewhere);
    if (!after) return;
    for (const Edge& edge : graphs_.Of(program).Successors(block)) {
      if constexpr (requires { client_.Along(program, block, edge, *after); }) {
        State state = *after;
        if (client_.Along(program, block, edge, state)) Go(program, edge, state);
      } else {
        Go(program, edge, *after);
      }
    }
  }

  void Go(ProgramId program, const Edge& edge, const State& state) {
    const bool main = module_.programs[program].kind == ProgramKind::kMain;
    switch (edge.kind) {
      case EdgeKind::kComputed:
        return ArriveAtTargets(program, state);
      case EdgeKind::kReturn:
        if (main && machine_.return_in_main_restarts) Arrive(module_.programs[program].blocks[0], state);
        return Leave(program, state);
      case EdgeKind::kReturnToTarget:
        if (main) ArriveAtTargets(program, state);
        return Leave(program, state);
      case EdgeKind::kEnd:
        if (machine_.end_in_called_program_returns) Leave(program, state);
        return;
      case EdgeKind::kTextEnd:
        return Leave(program, state);
      case EdgeKind::kAlarm:
      case EdgeKind::kMissing:
        return;
      case EdgeKind::kNext:
      case EdgeKind::kJump:
      case EdgeKind::kArm:
      case EdgeKind::kFalse:
      case EdgeKind::kThenEnd:
      case EdgeKind::kBack:
      case EdgeKind::kPart:
      case EdgeKind::kPartEnd:
      case EdgeKind::kRestart:
        return Arrive(edge.to, state);
    }
  }

  const Module& module_;
  const Machine& machine_;
  const FlowGraphs& graphs_;
  const CallGraph& calls_;
  const ModalFlow* modal_;
  Client& client_;
  std::vector<ProgramId> program_of_;  // per block
  States in_;                          // per block
  std::vector<bool> waiting_;          // per block: stands in the queue
  std::vector<std::uint32_t> queue_;   // a heap, the first of the text on top
  States entries_, exits_, computed_;  // per program
  std::vector<std::vector<BlockId>> callers_;
  std::vector<CallSite> modal_callees_;  // one a program
  std::vector<BlockId> modal_runs_;      // blocks behind which modal calls may run
  std::vector<bool> runs_modal_;         // the same, per block
};

}  // namespace ncport::ir::analysis
