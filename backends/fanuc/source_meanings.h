// Words that both languages have and that mean something else here: made to mean what they mean in the source.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// The first skip level is `/` on each control: level 0 there, level 1 here.
bool ShiftSkipLevels(const RaiseInput& input, ir::Module& module, diag::Sink& sink);
/// An end that only leaves its subprogram in the source would end the whole run here.
void EndsToReturns(const RaiseInput& input, ir::Module& module);
/// A repeated call finds the arguments here as its last pass left them: refused where the program changes its own.
bool RefuseRepeatedCalls(const RaiseInput& input, const ir::Module& module, diag::Sink& sink);
/// Pi is a number; other values that only the source's control keeps are refused where they are left.
void PiToNumber(ir::Module& module);

}  // namespace ncport::backends::fanuc
