#include "dialects/word_template.h"

#include <fmt/format.h>

#include <cstddef>

#include "base/result.h"

namespace ncport::dialects {
namespace {

/// One hole `{name}` or `{name:0w}` that starts at `open`.
struct Hole {
  std::string_view name;
  std::size_t width = 0;
  std::size_t end = 0;  // behind the closing brace; 0 = malformed
};

Hole ReadHole(std::string_view pattern, std::size_t open) {
  Hole hole;
  const std::size_t close = pattern.find('}', open);
  if (close == std::string_view::npos) return hole;
  std::string_view inside = pattern.substr(open + 1, close - open - 1);
  const std::size_t colon = inside.find(':');
  if (colon != std::string_view::npos) {
    const std::string_view width = inside.substr(colon + 1);
    if (width.size() != 2 || width[0] != '0' || width[1] < '1' || width[1] > '9') return hole;
    hole.width = static_cast<std::size_t>(width[1] - '0');
    inside = inside.substr(0, colon);
  }
  hole.name = inside;
  hole.end = close + 1;
  return hole;
}

bool Contains(std::string_view words, std::string_view word) {
  std::size_t begin = 0;
  while (begin < words.size()) {
    std::size_t end = words.find(' ', begin);
    if (end == std::string_view::npos) end = words.size();
    if (words.substr(begin, end - begin) == word) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

void AppendTemplate(TextBuffer& buffer, std::string_view pattern, std::span<const TemplateValue> values) {
  std::size_t begin = 0;
  while (begin < pattern.size()) {
    const std::size_t open = pattern.find('{', begin);
    if (open == std::string_view::npos) break;
    buffer.Append(pattern.substr(begin, open - begin));
    const Hole hole = ReadHole(pattern, open);
    NCPORT_CHECK(hole.end != 0, "malformed word template '{}'", pattern);
    const TemplateValue* found = nullptr;
    for (const TemplateValue& value : values) {
      if (value.hole == hole.name) found = &value;
    }
    NCPORT_CHECK(found != nullptr, "no value for '{}' in word template '{}'", hole.name, pattern);
    for (std::size_t width = found->text.size(); width < hole.width; ++width) buffer.Append('0');
    buffer.Append(found->text);
    begin = hole.end;
  }
  buffer.Append(pattern.substr(begin));
}

std::string CheckTemplate(std::string_view pattern, std::string_view holes) {
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] == '}') return "'}' without '{'";
    if (pattern[i] != '{') continue;
    const Hole hole = ReadHole(pattern, i);
    if (hole.end == 0) return "a hole is written {name} or {name:02}";
    if (!Contains(holes, hole.name)) {
      return holes.empty() ? fmt::format("{{{}}}: this key has no holes", hole.name)
                           : fmt::format("{{{}}} is not one of its holes: {}", hole.name, holes);
    }
    i = hole.end - 1;
  }
  return {};
}

std::size_t WidthOf(std::string_view pattern, std::string_view hole) {
  for (std::size_t open = pattern.find('{'); open != std::string_view::npos; open = pattern.find('{', open + 1)) {
    const Hole found = ReadHole(pattern, open);
    if (found.end != 0 && found.name == hole) return found.width == 0 ? 1 : found.width;
  }
  return 0;
}

}  // namespace ncport::dialects
