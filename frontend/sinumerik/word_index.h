// All words of two letters or more, and G and M numbers, by their text: which token they make.
#pragma once

#include <cstdint>
#include <string_view>

#include "frontend/sinumerik/token_kind.h"

namespace ncport::frontend::sinumerik {

struct WordEntry {
  std::string_view text;  // upper case
  TokenKind kind = TokenKind::kNone;
  std::uint8_t sub = 0;
  std::uint8_t digits = 0;
  std::uint32_t data = 0;
};

/// Entry of a word in upper case, or null: it is a name.
const WordEntry* FindWord(std::string_view upper);

/// Row of Codes() for a G or M number; kAuxiliaryRow = none.
std::uint32_t FindGCode(std::uint32_t number);
std::uint32_t FindMCode(std::uint32_t number);
/// G numbers that the control knows and ncport refuses by name.
bool IsRefusedGCode(std::uint32_t number);

}  // namespace ncport::frontend::sinumerik
