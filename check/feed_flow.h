// Where a feed is in force, on which ways, and what needs one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check/known_ways.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/analysis/forward_flow.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::check {

/// Ways to a place, by the feed that they bring along.
struct FeedState {
  std::uint16_t ways = 0;   // kNone .. kUnknown, and the same << kPass behind a pass of the loop that is looked at
  std::uint8_t cycles = 0;  // canned cycles in force: kNoCycle ..

  static constexpr std::uint16_t kNone = 1;  // nothing since the start has set one
  static constexpr std::uint16_t kZero = 2;  // F0 was the last one
  static constexpr std::uint16_t kIdle = 4;  // none, if a loop that sets one makes no pass, or the caller's mode is so
  static constexpr std::uint16_t kSet = 8;
  static constexpr std::uint16_t kUnknown = 16;  // callers, codes or programs that are not known may have set one
  static constexpr std::uint16_t kChanged = 32;  // a change of the kind of feed has dropped it
  static constexpr std::uint16_t kAll = 63;
  /// Ways that surely have none.
  static constexpr std::uint16_t kLacks = kNone | kZero | kChanged;
  static constexpr unsigned kPass = 8;

  static constexpr std::uint8_t kNoCycle = 1;
  static constexpr std::uint8_t kFeedCycle = 2;    // drills or cuts by F at each place
  static constexpr std::uint8_t kThreadCycle = 4;  // F is its lead
  static constexpr std::uint8_t kOtherCycle = 8;
};

/// What of a block needs a feed.
enum class FeedNeed : std::uint8_t { kNothing, kMove, kLead, kCycle, kCycleLead, kCall, kModalCall };

struct NeededFeed {
  FeedNeed need = FeedNeed::kNothing;
  bool certain = true;             // false: some way through the block or the called program does without
  const ir::Word* word = nullptr;  // that needs it
  ir::ProgramId program;           // kCall, kModalCall: the cycle
};

/// Client of ForwardFlow. A move that needs a feed ends the ways that have none: the control stops there.
class FeedFlow {
 public:
  using State = FeedState;

  FeedFlow(const ir::analysis::FlowSources& sources, const KnownWays& ways);

  State Entry(ir::ProgramId program) const;
  static State Unknown(ir::ProgramId program);
  static bool Join(ir::BlockId block, State& into, const State& from);
  void Transfer(ir::ProgramId program, ir::BlockId id, State& state) const;
  bool Along(ir::ProgramId program, ir::BlockId id, const ir::analysis::Edge& edge, State& state) const;

  /// The state with the settings of the block: under which it moves.
  void Set(ir::ProgramId program, ir::BlockId id, State& state) const;
  [[nodiscard]] NeededFeed NeedOf(ir::ProgramId program, ir::BlockId id, const State& state) const;

 private:
  /// What a program of the library does when no feed is in force.
  struct Use {
    bool may = false;   // some way moves by feed
    bool must = false;  // every way does
  };

  [[nodiscard]] bool ChangesLead(ir::ProgramId program, ir::BlockId id) const;
  void ChangeKind(ir::ProgramId program, ir::BlockId id, State& state) const;
  void FindUses();
  [[nodiscard]] Use UseOf(ir::ProgramId program) const;
  [[nodiscard]] NeededFeed OwnNeed(ir::ProgramId program, ir::BlockId id, const State& state) const;
  [[nodiscard]] NeededFeed CycleNeed(const ir::Block& block, const State& state) const;
  [[nodiscard]] bool SetsFeed(const ir::Block& block) const;

  const ir::Module& module_;
  const ir::analysis::FlowSources& sources_;
  const KnownWays& ways_;
  std::vector<Use> uses_;  // per program
};

}  // namespace ncport::check
