// Token kinds of flat blocks; numbers are those of the generated parser.
#pragma once

#include <cstdint>

namespace ncport::frontend::iso {

enum class TokenKind : std::uint16_t {
  kNone,
#define NCPORT_TOKEN(Name) k##Name,
#include "frontend/iso/token_kinds.def"
};

}  // namespace ncport::frontend::iso
