// What still runs where a tool changes and the translation goes home for it: coolant, constant surface speed.
#pragma once

#include <cstdint>

#include "backends/fanuc/raise.h"
#include "ir/analysis/forward_flow.h"

namespace ncport::backends::fanuc {

class ChangeStates {
 public:
  enum class Coolant : std::uint8_t { kOff, kM7, kM8, kMaybe };
  enum class SurfaceSpeed : std::uint8_t { kOff, kOn, kMaybe };
  struct State {
    Coolant coolant = Coolant::kOff;
    SurfaceSpeed speed = SurfaceSpeed::kOff;
    bool operator==(const State&) const = default;
  };

  /// `module` outlives it, and keeps its blocks.
  ChangeStates(const RaiseInput& input, const ir::Module& module);

  /// On arrival at the block; all off where no run comes.
  [[nodiscard]] State Before(ir::BlockId block) const;
  /// Behind the block on the straight way down the speed is chosen anew before anything is cut.
  [[nodiscard]] bool SpeedFollows(ir::ProgramId program, ir::BlockId block) const;

  // The data flow.
  [[nodiscard]] State Entry(ir::ProgramId) const { return {}; }
  [[nodiscard]] State Unknown(ir::ProgramId) const { return {Coolant::kMaybe, SurfaceSpeed::kMaybe}; }
  bool Join(ir::BlockId, State& into, const State& from) const;
  void Transfer(ir::ProgramId, ir::BlockId block, State& state) const;
  [[nodiscard]] State Back(const ir::analysis::CallSite&, const State&, const State& exit) const { return exit; }

 private:
  const ir::Module& module_;
  ir::analysis::FlowAnalyses analyses_;
  ir::analysis::ForwardFlow<ChangeStates> flow_;
};

}  // namespace ncport::backends::fanuc
