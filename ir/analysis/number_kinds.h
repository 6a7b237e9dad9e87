// How numbers of a program came about: whether two of them that should be equal are equal to the last bit. Flow is
// followed inside a program; at its entry and behind calls a variable is what any program writes to it.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

enum class NumberKind : std::uint8_t {
  kNever,     // nothing gives it a value
  kWhole,     // a whole number, counted or rounded
  kWritten,   // digits of a program or an operator, at most twelve
  kComputed,  // the result of arithmetic: its last bits depend on the way
};

/// Two numbers that are whole or written are equal exactly when they are meant to be: they differ by more than 1e-12 of
/// their size or not at all. Whole numbers are taken to stay below 1e12.
constexpr bool IsExact(NumberKind kind) { return kind < NumberKind::kComputed; }

class NumberKinds {
 public:
  /// `counters_round`: the start of a FOR loop is rounded (Machine::for_counter_rounds). Expressions that are added to
  /// the module afterwards are asked for as well; variables that are added are computed.
  NumberKinds(const Module& module, const CallGraph& calls, bool counters_round);

  /// Wherever it stands.
  [[nodiscard]] NumberKind Of(ExprId expr) const { return Of(expr, nullptr); }
  /// Follows the program now, before a pass changes its words.
  void Prepare(ProgramId program) { Follow(program); }
  /// In a block of `program`, as the module had it.
  [[nodiscard]] NumberKind At(ProgramId program, BlockId block, ExprId expr);

 private:
  using CellKey = std::pair<std::uint32_t, std::uint32_t>;  // space, cell
  static constexpr std::uint32_t kNoSpace = 0xFFFFFFFFU;    // of a slot that is a variable
  using State = std::vector<NumberKind>;                    // by slot
  /// Cells and variables that a program assigns, followed through it.
  struct Flow {
    ProgramId program;
    std::map<CellKey, std::size_t> slots;  // kNoSpace, variable: a variable
    std::map<BlockId, State> before, after;
  };

  void Run();
  [[nodiscard]] NumberKind Of(ExprId expr, const State* state) const;
  [[nodiscard]] const NumberKind* Slot(const Expr& place, const State* state) const;
  void Follow(ProgramId program);
  [[nodiscard]] State Through(const Block& block, State state) const;
  [[nodiscard]] NumberKind Everywhere(const CellKey& slot) const;
  void Read(const Block& block);
  void ReadCall(const Call& call);
  void Give(ExprId place, NumberKind kind);
  void Give(VariableId variable, NumberKind kind);
  [[nodiscard]] NumberKind OfCell(SpaceId space, std::uint32_t cell) const;

  const Module& module_;
  FlowGraphs graphs_;
  Flow flow_;           // of one program at a time
  bool modal_ = false;  // a modal call may run behind any block
  const bool counters_round_;
  std::vector<NumberKind> variables_;
  std::map<CellKey, NumberKind> cells_;
  std::vector<NumberKind> any_cell_;     // per space: written to a computed number
  std::vector<NumberKind> whole_space_;  // per space: join of all cells
  std::set<CellKey> inputs_;             // read before written
  std::vector<bool> input_space_;        // per space: a computed number is read before it is written
  bool changed_ = false;
};

}  // namespace ncport::ir::analysis
