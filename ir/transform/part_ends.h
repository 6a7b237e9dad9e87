// Gives every repeated part that ends at a block of its own (REPEATB, an end label) an empty block behind it with a
// label that stands once, so that passes which split blocks or put others behind them leave the part what it was.
//
// Afterwards such parts are `has_last` and not `single`. Parts that end right before their RepeatPart word stay.
#pragma once

#include "ir/analysis/labels.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// Changes one program; before any pass that splits its blocks. Parts whose labels are not found stay as they are.
void MarkPartEnds(Module& module, ProgramId program, bool ignore_case = true);

/// True if control leaves the blocks of `range` behind the last one only, as long as the program goes on: no jump leads
/// out, and no structure is cut.
bool LeavesAtEndOnly(const Module& module, const analysis::LabelTable& labels,
                     const analysis::LabelTable::Range& range);

}  // namespace ncport::ir::transform
