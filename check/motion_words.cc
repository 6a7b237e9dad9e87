#include "check/motion_words.h"

#include <optional>

#include "check/expressions.h"
#include "ir/motions.h"

namespace ncport::check {

using ir::WordOp;

bool MayDoAnything(const ir::Module& module, const ir::Word& word) {
  switch (word.op) {
    case WordOp::kComputedG:
    case WordOp::kComputedM:
    case WordOp::kVerbatim:
      return true;
    case WordOp::kAux: {
      const std::optional<double> number = LiteralValue(module, word.value);
      return !number || *number < 7 || *number > 9;
    }
    default:
      return false;
  }
}

namespace {

/// False if words of the block make its axis words and centres name something else than the end of a move.
bool MovesAlongThePath(const ir::Module& module, const ir::Block& block) {
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module.words[id];
    switch (word.op) {
      case WordOp::kFrame: {
        // The end of a rotation or scale leaves the axis words to the move (fanuc-8.5).
        const auto op = static_cast<ir::FrameOp>(word.index);
        if (op == ir::FrameOp::kRotateEnd || op == ir::FrameOp::kScaleEnd) break;
        return false;
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
        return false;
      default:
        break;
    }
  }
  return true;
}

}  // namespace

const ir::Word* MovingWord(const ir::Module& module, const ir::Block& block) {
  for (const ir::WordId id : block.words) {
    switch (module.words[id].op) {
      case WordOp::kAxis:
      case WordOp::kAxisComputed:
      case WordOp::kPolarRadius:
      case WordOp::kPolarAngle:
        return MovesAlongThePath(module, block) ? &module.words[id] : nullptr;
      default:
        break;
    }
  }
  return nullptr;
}

const ir::Word* ArcWord(const ir::Module& module, const ir::Block& block, ir::Motion motion) {
  if (!ir::IsArc(motion)) return nullptr;
  const ir::Word* moving = MovingWord(module, block);
  if (moving != nullptr) return moving;
  for (const ir::WordId id : block.words) {
    if (module.words[id].op == WordOp::kCenter && MovesAlongThePath(module, block)) return &module.words[id];
  }
  return nullptr;
}

}  // namespace ncport::check
