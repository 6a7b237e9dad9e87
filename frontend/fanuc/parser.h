#pragma once

#include <memory>

#include "frontend/common/block_parser.h"

namespace ncport::frontend::fanuc {

/// The generated parser of Fanuc blocks.
std::unique_ptr<BlockParser> MakeParser();

}  // namespace ncport::frontend::fanuc
