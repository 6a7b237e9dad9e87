// Which cell of the target each variable and each cell of the source gets (part of names_to_numbers.h).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "base/diag/sink.h"
#include "ir/analysis/call_graph.h"
#include "ir/module.h"
#include "ir/transform/cell_uses.h"
#include "ir/transform/names_to_numbers.h"

namespace ncport::ir::transform {

/// Cells that the variable fills: its elements.
std::uint32_t CellCount(const Variable& variable);

class CellAllocation {
 public:
  struct Home {
    std::uint32_t cell = 0;  // the first one
    bool common = false;     // one for all calls
  };

  /// `space`: the cells of the target. All but `space` must outlive the allocation.
  CellAllocation(const Module& module, const NamesToNumbersConfig& config, const CellUses& uses,
                 const analysis::CallGraph& calls, SpaceId space, diag::Sink& sink)
      : module_(module), config_(config), uses_(uses), calls_(calls), space_(space), sink_(sink) {}

  /// False if something got no place: each is a finding.
  bool Run();

  /// None: nothing names the variable.
  [[nodiscard]] std::optional<Home> HomeOf(VariableId variable) const;
  /// The cell that stands for a cell of a space of the source, if it moves.
  [[nodiscard]] std::optional<std::uint32_t> CellOf(std::uint32_t space, std::uint32_t cell) const;
  /// What is added to each index of a space of the source that moves as one piece.
  [[nodiscard]] std::optional<std::int64_t> OffsetOf(std::uint32_t space) const;
  /// Variables of the program live in the cells of its level.
  [[nodiscard]] bool OwnsLocals(ProgramId program) const;
  [[nodiscard]] const std::vector<CellMapping>& Map() const { return map_; }

 private:
  void KeepLocals();
  void ReservePins();
  void ReservePin(const NamesToNumbersConfig::Pin& pin, std::string_view name, std::uint32_t count, ProgramId owner);
  [[nodiscard]] const NamesToNumbersConfig::Pin* PinOf(ProgramId program, std::string_view name) const;
  void PlaceIndexedSpaces();
  [[nodiscard]] SourceRange PlaceOfIndex(SpaceId space) const;
  void PlaceCells();
  void ChooseAllLetters();
  void ChooseLetters(const std::vector<ProgramId>& parts);
  [[nodiscard]] bool ArgumentsAreHarmless(ProgramId program, std::uint32_t position) const;
  void PlaceProgram(ProgramId program);
  bool PlaceParameter(ProgramId program, VariableId id);
  void PlaceLocal(ProgramId program, VariableId id);
  bool TakeLocal(ProgramId program, std::uint32_t count, std::uint32_t& cell);
  bool TakeCommon(std::uint32_t count, std::uint32_t& cell);
  void Add(CellMapping mapping);

  void Refuse(const SourceRange& at, std::string_view what);
  [[nodiscard]] static SourceRange PlaceOf(const Variable& variable) {
    return {variable.file, variable.line, variable.begin, variable.begin + variable.length};
  }
  /// Its value is one for all calls of all programs.
  [[nodiscard]] bool IsShared(VariableId id) const {
    const Scope scope = module_.variables[id].scope;
    return scope == Scope::kChannel || scope == Scope::kGlobal ||
           (scope == Scope::kProgram && uses_.seen_elsewhere.contains(id.value));
  }

  const Module& module_;
  const NamesToNumbersConfig& config_;
  const CellUses& uses_;
  const analysis::CallGraph& calls_;
  SpaceId space_;
  diag::Sink& sink_;

  std::map<std::uint32_t, Home> homes_;                           // VariableId
  std::map<std::uint64_t, std::uint32_t> cells_;                  // CellUses::Key of the source -> cell
  std::map<std::uint32_t, std::int64_t> offsets_;                 // source space reached by an index -> offset
  std::map<std::uint32_t, std::set<std::uint32_t>> used_locals_;  // ProgramId -> cells taken
  std::set<std::uint32_t> used_common_;
  std::set<std::uint32_t> pinned_common_;
  std::map<std::uint32_t, ArgumentLetter> letters_;  // VariableId of a parameter
  std::set<std::uint32_t> unread_parts_;             // parameters that a part of a cut program gets on no way
  std::vector<CellMapping> map_;
  bool ok_ = true;
};

}  // namespace ncport::ir::transform
