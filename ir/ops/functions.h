// The functions of numbers of nodes.def by their meaning.
#pragma once

#include <cstddef>

#include "ir/machine.h"
#include "ir/nodes.h"
#include "ir/ops/result.h"

namespace ncport::ir::ops {

/// True for functions that need nothing but numbers: those that Apply knows.
bool IsNumeric(Function function);

/// `function` of `count` numbers (count as ArityOf says). Not for functions of texts, axes and the environment.
Number Apply(Function function, const double* args, std::size_t count, const Machine& machine);

}  // namespace ncport::ir::ops
