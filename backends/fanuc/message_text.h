// The text of a message as far as it is known before the run.
#pragma once

#include <string>

#include "ir/module.h"

namespace ncport::backends::fanuc {

/// Computed parts by the name of their variable, else as dots.
void AppendMessage(const ir::Module& module, ir::ExprId id, std::string& out);

}  // namespace ncport::backends::fanuc
