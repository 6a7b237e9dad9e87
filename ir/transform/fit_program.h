// What is left of a program whose parameters are numbers (part of specialize_programs.h).
#pragma once

#include <string_view>

#include "ir/analysis/flow_analyses.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// Works out what is known in the program, drops the blocks that no run comes to and the variables that nothing reads,
/// and says in a first line what it was made for (`title`). `analyses`: of the module, with this program as it is.
/// `keeps_locals`: its locals keep their values between the runs of a modal call.
void FitProgram(Module& module, const Machine& machine, ProgramId program, const analysis::FlowAnalyses& analyses,
                bool keeps_locals, std::string_view title);

}  // namespace ncport::ir::transform
