#pragma once

#include <memory>

#include "frontend/common/block_parser.h"

namespace ncport::frontend::iso {

/// The generated parser of flat blocks. Its recipes have one action a token that carries a word: Action::op is the
/// TokenKind, `first` the token, `last` the token of its second word (dwell, limit, extended offset).
std::unique_ptr<BlockParser> MakeParser();

}  // namespace ncport::frontend::iso
