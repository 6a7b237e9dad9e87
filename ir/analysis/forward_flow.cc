#include "ir/analysis/forward_flow.h"

namespace ncport::ir::analysis {

BlockWays WaysOf(const Module& module, const Block& block) {
  BlockWays ways;
  ways.conditional = block.skip_level != Block::kNoSkip;
  for (const WordId id : block.words) {
    const Word& word = module.words[id];
    ways.moves = ways.moves || IsMotionWord(word.op);
    switch (word.op) {
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        ways.conditional = true;
        break;
      case WordOp::kCall:
      case WordOp::kModalCall:
        ways.calls = true;
        break;
      case WordOp::kJump:
      case WordOp::kSwitch:
      case WordOp::kRepeatPart:
      case WordOp::kReturn:
      case WordOp::kRestart:
      case WordOp::kProgramEnd:
      case WordOp::kAlarm:
        ways.branches = true;
        break;
      default:
        break;
    }
  }
  return ways;
}

}  // namespace ncport::ir::analysis
