// Characters of UTF-8 text. Never fails: a byte that is not UTF-8 counts as one character.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ncport {

struct Utf8Char {
  char32_t code;       // U+FFFD for a byte that is not UTF-8
  std::size_t length;  // in bytes, at least 1
  bool valid;
};

/// The first character of `text`, which is not empty.
Utf8Char FirstUtf8(std::string_view text);
bool IsValidUtf8(std::string_view text);
/// Number of characters (code points).
std::size_t CountUtf8(std::string_view text);
void AppendUtf8(std::string& text, char32_t code);

}  // namespace ncport
