#include "base/diag/place.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/utf8.h"

namespace ncport::diag {

Place PlaceOf(const SourceRange& range, const SourceFiles& files) {
  Place place;
  if (!range.file.Valid() || range.file.value >= files.Size()) return place;
  place.file = files.Name(range.file);
  if (!range.Valid()) return place;
  place.line = range.line;
  const std::string_view text = files.Line(range.file, range.line);
  const std::size_t begin = std::min<std::size_t>(range.begin, text.size());
  const std::size_t end = std::clamp<std::size_t>(range.end, begin, text.size());
  place.column = CountUtf8(text.substr(0, begin)) + 1;
  place.end_column = place.column + CountUtf8(text.substr(begin, end - begin));
  return place;
}

std::string PlaceText(const Place& place) {
  if (place.file.empty()) return {};
  if (place.line == 0) return OneLine(place.file);
  return fmt::format("{}:{}:{}", OneLine(place.file), place.line, place.column);
}

std::string_view Shown(std::string_view character) {
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  const Utf8Char c = FirstUtf8(character);
  const bool control = c.code < 0x20 || (c.code >= 0x7F && c.code < 0xA0);
  const bool turns = (c.code >= 0x200B && c.code <= 0x200F) || (c.code >= 0x2028 && c.code <= 0x202E) ||
                     (c.code >= 0x2066 && c.code <= 0x2069) || c.code == 0xFEFF;
  return !c.valid || control || turns ? kReplacement : character.substr(0, c.length);
}

std::string OneLine(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const char first = text.front();
    if (first == '\n' || first == '\r' || first == '\t') {
      line += ' ';
      text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
      continue;
    }
    const std::size_t length = FirstUtf8(text).length;
    line += Shown(text);
    text.remove_prefix(length);
  }
  return line;
}

}  // namespace ncport::diag
