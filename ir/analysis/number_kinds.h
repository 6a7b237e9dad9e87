// How numbers of a program came about: whether two of them that should be equal are equal to the last bit. Flow is not
// followed: what is written to a variable anywhere counts everywhere.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "ir/analysis/call_graph.h"
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

  [[nodiscard]] NumberKind Of(ExprId expr) const;

 private:
  using CellKey = std::pair<std::uint32_t, std::uint32_t>;  // space, cell

  void Run();
  void Read(const Block& block);
  void ReadCall(const Call& call);
  void Give(ExprId place, NumberKind kind);
  void Give(VariableId variable, NumberKind kind);
  [[nodiscard]] NumberKind OfCell(SpaceId space, std::uint32_t cell) const;

  const Module& module_;
  const bool counters_round_;
  std::vector<NumberKind> variables_;
  std::map<CellKey, NumberKind> cells_;
  std::vector<NumberKind> any_cell_;  // per space: written to a computed number
  std::vector<NumberKind> whole_space_;  // per space: join of all cells
  std::set<CellKey> inputs_;             // read before written
  std::vector<bool> input_space_;        // per space: a computed number is read before it is written
  bool changed_ = false;
};

}  // namespace ncport::ir::analysis
