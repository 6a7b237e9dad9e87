// The expressions that the programs of a module hold.
#pragma once

#include <vector>

#include "ir/module.h"

namespace ncport::tests::random {

/// Each expression that a block of a program, or a variable that one defines, leads to; once, operands before users.
std::vector<ir::ExprId> ReachableExprs(const ir::Module& module);

}  // namespace ncport::tests::random
