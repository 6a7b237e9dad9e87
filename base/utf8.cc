#include "base/utf8.h"

#include <cstdint>
#include <cstring>

namespace ncport {

Utf8Char FirstUtf8(std::string_view text) {
  constexpr Utf8Char kBad{0xFFFD, 1, false};
  const auto byte = [&](std::size_t index) { return static_cast<unsigned char>(text[index]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1, true};
  // C0, C1 and F5 up never occur; continuation bytes cannot stand first.
  if (first < 0xC2 || first > 0xF4) return kBad;
  const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (text.size() < length) return kBad;
  char32_t code = first & (0xFFU >> (length + 1));
  for (std::size_t index = 1; index < length; ++index) {
    const unsigned next = byte(index);
    if ((next & 0xC0U) != 0x80) return kBad;
    code = (code << 6U) | (next & 0x3FU);
  }
  // Forms longer than needed, surrogates, and what is past the last plane.
  if ((length == 3 && code < 0x800) || (length == 4 && code < 0x10000)) return kBad;
  if ((code >= 0xD800 && code <= 0xDFFF) || code > 0x10FFFF) return kBad;
  return {code, length, true};
}

bool IsValidUtf8(std::string_view text) {
  while (!text.empty()) {
    std::uint64_t eight = 0;  // most text is ASCII
    if (text.size() >= sizeof eight) {
      std::memcpy(&eight, text.data(), sizeof eight);
      if ((eight & 0x8080808080808080U) == 0) {
        text.remove_prefix(sizeof eight);
        continue;
      }
    }
    const Utf8Char c = FirstUtf8(text);
    if (!c.valid) return false;
    text.remove_prefix(c.length);
  }
  return true;
}

std::size_t CountUtf8(std::string_view text) {
  std::size_t count = 0;
  while (!text.empty()) {
    text.remove_prefix(FirstUtf8(text).length);
    ++count;
  }
  return count;
}

void AppendUtf8(std::string& text, char32_t code) {
  const auto put = [&](char32_t byte) { text.push_back(static_cast<char>(byte)); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6U));
    put(0x80 | (code & 0x3FU));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12U));
    put(0x80 | ((code >> 6U) & 0x3FU));
    put(0x80 | (code & 0x3FU));
  } else {
    put(0xF0 | (code >> 18U));
    put(0x80 | ((code >> 12U) & 0x3FU));
    put(0x80 | ((code >> 6U) & 0x3FU));
    put(0x80 | (code & 0x3FU));
  }
}

}  // namespace ncport
