// Classes of the characters of SINUMERIK text (card 2), and what reads along them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "frontend/common/chars.h"

namespace ncport::frontend::sinumerik {

constexpr std::uint8_t kBlank = 1;       // also characters that cannot be printed, and `&` (card 2)
constexpr std::uint8_t kIdentifier = 2;  // letter, digit, _
constexpr std::uint8_t kStart = 4;       // letter, _
inline constexpr auto kClasses = [] {
  std::array<std::uint8_t, 256> classes{};
  for (int c = 0; c <= ' '; ++c) classes[c] = kBlank;
  classes[127] = kBlank;
  classes['&'] = kBlank;
  for (int c = '0'; c <= '9'; ++c) classes[c] = kIdentifier;
  for (int c = 'A'; c <= 'Z'; ++c) classes[c] = kIdentifier | kStart;
  for (int c = 'a'; c <= 'z'; ++c) classes[c] = kIdentifier | kStart;
  classes['_'] = kIdentifier | kStart;
  return classes;
}();
/// `mask`: classes, one of them is enough.
inline bool Is(char c, std::uint8_t mask) { return (kClasses[static_cast<unsigned char>(c)] & mask) != 0; }

inline const char* SkipBlanks(const char* at, const char* end) {
  while (at < end && Is(*at, kBlank)) ++at;
  return at;
}
inline const char* SkipDigits(const char* at, const char* end) {
  while (at < end && IsDigit(*at)) ++at;
  return at;
}
inline const char* SkipIdentifier(const char* at, const char* end) {
  while (at < end && Is(*at, kIdentifier)) ++at;
  return at;
}

constexpr std::size_t kMaxWord = 64;
/// `text` in upper case, in `buffer`; empty if it is longer than any word.
inline std::string_view UpperIn(std::string_view text, char (&buffer)[kMaxWord]) {
  if (text.size() > kMaxWord) return {};
  for (std::size_t i = 0; i < text.size(); ++i) buffer[i] = Upper(text[i]);
  return {buffer, text.size()};
}

}  // namespace ncport::frontend::sinumerik
