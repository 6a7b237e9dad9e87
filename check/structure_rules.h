// Rules that look at the text and the flow graph of one program, not at values.
#pragma once

#include "base/diag/sink.h"
#include "ir/analysis/cfg.h"
#include "ir/module.h"

namespace ncport::check {

/// Blocks that no way from the start of the program leads to. One finding for each run of them.
void CheckUnreachable(const ir::Module& module, ir::ProgramId program, const ir::analysis::FlowGraphs& graphs,
                      diag::Sink& sink);

/// Comparisons with AND, OR, XOR or NOT as an operand without brackets: some languages bind comparisons weaker than
/// logic, so that `A==1 AND B==1` compares A with 1 AND B.
void CheckComparisons(const ir::Module& module, ir::ProgramId program, diag::Sink& sink);

/// Loops that end only when a value that goes in fractions meets another one exactly, and FOR with a start that is no
/// whole number.
void CheckExactLoopEnds(const ir::Module& module, ir::ProgramId program, const ir::analysis::FlowGraphs& graphs,
                        diag::Sink& sink);

}  // namespace ncport::check
