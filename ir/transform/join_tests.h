// A branch that only jumps is a jump with a condition: `IF c`, `GOTOF x`, `ENDIF` becomes `IF c GOTOF x`.
#pragma once

#include "ir/module.h"

namespace ncport::ir::transform {

/// Branches without ELSE whose only block is a plain jump that no label, number or skip level marks.
void JoinTests(Module& module, ProgramId program);

}  // namespace ncport::ir::transform
