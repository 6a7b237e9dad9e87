// Takes parts of deep expressions out into locals: five bracket levels are all that the family has (fanuc-4.2).
#pragma once

#include "ir/module.h"

namespace ncport::backends::fanuc {

/// Changes one program; run before variables get their numbers. `levels`: brackets that the control takes.
void LimitNesting(ir::Module& module, ir::ProgramId program, int levels);

}  // namespace ncport::backends::fanuc
