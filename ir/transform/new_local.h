// Variables that passes make: named locals, which the allocator of the target numbers later like any other.
#pragma once

#include <string_view>

#include "ir/module.h"

namespace ncport::ir::transform {

/// A local of `program`. `name` is a wish: a number is put behind it when the program knows that name already.
VariableId NewLocal(Module& module, ProgramId program, std::string_view name, Type type);

}  // namespace ncport::ir::transform
