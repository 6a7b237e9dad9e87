// Token kinds of Fanuc blocks; numbers are those of the generated parser.
#pragma once

#include <cstdint>

namespace ncport::frontend::fanuc {

enum class TokenKind : std::uint16_t {
  kNone,
#define NCPORT_TOKEN(Name) k##Name,
#include "frontend/fanuc/token_kinds.def"
};

}  // namespace ncport::frontend::fanuc
