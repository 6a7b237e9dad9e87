// Hole cycles of mills (G81 to G89) as the moves that they are, for targets that have no such mode: rapid to the place,
// rapid to the level, feed to the depth, back. Level, depth and dwell that the program computes are held in locals, so
// that later places drill as the first one. Which cycle and which data are in force follows from the flow.
//
// Run after LowerVacantValues (a word of a cycle is there or not) and before NumbersToNames. Afterwards no Cycle,
// CycleValue and ReturnLevel word of holes is left.
#pragma once

#include "base/diag/sink.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

struct ExpandCyclesConfig {
  ModalState sub_entry;
  SystemId position;              // reads the programmed position of an axis
  std::uint32_t most_pecks = 40;  // of one hole, written out
};

/// All programs of the module. Cycles whose way or data the text does not tell are findings (NC6001); returns false
/// then.
bool ExpandCycles(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink);

}  // namespace ncport::ir::transform
