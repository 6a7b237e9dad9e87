// Cutter compensation on the ways through the programs: off, switched on, begun. A switch acts with the next move of
// the plane: until then nothing has left the programmed path (sinumerik-8.8, fanuc-11#65).
#pragma once

#include <cstdint>

#include "check/subject.h"
#include "ir/analysis/forward_flow.h"

namespace ncport::check {

struct CompState {
  // What may hold on the ways to a block: a set of these.
  static constexpr std::uint8_t kOff = 1;
  static constexpr std::uint8_t kSwitchedOn = 2;  // nothing has moved in the plane since
  static constexpr std::uint8_t kBegun = 4;
  static constexpr std::uint8_t kAnything = 128;

  std::uint8_t ways = 0;
  ir::BlockId switched;  // of kSwitchedOn: the block of the switch, the first of the text
};

class CompFlow {
 public:
  explicit CompFlow(const Subject& subject);

  /// On arrival; null where no run comes.
  [[nodiscard]] const CompState* Before(ir::BlockId block) const { return flow_.Before(block); }
  /// With the block's own switch: under which it moves.
  [[nodiscard]] CompState At(ir::BlockId block, const CompState& before) const;
  /// Whether the block moves in the plane by the motion in force, and so begins what is switched on.
  [[nodiscard]] bool MovesInPlane(ir::ProgramId program, ir::BlockId block) const;
  /// The word that switches the compensation, the last of the block; null: there is none.
  [[nodiscard]] const ir::Word* Switch(ir::BlockId block) const;

  // For ForwardFlow.
  using State = CompState;
  [[nodiscard]] State Entry(ir::ProgramId program) const;
  static State Unknown(ir::ProgramId) { return {CompState::kAnything, {}}; }
  static bool Join(ir::BlockId, State& into, const State& from);
  void Transfer(ir::ProgramId program, ir::BlockId block, State& state) const;

 private:
  const Subject& subject_;
  const ir::Module& module_;
  ir::analysis::ForwardFlow<CompFlow> flow_;
};

/// True if the word switches it off.
bool EndsCompensation(const ir::Word& comp);

}  // namespace ncport::check
