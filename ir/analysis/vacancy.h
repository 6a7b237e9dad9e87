// Which numbered variables may be empty (vacant) at a block, and which may hold a number: data flow through jumps,
// loops, tests for emptiness and calls.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/forward_flow.h"
#include "ir/analysis/index_range.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

struct VacancyConfig {
  /// Common cells that hold a number before the run, as the user declares; none = no cell.
  std::function<bool(std::uint32_t cell)> holds_number;
  /// Arguments that every call of a program without callers here gives, as the user declares; none = none. Taken only
  /// where the program does not ask itself whether it has the value.
  std::function<bool(ProgramId program, std::uint32_t cell)> given;
};

/// Cells of spaces whose numbers start empty are tracked, each under an index. Values that a pass makes afterwards may
/// be asked for too; the flow is that of the module as it came.
class Vacancy {
 public:
  // What a cell may hold, as bits.
  static constexpr std::uint8_t kEmpty = 1, kNumber = 2, kUnsure = kEmpty | kNumber;
  static constexpr std::uint8_t kFromEntry = 4;  // what it held before the program (local) or the run (common)
  using State = std::vector<std::uint8_t>;       // per tracked cell

  /// The flow runs at once.
  Vacancy(const Module& module, const Machine& machine, const FlowGraphs& graphs, const CallGraph& calls,
          VacancyConfig config);

  /// None: no run comes to the block.
  [[nodiscard]] const State* Before(BlockId block) const { return flow_.Before(block); }
  /// What holds behind a word, for the words behind it in its block.
  void ThroughWord(ProgramId program, BlockId block, WordId word, State& state) const;
  /// What a value may be: kEmpty, kNumber or kUnsure; 0 where no run gets.
  [[nodiscard]] std::uint8_t ClassOf(ExprId value, const State& state) const;
  /// The expression whose emptiness is that of `value`.
  [[nodiscard]] ExprId Bare(ExprId value) const;
  /// Index of the tracked cell that `value` is, but for what hides no emptiness.
  [[nodiscard]] std::optional<std::size_t> IndexOf(ExprId value) const;
  /// Calls `visit` with the index of every cell that `#[e]` may reach; false when those are not known.
  template <class Visit>
  bool Reached(const Expr& expr, Visit visit) const;

  [[nodiscard]] std::size_t Size() const { return cells_.size(); }
  [[nodiscard]] std::uint32_t CellOf(std::size_t index) const { return cells_[index].second; }
  [[nodiscard]] bool IsLocal(std::size_t index) const { return local_[index] != 0; }
  [[nodiscard]] bool IsTracked(SpaceId space) const {
    const Space& record = module_.spaces[space];
    return record.type == Type::kNumber && record.start == StartValue::kVacant;
  }
  /// The space of locals that calls start anew; none: there is none.
  [[nodiscard]] SpaceId LocalSpace() const { return local_space_; }
  /// Arguments that were taken for given (VacancyConfig::given).
  [[nodiscard]] const std::set<std::pair<ProgramId, std::uint32_t>>& TakenForGiven() const { return taken_for_given_; }

  // For ForwardFlow.
  State Entry(ProgramId program);
  [[nodiscard]] State Unknown(ProgramId) const { return State(cells_.size(), kUnsure | kFromEntry); }
  static bool Join(BlockId, State& into, const State& from);
  void Transfer(ProgramId program, BlockId block, State& state) const;
  [[nodiscard]] std::optional<State> Into(const CallSite& site, CallMoment moment, const State& at) const;
  [[nodiscard]] State Back(const CallSite& site, const State& at, const State& exit) const;
  bool Along(ProgramId program, BlockId block, const Edge& edge, State& state) const;

 private:
  /// A block that asks whether a cell is empty: on the ways out of it that is known.
  struct Test {
    std::optional<std::size_t> cell;
    bool empty = false;  // it asks whether the cell is empty, not whether it holds a number
    EdgeKind holds = EdgeKind::kNext, fails = EdgeKind::kNext;
  };
  [[nodiscard]] Test TestOf(BlockId block) const;
  void FindCells();
  void FindWrites();
  void ThroughAssign(const Word& word, State& state) const;

  const Module& module_;
  const CallGraph& calls_;
  VacancyConfig config_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> index_;  // space, cell
  std::vector<std::pair<SpaceId, std::uint32_t>> cells_;
  std::vector<std::uint8_t> local_;
  std::vector<std::set<std::size_t>> writes_;  // per program, below it too; locals of other levels are not among them
  std::set<std::uint32_t> asked_;              // cells that a program compares with an empty value
  std::set<std::pair<ProgramId, std::uint32_t>> taken_for_given_;
  SpaceId local_space_;
  ForwardFlow<Vacancy> flow_;
};

template <class Visit>
bool Vacancy::Reached(const Expr& expr, Visit visit) const {
  const auto range = IndexRangeOf(module_, ExprId{std::size_t{expr.a}});
  if (!range) return false;
  for (std::uint32_t cell = range->first; cell <= range->last; ++cell) {
    bool known = false;
    for (const SpaceId space : module_.spaces.Ids()) {
      const auto found = index_.find({space.value, cell});
      if (found == index_.end()) continue;
      visit(found->second);
      known = true;
    }
    if (!known) return false;
  }
  return true;
}

}  // namespace ncport::ir::analysis
