// The blocks that one hole of a drilling cycle is (part of expand_cycles.h): what exec::Kinematics::DrillHole does.
#pragma once

#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "ir/builder.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// One hole. Its data are numbers of the program or locals that hold them, in the units in force.
struct Hole {
  Cycle cycle = Cycle::kDrill;
  ExprId level, depth;
  ExprId step, dwell;  // none: not given; `dwell` in seconds
  ExprId back;         // where the tool goes afterwards
  std::uint8_t normal = 2;
  bool incremental = false;  // the distance mode in force
  bool skipped = false;      // the block carries a skip level: no structure marks may stand in it
  Units units = Units::kMm;
  SpindleState spindle = SpindleState::kUnknown;  // at the hole; kUnknown: not one on every way
};

class HoleMoves {
 public:
  using Put = std::function<void(const std::vector<Word>&)>;  // the next block

  /// `most_pecks`: of one hole, written out; more of them, or computed ones, become a loop.
  HoleMoves(Module& module, const Machine& source, std::uint32_t most_pecks)
      : module_(module), source_(source), most_pecks_(most_pecks), make_(module) {}

  /// From the place of the hole on. Not empty: why it has no form; some blocks may have been put then.
  std::string_view Make(ProgramId program, const Hole& hole, const Put& put);

 private:
  struct Locals {
    ExprId side, next, count;
  };

  void Rapid(const Hole& hole, ExprId target, const Put& put);
  void Feed(const Hole& hole, ExprId target, const Put& put, Motion motion = Motion::kLinear);
  std::string_view Pause(const Hole& hole, const Put& put);
  std::string_view Pecks(ProgramId program, const Hole& hole, const Put& put);
  void WrittenPecks(const Hole& hole, double level, double depth, double step, const Put& put);
  std::string_view CountedPecks(ProgramId program, const Hole& hole, const Put& put);
  [[nodiscard]] double Clearance(const Hole& hole) const;
  ExprId Compare(ExprOp op, ExprId left, ExprId right);
  ExprId Group(ExprId value) { return make_.Unary(ExprOp::kGroup, value); }

  Module& module_;
  const Machine& source_;
  const std::uint32_t most_pecks_;
  ExprBuilder make_;
  std::map<std::uint32_t, Locals> locals_;  // per program
};

}  // namespace ncport::ir::transform
