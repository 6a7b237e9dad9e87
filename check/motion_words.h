// The words of a block that move axes along the path.
#pragma once

#include "ir/module.h"

namespace ncport::check {

/// The first word that moves an axis in the block by the motion in force, or null: there is none, or the axis words of
/// the block name something else (a frame, a pole, a reference point, a dwell).
const ir::Word* MovingWord(const ir::Module& module, const ir::Block& block);

/// Modes that cut with the feed; threads and tapping go with the spindle.
bool IsFeedMotion(ir::Motion motion);

}  // namespace ncport::check
