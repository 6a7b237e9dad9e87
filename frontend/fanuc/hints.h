// Errors of a block that tell their cause: what a typing error at this place mostly is. Asked only about blocks that
// are wrong.
#pragma once

#include <string>
#include <string_view>

#include "frontend/common/line_error.h"

namespace ncport::frontend::fanuc {

/// Sets the help of `error`, and moves it to the whole word where the wrong one is a part of it. `help` keeps the text.
void ExplainError(std::string_view line, LineError& error, std::string& help);

}  // namespace ncport::frontend::fanuc
