// A module prepared once for many runs: places of variables, jump targets, what each block holds.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "exec/run.h"
#include "ir/analysis/labels.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::exec {

/// Where the cells of a variable are: in the frame of its program, or at a fixed address.
struct VariableSlot {
  bool in_frame = false;
  std::uint32_t offset = 0;
  std::uint32_t count = 1;  // elements
};

/// Cells of a numbered space: at a fixed address, or at an offset in the cells of a call level.
struct SpaceSlot {
  bool per_level = false;
  std::uint32_t offset = 0;
};

/// What a block needs from the evaluator, so that the loop skips what is not there.
enum BlockUse : std::uint16_t {
  kUseImmediate = 1U << 0U,  // phases that occur: bit = 1 << Phase
  kUseSetting = 1U << 1U,
  kUseBefore = 1U << 2U,
  kUseMotion = 1U << 3U,
  kUseAfter = 1U << 4U,
  kUseFlow = 1U << 5U,
  kUseLast = 1U << 6U,
  kUseMark = 1U << 7U,     // a structure mark stands in it
  kUseRefused = 1U << 8U,  // never executed: finding
  kUseTooDeep = 1U << 9U,  // an expression nested beyond what is evaluated
};

class Linked {
 public:
  /// The module must be verified, its names resolved, and outlive this object, as must the machine.
  Linked(const ir::Module& module, const ir::Machine& machine);

  [[nodiscard]] const ir::Module& module() const { return *module_; }     // NOLINT(readability-identifier-naming)
  [[nodiscard]] const ir::Machine& machine() const { return *machine_; }  // NOLINT(readability-identifier-naming)

  [[nodiscard]] std::uint16_t UseOf(ir::BlockId block) const { return uses_[block.value]; }
  [[nodiscard]] const VariableSlot& SlotOf(ir::VariableId variable) const { return variable_slots_[variable.value]; }
  [[nodiscard]] const SpaceSlot& SlotOf(ir::SpaceId space) const { return space_slots_[space.value]; }
  /// Frame offset of the end value of a counting loop.
  [[nodiscard]] std::uint32_t ForSlot(ir::ForId loop) const { return for_slots_[loop.value]; }
  /// Cells of the frame of a program besides those of its level.
  [[nodiscard]] std::uint32_t FrameSize(ir::ProgramId program) const;
  [[nodiscard]] std::uint32_t LevelCells() const { return level_cells_; }
  [[nodiscard]] std::uint32_t FixedCells() const { return fixed_cells_; }
  /// Fixed cells that may hold texts: named variables come before the numbered spaces.
  [[nodiscard]] std::uint32_t NamedCells() const { return named_cells_; }
  /// A fresh frame of a program, and the fixed named cells: zeros of their types.
  [[nodiscard]] std::span<const Value> FrameOf(ir::ProgramId program) const { return frames_[program.value]; }
  [[nodiscard]] std::span<const Value> FixedValues() const { return fixed_values_; }
  /// Fixed cells for the frame of a modal subprogram, which outlives the call: one place more than may be active at
  /// once.
  [[nodiscard]] std::uint32_t ModalPlaces() const { return modal_places_; }
  [[nodiscard]] std::uint32_t ModalPlace(std::uint32_t index) const { return modal_offset_ + index * modal_size_; }
  [[nodiscard]] std::uint32_t LargestBlock() const { return largest_block_; }
  /// A tool word changes the tool at once; else it waits for the change word. See ir/analysis/tool_change.h.
  [[nodiscard]] bool ToolWordChanges() const { return tool_word_changes_; }
  [[nodiscard]] ir::ProgramId ProgramOf(ir::BlockId block) const;

  /// Labels and numbers of a program; null for programs that no jump, range or return looks into.
  [[nodiscard]] const ir::analysis::LabelTable* LabelsOf(ir::ProgramId program) const {
    return labels_[program.value].get();
  }
  /// The target of a jump as seen from its block with no skip level on, found when linking. Invalid: none, or computed.
  [[nodiscard]] ir::BlockId StaticTarget(ir::JumpId jump) const { return static_targets_[jump.value]; }

 private:
  void LayOutVariables();
  void ClassifyBlocks();
  void IndexTargets();
  void ResolveJumps(ir::ProgramId program);

  const ir::Module* module_;
  const ir::Machine* machine_;
  std::vector<std::uint16_t> uses_;
  std::vector<VariableSlot> variable_slots_;
  std::vector<SpaceSlot> space_slots_;
  std::vector<std::uint32_t> for_slots_;
  std::vector<std::vector<Value>> frames_;  // per program
  std::vector<std::uint8_t> oversized_;     // per program: frame beyond every budget
  std::vector<Value> fixed_values_;
  std::vector<std::uint32_t> program_of_;                          // per block; only when several programs
  std::vector<std::unique_ptr<ir::analysis::LabelTable>> labels_;  // per program
  std::vector<ir::BlockId> static_targets_;
  std::uint32_t level_cells_ = 0;
  std::uint32_t fixed_cells_ = 0;
  std::uint32_t named_cells_ = 0;
  std::uint32_t modal_places_ = 0;
  std::uint32_t modal_offset_ = 0;
  std::uint32_t modal_size_ = 0;
  std::uint32_t largest_block_ = 0;
  bool tool_word_changes_ = false;
};

/// Runs `options.entry` of a linked module. All state is in this call: runs may stand in several threads.
RunResult Run(const Linked& linked, const RunOptions& options, Environment& environment, EventSink& events,
              diag::Sink& sink, Coverage* coverage = nullptr);

}  // namespace ncport::exec
