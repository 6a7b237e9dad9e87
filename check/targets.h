// The places in blocks that name a label or block number of their own program.
#pragma once

#include "ir/module.h"

namespace ncport::check {

/// What names a target.
struct TargetUse {
  const ir::Target& target;
  ir::Search search;
  const ir::Word& word;  // that holds it
  bool is_jump;          // else a repeated part
  bool quiet;            // the control goes on where nothing is found
};

/// Calls `visit(const TargetUse&)` for each target of the block's jumps, switches and repeated parts.
template <class Visit>
void ForEachTarget(const ir::Module& module, const ir::Block& block, Visit visit) {
  const auto jump_to = [&](ir::JumpId id, const ir::Word& word) {
    const ir::Jump& jump = module.jumps[id];
    visit(TargetUse{jump.target, jump.search, word, true, jump.quiet});
  };
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module.words[id];
    switch (word.op) {
      case ir::WordOp::kJump:
        jump_to(word.Extra<ir::JumpId>(), word);
        break;
      case ir::WordOp::kSwitch: {
        const ir::Switch& choice = module.switches[word.Extra<ir::SwitchId>()];
        for (std::uint32_t arm = 0; arm < choice.arm_count; ++arm)
          jump_to(module.switch_arms[choice.first_arm + arm].jump, word);
        break;
      }
      case ir::WordOp::kRepeatPart: {
        const ir::Part& part = module.parts[word.Extra<ir::PartId>()];
        visit(TargetUse{part.first, ir::Search::kBackwardThenForward, word, false, false});
        if (part.has_last) visit(TargetUse{part.last, ir::Search::kBackwardThenForward, word, false, false});
        break;
      }
      default:
        break;
    }
  }
}

/// A target that stands in the text, not one that the run computes.
inline bool IsWritten(const ir::Target& target) {
  return target.kind != ir::TargetKind::kExpression && target.kind != ir::TargetKind::kProgramStart;
}

/// The target as programs write it: "READY", "N100".
std::string TargetText(const ir::Module& module, const ir::Target& target);

}  // namespace ncport::check
