// Where the linear axes may stand on arrival at a block, and how far a block moves them: intervals, in mm, the
// transverse axis as radius. Positions are those that the program names: what moves the axes otherwise, or the zero
// point (offsets, tools, frames, reference moves, cycles), leaves them unknown.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "ir/analysis/forward_flow.h"
#include "ir/analysis/interval.h"

namespace ncport::ir::analysis {

class AxisPositions {
 public:
  static constexpr std::uint8_t kAxes = 3;  // X Y Z

  /// Takes what it says from the module as it is now. `analyses` of the same module outlive it.
  AxisPositions(const Module& module, const Machine& machine, const FlowAnalyses& analyses);

  /// Length of the way that the block moves the axis, 0 without a word for it; from 0 to infinity: not known.
  [[nodiscard]] Interval WayOf(ProgramId program, BlockId block, std::uint8_t axis) const;

  // The client of ForwardFlow.
  struct State {
    std::array<Interval, kAxes> at;
    bool cycle = false;  // one may be in force: positions are holes or cuts
    std::uint8_t climbs = 0;
  };
  /// Who calls a subprogram may do so under a cycle.
  [[nodiscard]] State Entry(ProgramId program) const {
    return {.at = {}, .cycle = module_.programs[program].kind != ProgramKind::kMain};
  }
  [[nodiscard]] State Unknown(ProgramId) const { return {.at = {}, .cycle = true}; }
  bool Join(BlockId, State& into, const State& from) const;
  void Transfer(ProgramId program, BlockId block, State& state) const;

 private:
  /// What a word moves by or to.
  struct Step {
    Interval value;
    bool incremental = false;
  };
  [[nodiscard]] Step StepOf(const Word& word, const ModalState& at) const;

  const Module& module_;
  const Machine& machine_;
  const ModalFlow& modal_;
  std::map<ExprId, Interval> values_;  // of axis words that are no literals
  ForwardFlow<AxisPositions> flow_;
};

}  // namespace ncport::ir::analysis
