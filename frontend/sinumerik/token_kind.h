// Token kinds of SINUMERIK blocks; numbers are those of the generated parser.
#pragma once

#include <cstdint>

namespace ncport::frontend::sinumerik {

enum class TokenKind : std::uint16_t {
  kNone,
#define NCPORT_TOKEN(Name) k##Name,
#include "frontend/sinumerik/token_kinds.def"
};

/// Token::sub of axes that are not one of the nine letters; Token::data is their name.
inline constexpr std::uint8_t kNamedAxis = 0xFF;
/// Token::data of an M function without a row of its own.
inline constexpr std::uint32_t kAuxiliaryRow = 0xFFFFFFFFU;

}  // namespace ncport::frontend::sinumerik
