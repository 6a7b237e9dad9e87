// Numbers that stand in the text as they are.
#pragma once

#include <cstdint>
#include <optional>

#include "ir/module.h"

namespace ncport::ir {

/// Value of a literal, also with a sign, in brackets or converted to REAL; none: something else.
std::optional<double> LiteralValue(const Module& module, ExprId id);

/// A literal whole number from 0 to `most`, also in brackets or converted.
std::optional<std::uint32_t> WholeNumber(const Module& module, ExprId id, std::uint32_t most = 4'000'000'000U);

}  // namespace ncport::ir
