// Values of expressions that stand in the text as they are, and a walk over the expressions of a word.
#pragma once

#include <optional>

#include "ir/module.h"

namespace ncport::check {

/// The number of a literal, also behind a sign and in brackets.
std::optional<double> LiteralValue(const ir::Module& module, ir::ExprId expr);

/// The expression without brackets and conversions that the compiler made.
ir::ExprId Plain(const ir::Module& module, ir::ExprId expr);

}  // namespace ncport::check
