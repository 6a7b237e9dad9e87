// Expressions that no run stops for: what is left out, moved or passed over needs to have no effect.
#pragma once

#include <span>

#include "ir/module.h"

namespace ncport::ir {

/// True of literals, variables, numbered cells and axis names, their sums, products and comparisons, and truth of
/// those. Divisions, functions, computed places and reads of the machine may alarm, as may conversions and texts unless
/// `also` holds their operations.
[[nodiscard]] bool NeverAlarms(const Module& module, ExprId id, std::span<const ExprOp> also = {});

}  // namespace ncport::ir
