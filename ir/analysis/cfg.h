// The flow graph of one program over its blocks, computed when asked for. Every way that a run can take is an edge;
// some edges no run takes (conditions are not evaluated, skip levels are on and off, a repeated part ends like any
// other pass).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/text_buffer.h"
#include "ir/analysis/labels.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

enum class EdgeKind : std::uint8_t {
  kNext,  // the block behind
  kJump,
  kArm,      // of a switch
  kFalse,    // condition of IF, WHILE, FOR, UNTIL does not hold
  kThenEnd,  // from ELSE to its end
  kBack,     // from the end of a loop to its start
  kPart,     // into a repeated part, and from its end to its start
  kPartEnd,  // from the last block of a repeated part to the block behind the RepeatPart word
  kRestart,
  kComputed,  // to any block of Cfg::ComputedTargets(); `to` is none
  // Out of the program; `to` is none.
  kEnd,  // end word
  kReturn,
  kReturnToTarget,  // to a label or block number of the caller
  kAlarm,
  kTextEnd,  // behind the last block
  kMissing,  // the target does not exist: alarm when the jump is taken
};

struct Edge {
  BlockId to;
  EdgeKind kind = EdgeKind::kNext;
  bool operator==(const Edge&) const = default;
};

class Cfg {
 public:
  /// `labels` of the same program. `calls_may_return_elsewhere`: some program that this one calls returns to a label of
  /// its caller (see ReturnsToTarget), so calls have a kComputed edge.
  Cfg(const Module& module, ProgramId program, const LabelTable& labels, bool calls_may_return_elsewhere);

  [[nodiscard]] IdRange<BlockId> Blocks() const { return blocks_; }
  /// In the order of the words of the block, kNext last.
  [[nodiscard]] std::span<const Edge> Successors(BlockId block) const;
  /// Blocks with an edge to this one. Computed jumps are not among them.
  [[nodiscard]] std::span<const BlockId> Predecessors(BlockId block) const;
  /// From the start of the program; conditions count as open.
  [[nodiscard]] bool Reachable(BlockId block) const { return reachable_[block.value - blocks_.begin] != 0; }
  /// Where computed jumps may go: every block with a label or number.
  [[nodiscard]] const std::vector<BlockId>& ComputedTargets() const { return computed_targets_; }
  /// True if a repeated part starts or ends where only the run knows: any block may then be followed by any other.
  [[nodiscard]] bool Opaque() const { return opaque_; }

 private:
  struct Builder;
  void FindReachable();

  IdRange<BlockId> blocks_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> edge_starts_;  // per block, and one behind
  std::vector<BlockId> predecessors_;
  std::vector<std::uint32_t> predecessor_starts_;
  std::vector<BlockId> computed_targets_;
  std::vector<std::uint8_t> reachable_;
  bool opaque_ = false;
};

/// True if the program holds a return to a label or block number of its caller.
bool ReturnsToTarget(const Module& module, ProgramId program);

/// Graphs of all programs of a module.
class FlowGraphs {
 public:
  explicit FlowGraphs(const Module& module, bool ignore_case = true);
  [[nodiscard]] const Cfg& Of(ProgramId program) const { return graphs_[program.value]; }
  [[nodiscard]] const LabelTable& LabelsOf(ProgramId program) const { return labels_[program.value]; }
  /// True if this program holds a return to a target of its caller.
  [[nodiscard]] bool ReturnsToTarget(ProgramId program) const { return returns_to_target_[program.value] != 0; }

 private:
  std::vector<LabelTable> labels_;
  std::vector<Cfg> graphs_;
  std::vector<std::uint8_t> returns_to_target_;
};

/// Graphs as text: runs of blocks with one way in and one way out are one node.
void DumpCfg(const Module& module, TextBuffer& out);

}  // namespace ncport::ir::analysis
