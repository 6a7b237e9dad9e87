// Ways out of conditions that some run takes, as far as values of variables say so.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "ir/analysis/cfg.h"
#include "ir/analysis/interval.h"
#include "ir/module.h"

namespace ncport::check {

/// Gathers what the value flow says over all ways into the programs. Conditions that it never came to count as open.
class KnownWays {
 public:
  explicit KnownWays(const ir::Module& module) : module_(module) {}

  void Condition(ir::BlockId block, ir::ExprId condition, const ir::analysis::Interval& truth);
  void CountedLoop(ir::BlockId block, const ir::analysis::Interval& start, const ir::analysis::Interval& end,
                   const ir::analysis::Interval& step);

  /// False if no run goes from the block along the edge. The way past a loop counts as open.
  [[nodiscard]] bool MayTake(ir::BlockId block, const ir::analysis::Edge& edge) const;
  /// False if no run that comes to the counted loop makes a pass, or none goes past it at once.
  [[nodiscard]] bool MayPass(ir::BlockId loop) const;
  [[nodiscard]] bool MayIdle(ir::BlockId loop) const;

 private:
  struct Seen {
    ir::ExprId condition;
    bool holds = false;
    bool fails = false;
    bool several = false;  // conditions in one block
  };

  struct Loop {
    bool passes = false;
    bool idles = false;
  };

  const ir::Module& module_;
  std::unordered_map<std::uint32_t, Seen> conditions_;  // per block
  std::unordered_map<std::uint32_t, Loop> loops_;       // per block
};

}  // namespace ncport::check
