// Numbered cells that a set of programs reads before it has written them, on some way through blocks and calls: inputs
// that an operator or another program sets.
#pragma once

#include <cstdint>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

struct UnwrittenRead {
  static constexpr std::uint32_t kComputed = 0xFFFFFFFFU;

  SpaceId space;
  std::uint32_t cell = 0;  // kComputed: a number that only the run knows
  BlockId block;           // the first such read in the order of the programs
  WordId word;
  bool operator==(const UnwrittenRead&) const = default;
};

/// One entry a cell. A run starts in main programs and in programs that nothing in the module calls. Writes under a
/// condition or to a computed number count as none.
std::vector<UnwrittenRead> UnwrittenCells(const Module& module, const FlowGraphs& graphs, const CallGraph& calls);

}  // namespace ncport::ir::analysis
