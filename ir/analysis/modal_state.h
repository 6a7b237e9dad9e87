// Data flow of the modal state through blocks and calls: which mode of each group is in force at a block, where it is
// one on every way there. What a subprogram leaves unchanged stays what its caller had.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

struct ModalOptions {
  /// State in which main programs start; usually Machine::start.
  ModalState main_entry;
  /// State in which subprograms start that nothing in the module calls: unknown unless the user declares it ([entry]).
  ModalState sub_entry;
};

/// True for words with which a block may move, and so may run a modal call.
bool IsMotionWord(WordOp op);

/// Results for all programs of a module. Conservative: computed codes, calls that are not found, refused blocks and
/// block ranges make unknown what they may change.
class ModalFlow {
 public:
  /// `graphs` and `calls` of the same module.
  ModalFlow(const Module& module, const Machine& machine, const FlowGraphs& graphs, const CallGraph& calls,
            const ModalOptions& options);

  /// State on arrival at a block; groups that differ between the ways there are unknown.
  [[nodiscard]] ModalState Before(ProgramId program, BlockId block) const;
  /// State with the block's own settings: under which its other words run. Holds Motion::kTapFloating and kProbe, which
  /// are in force in one block only.
  [[nodiscard]] ModalState At(ProgramId program, BlockId block) const;
  [[nodiscard]] ModalState Entry(ProgramId program) const;
  /// False if no modal call is active on any way to the block: its moves run no other program. Where no way leads, one
  /// may be.
  [[nodiscard]] bool ModalCallPossible(ProgramId program, BlockId block) const;
  /// The one modal call whose program may run behind the block; none: there is none, or not one on every way.
  [[nodiscard]] CallId ActiveModalCall(ProgramId program, BlockId block) const;
  /// Whether a modal call is active on arrival at the block: on no way, on every way, or on some.
  enum class ModalCall : std::uint8_t { kNone, kActive, kUnknown };
  [[nodiscard]] ModalCall ModalCallBefore(ProgramId program, BlockId block) const;
  /// False if no way leads to the block from a start of its program that is ever taken.
  [[nodiscard]] bool Reached(ProgramId program, BlockId block) const;

 private:
  static constexpr std::size_t kGroups = 10;  // all of ModalState but the work offset
  // Values of a group besides its enumerators; 0 is unknown, as in the enumerators.
  static constexpr std::uint8_t kSame = 0xFF;   // as at the entry of the program
  static constexpr std::uint8_t kNever = 0xFE;  // no way leads here

  struct State {
    std::array<std::uint8_t, kGroups> groups;
    std::uint16_t work_offset;  // index in work_offsets_, 0 = unknown, or kSame16, kNever16
    std::uint32_t modal_call;   // see ModalCallState in the .cc
    bool operator==(const State&) const = default;
  };
  /// What a program does to the state of its caller.
  struct Summary {
    State after;      // at its returns
    State elsewhere;  // at returns to a target of the caller
    bool operator==(const Summary&) const = default;
  };
  /// The state on its way through the words of a block.
  struct Walk {
    State state;      // after the words so far
    State elsewhere;  // where a call returned to a target of this program
    State at;         // with the block's own settings
  };

  static State All(std::uint8_t value);
  static bool IsNever(const State& state) { return state.groups[0] == kNever; }
  static State Join(const State& a, const State& b);
  /// `change`, relative to an entry, when the entry was `before`.
  static State Apply(const State& change, const State& before);
  State Encode(const ModalState& state);
  [[nodiscard]] ModalState Decode(const State& state) const;
  std::uint16_t Intern(std::uint32_t number, std::uint32_t extension);

  void FindComputedGroups();
  /// Flows through one program from `start`; true if its summary changed.
  bool Analyse(ProgramId program, const State& start);
  Walk Through(BlockId block, const State& before);
  void ThroughCall(const Call& call, Walk& walk);
  [[nodiscard]] ProgramId ProgramOf(std::uint32_t known_call) const;
  /// False if the program, or one that it calls, starts or ends modal calls.
  [[nodiscard]] bool KeepsModalCall(ProgramId program) const;
  void ThroughModalCall(Walk& walk);
  void Change(const Word& word, State& state, std::uint8_t& one_block_motion);
  void ChangeWorkOffset(const Word& word, State& state);
  void ChangeModalCall(const Word& word, State& state) const;
  void FindModalPrograms();
  void FindEntries(const ModalOptions& options);
  /// Walks the programs from the callers down; those that nothing enters start with `sub_entry`, or wait.
  void EnterAll(const State* sub_entry);
  void Enter(ProgramId program, const State& state);

  const Module& module_;
  const Machine& machine_;
  const FlowGraphs& graphs_;
  const CallGraph& calls_;
  std::vector<WorkOffset> work_offsets_{WorkOffset{}};
  std::unordered_map<std::uint32_t, std::uint16_t> work_offset_index_;
  std::vector<State> before_;  // per block; first relative to the entry of its program, then absolute
  std::vector<State> at_;
  std::vector<Summary> summaries_;         // per program
  std::vector<State> entries_;             // per program, absolute
  std::vector<ProgramId> modal_programs_;  // that some modal call of the module names
  bool modal_calls_ = false;               // the module holds some
  bool entered_anew_ = false;              // an entry has grown in this sweep
  bool absolute_ = false;                  // second pass: callees are entered
  bool entries_changed_ = false;
  State computed_;  // unknown where a computed G code may change the group, else kSame
};

}  // namespace ncport::ir::analysis
