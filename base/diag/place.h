// A place as users see it: file name, line and columns that count characters from 1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/source_files.h"

namespace ncport::diag {

struct Place {
  std::string_view file;       // empty: no file
  std::uint32_t line = 0;      // 0: the file as a whole, or nothing
  std::size_t column = 0;      // of the first character
  std::size_t end_column = 0;  // of the character behind the last one
};

Place PlaceOf(const SourceRange& range, const SourceFiles& files);
/// "x.spf:12:15", "x.spf" for a file as a whole, "" for nothing.
std::string PlaceText(const Place& place);
/// `text` on one line and safe for a terminal: line ends and tabs become blanks, control characters, marks that turn
/// the writing direction, and bytes that are not UTF-8 become U+FFFD.
std::string OneLine(std::string_view text);
/// The character as it is shown: itself, or U+FFFD where OneLine says so. Tabs are the caller's.
std::string_view Shown(std::string_view character);

}  // namespace ncport::diag
