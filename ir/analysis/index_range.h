// Between which whole numbers the index of a numbered variable (`#[e]`) lies, from its own text: literals, sums,
// products, MOD, ABS and the like bound it; a variable alone does not.
#pragma once

#include <cstdint>
#include <optional>

#include "ir/module.h"

namespace ncport::ir::analysis {

struct IndexRange {
  std::uint32_t first = 0, last = 0;  // inclusive, after rounding
};

/// None: not bounded, below 0, or wider than any range of variables.
std::optional<IndexRange> IndexRangeOf(const Module& module, ExprId index);

}  // namespace ncport::ir::analysis
