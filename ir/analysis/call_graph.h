// Who calls whom. Only calls that name resolution could bind count as edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ir/module.h"

namespace ncport::ir::analysis {

struct CallSite {
  ProgramId caller;
  BlockId block;
  WordId word;
  CallId call;
  ProgramId callee;    // none: not found
  bool modal = false;  // runs after motion blocks, not here
};

class CallGraph {
 public:
  explicit CallGraph(const Module& module);

  /// In the order of the text.
  [[nodiscard]] std::span<const CallSite> SitesOf(ProgramId caller) const;
  [[nodiscard]] const std::vector<CallSite>& AllSites() const { return sites_; }
  /// Every program once, callees before their callers where no recursion forbids it.
  [[nodiscard]] const std::vector<ProgramId>& BottomUp() const { return bottom_up_; }
  /// True if a run of the program can call it again. Block ranges of the own program (CALL BLOCK, G77 N N) are no
  /// recursion.
  [[nodiscard]] bool Recursive(ProgramId program) const { return recursive_[program.value] != 0; }
  /// Programs that call each other in a circle have the same number; all others have one of their own.
  [[nodiscard]] std::uint32_t GroupOf(ProgramId program) const { return groups_[program.value]; }
  /// Levels below the program: 0 = calls nothing. kUnbounded if it, or one that it calls, can come back to itself.
  static constexpr std::uint32_t kUnbounded = 0xFFFFFFFFU;
  [[nodiscard]] std::uint32_t DepthOf(ProgramId program) const { return depths_[program.value]; }

 private:
  std::vector<CallSite> sites_;
  std::vector<std::uint32_t> starts_;  // per program, and one behind
  std::vector<ProgramId> bottom_up_;
  std::vector<std::uint32_t> groups_;
  std::vector<std::uint32_t> depths_;
  std::vector<std::uint8_t> recursive_;
};

}  // namespace ncport::ir::analysis
