// Which variables and cells the analysis of one start keeps values of. Cells and variables that several programs see
// come first and have the same slot in all programs that the start can reach.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/interval.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

/// All variables of one program at one place of the text.
struct ValueState {
  std::vector<Interval> cells;
  bool reached = false;
};

/// True if `into` grew.
bool JoinInto(ValueState& into, const ValueState& from);

enum class SlotKind : std::uint8_t { kCell, kVariable, kLoopEnd };

struct Slot {
  SlotKind kind = SlotKind::kCell;
  std::uint32_t id = 0;      // SpaceId, VariableId or ForId
  std::uint32_t number = 0;  // of a cell
  bool level = false;        // cell of the program level
  bool changes = false;      // a subprogram that runs after motion may write it at any time
};

class SlotMap {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  SlotMap(const Module& module, const CallGraph& calls, ProgramId start, bool program_variables_visible);

  [[nodiscard]] const std::vector<ProgramId>& Programs() const { return programs_; }
  [[nodiscard]] bool Knows(ProgramId program) const { return locals_.contains(program.value); }
  [[nodiscard]] const std::vector<Slot>& Shared() const { return shared_; }
  [[nodiscard]] const std::vector<Slot>& LocalsOf(ProgramId program) const { return locals_.at(program.value); }
  [[nodiscard]] std::size_t SizeOf(ProgramId program) const { return shared_.size() + LocalsOf(program).size(); }
  [[nodiscard]] const Slot& At(ProgramId program, std::uint32_t slot) const {
    return slot < shared_.size() ? shared_[slot] : LocalsOf(program)[slot - shared_.size()];
  }
  [[nodiscard]] std::uint32_t Of(SpaceId space, std::uint32_t cell) const;
  [[nodiscard]] std::uint32_t Of(VariableId variable) const;
  [[nodiscard]] std::uint32_t Of(ForId loop) const;
  /// Some program assigns it, or passes it by reference.
  [[nodiscard]] bool IsWritten(VariableId variable) const;
  /// Calls whose program only the run knows, or block ranges, are among the programs.
  /// Blocks of the program may run in an order that the flow graph does not show.
  [[nodiscard]] bool IsOpaque(ProgramId program) const;
  /// Numbers that the programs write, in order: where widening stops.
  [[nodiscard]] const std::vector<double>& Landmarks() const { return landmarks_; }

 private:
  void Scan(ProgramId program);
  void ScanExpr(ProgramId program, ExprId id, bool written);
  void ScanWord(ProgramId program, WordId id);
  void ScanCall(ProgramId program, CallId id, bool modal);
  void MarkChanges(const CallGraph& calls);
  void AddVariable(ProgramId program, VariableId id);

  const Module& module_;
  bool program_variables_visible_;
  std::vector<ProgramId> programs_;
  std::vector<Slot> shared_;
  std::unordered_map<std::uint32_t, std::vector<Slot>> locals_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> local_variables_;  // by program, before numbering
  std::vector<std::uint64_t> shared_keys_;
  std::vector<std::uint32_t> opaque_;
  std::vector<std::uint32_t> modal_callees_;
  std::vector<std::pair<std::uint32_t, std::uint64_t>> writes_;           // program, key
  std::vector<std::pair<std::uint32_t, std::uint32_t>> computed_writes_;  // program, space
  std::vector<double> landmarks_;
  bool open_calls_ = false;
  bool open_modal_ = false;
};

}  // namespace ncport::ir::analysis
