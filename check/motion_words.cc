#include "check/motion_words.h"

namespace ncport::check {

using ir::WordOp;

bool IsFeedMotion(ir::Motion motion) {
  switch (motion) {
    case ir::Motion::kLinear:
    case ir::Motion::kArcCw:
    case ir::Motion::kArcCcw:
    case ir::Motion::kArcVia:
    case ir::Motion::kArcTangent:
      return true;
    default:
      return false;
  }
}

const ir::Word* MovingWord(const ir::Module& module, const ir::Block& block) {
  const ir::Word* moving = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module.words[id];
    switch (word.op) {
      case WordOp::kAxis:
      case WordOp::kAxisComputed:
      case WordOp::kPolarRadius:
      case WordOp::kPolarAngle:
        if (moving == nullptr) moving = &word;
        break;
      case WordOp::kFrame: {
        // The end of a rotation or scale leaves the axis words to the move (fanuc-8.5).
        const auto op = static_cast<ir::FrameOp>(word.index);
        if (op == ir::FrameOp::kRotateEnd || op == ir::FrameOp::kScaleEnd) break;
        return nullptr;
      }
      case WordOp::kReference:
      case WordOp::kMachineCoords:  // some controls go there at rapid
      case WordOp::kPole:
      case WordOp::kPresetPosition:
      case WordOp::kDwellSeconds:
      case WordOp::kDwellRevolutions:
      case WordOp::kDataSetting:
      case WordOp::kComputedG:
      case WordOp::kWhen:
      case WordOp::kCycle:
      case WordOp::kCycleValue:
        return nullptr;
      default:
        break;
    }
  }
  return moving;
}

}  // namespace ncport::check
