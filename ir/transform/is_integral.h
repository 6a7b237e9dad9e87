// Whether a number is whole, by the form of its expression.
#pragma once

#include "ir/module.h"

namespace ncport::ir::transform {

/// True when the value is a whole number whatever the run: rounding it changes nothing.
bool IsIntegral(const Module& module, ExprId expr);

}  // namespace ncport::ir::transform
