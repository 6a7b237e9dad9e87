// Classes of characters in program text. Bytes above 127 belong to no class.
#pragma once

#include <string_view>

#include "base/letter_case.h"

namespace ncport::frontend {

constexpr bool IsDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool IsLetter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
constexpr bool IsBlank(char c) { return c == ' ' || c == '\t'; }
/// A blank or a control character.
constexpr bool IsSpace(char c) { return static_cast<unsigned char>(c) <= ' '; }
/// Equal without regard to case; `upper` is in upper case.
constexpr bool IsWord(std::string_view text, std::string_view upper) {
  if (text.size() != upper.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (Upper(text[i]) != upper[i]) return false;
  }
  return true;
}

constexpr std::string_view TrimEnd(std::string_view text) {
  while (!text.empty() && IsSpace(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace ncport::frontend
