// The words of a block that move axes along the path.
#pragma once

#include "ir/module.h"

namespace ncport::check {

/// The first word that moves an axis in the block by the motion in force, or null: there is none, or the axis words of
/// the block name something else (a frame, a pole, a reference point, a dwell).
const ir::Word* MovingWord(const ir::Module& module, const ir::Block& block);

/// The word of the block by which an arc is recognised, if the block moves on one under `motion`; else null. An arc
/// without end point is a full circle, and has a centre.
const ir::Word* ArcWord(const ir::Module& module, const ir::Block& block, ir::Motion motion);

/// Words that may do anything: codes that are known only when the program runs, M functions of the builder (coolant is
/// none of them), text that was not understood.
bool MayDoAnything(const ir::Module& module, const ir::Word& word);

}  // namespace ncport::check
