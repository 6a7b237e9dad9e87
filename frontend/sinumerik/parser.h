#pragma once

#include <memory>

#include "frontend/common/block_parser.h"

namespace ncport::frontend::sinumerik {

/// The generated parser of SINUMERIK blocks.
std::unique_ptr<BlockParser> MakeParser();

}  // namespace ncport::frontend::sinumerik
