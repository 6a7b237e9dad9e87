#include "base/diag/text_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/diag/place.h"
#include "base/utf8.h"

namespace ncport::diag {

namespace {

constexpr std::string_view kCut = "...";
constexpr std::size_t kMinGutter = 5;

// The source line as cells of one character each, and the cells of the marked range.
struct Cells {
  std::vector<std::string_view> all;
  std::size_t begin = 0;
  std::size_t end = 0;
};

Cells CellsOf(std::string_view line, const SourceRange& at, std::size_t tab_width) {
  Cells cells;
  std::size_t offset = 0;
  bool begun = false;
  bool ended = false;
  // A range never starts inside a character unless its maker erred; then it starts with the next one.
  const auto mark = [&] {
    if (!begun && offset >= at.begin) {
      cells.begin = cells.all.size();
      begun = true;
    }
    if (!ended && offset >= at.end) {
      cells.end = cells.all.size();
      ended = true;
    }
  };
  while (offset < line.size()) {
    mark();
    const std::string_view rest = line.substr(offset);
    if (rest.front() == '\t') {
      const std::size_t blanks = tab_width - cells.all.size() % tab_width;
      cells.all.insert(cells.all.end(), blanks, " ");
      ++offset;
    } else {
      cells.all.push_back(Shown(rest));
      offset += FirstUtf8(rest).length;
    }
  }
  mark();
  if (!begun) cells.begin = cells.all.size();
  if (!ended) cells.end = cells.all.size();
  cells.end = std::max(cells.end, cells.begin + 1);  // an empty range, or one behind the line, is marked by one caret
  return cells;
}

// Keeps `width` cells: a third of them before the place, so that what comes after, which is mostly more telling, is
// seen.
void Cut(Cells& cells, std::size_t width) {
  const std::size_t size = cells.all.size();
  if (size <= width) return;
  std::size_t first = cells.begin > width / 3 ? cells.begin - width / 3 : 0;
  first = std::min(first, size - width);
  const std::size_t last = first + width;
  std::vector<std::string_view> shown(cells.all.begin() + static_cast<std::ptrdiff_t>(first),
                                      cells.all.begin() + static_cast<std::ptrdiff_t>(last));
  const std::size_t before = first > 0 ? kCut.size() : 0;
  std::vector<std::string_view> framed;
  framed.reserve(width + 2 * kCut.size());
  framed.insert(framed.end(), before, ".");
  framed.insert(framed.end(), shown.begin(), shown.end());
  if (last < size) framed.insert(framed.end(), kCut.size(), ".");
  cells.all = std::move(framed);
  cells.begin = cells.begin - first + before;
  // A range that goes on behind the cut is marked up to it.
  cells.end = std::max(std::min(cells.end, last) - first + before, cells.begin + 1);
}

/// The part of a very long line around the place: more than is shown on either side, so that Cut marks what is left
/// out.
std::string_view PartOf(std::string_view line, SourceRange& at, std::size_t max_width) {
  constexpr std::size_t kShort = 16384;
  if (line.size() <= kShort) return line;
  const std::size_t reach = 4096 + 8 * max_width;  // a cell has at most four bytes
  std::size_t first = at.begin > reach ? std::min<std::size_t>(at.begin, line.size()) - reach : 0;
  while (first > 0 && (static_cast<unsigned char>(line[first]) & 0xC0U) == 0x80U) --first;
  line = line.substr(first, 2 * reach);
  at.begin -= static_cast<std::uint32_t>(first);
  at.end -= static_cast<std::uint32_t>(std::min<std::size_t>(first, at.end));
  return line;
}

void AppendSource(std::string& text, SourceRange at, const SourceFiles& files, const TextOptions& options) {
  const std::string_view line = PartOf(files.Line(at.file, at.line), at, options.max_width);
  Cells cells = CellsOf(line, at, std::max<std::size_t>(options.tab_width, 1));
  Cut(cells, std::max<std::size_t>(options.max_width, 20));
  const std::string number = fmt::format("{:>{}}", at.line, kMinGutter);
  std::string shown;
  for (const std::string_view cell : cells.all) shown += cell;
  const std::size_t last = shown.find_last_not_of(' ');
  shown.resize(last == std::string::npos ? 0 : last + 1);
  text += number;
  text += shown.empty() ? " |" : " | ";
  text += shown;
  text += '\n';
  text.append(number.size(), ' ');
  text += " | ";
  text.append(cells.begin, ' ');
  text.append(cells.end - cells.begin, '^');
  text += '\n';
}

}  // namespace

std::string RenderText(const Diagnostic& diagnostic, const SourceFiles& files, const TextOptions& options) {
  std::string text = PlaceText(PlaceOf(diagnostic.at, files));
  if (!text.empty()) text += ": ";
  fmt::format_to(std::back_inserter(text), "{}[{}]: {}\n", NameOf(diagnostic.severity), InfoOf(diagnostic.code).number,
                 OneLine(diagnostic.message));
  if (diagnostic.at.Valid() && !PlaceOf(diagnostic.at, files).file.empty()) {
    AppendSource(text, diagnostic.at, files, options);
  }
  for (const Note& note : diagnostic.notes) {
    const std::string place = PlaceText(PlaceOf(note.at, files));
    fmt::format_to(std::back_inserter(text), "   note: {}{}{}\n", place, place.empty() ? "" : ": ", OneLine(note.text));
  }
  if (!diagnostic.help.empty()) fmt::format_to(std::back_inserter(text), "   help: {}\n", OneLine(diagnostic.help));
  if (!diagnostic.control.empty()) {
    fmt::format_to(std::back_inserter(text), "   control: {}\n", OneLine(diagnostic.control));
  }
  return text;
}

std::string RenderText(const Sink& sink, const SourceFiles& files, const TextOptions& options) {
  std::string text;
  for (const Diagnostic& diagnostic : sink.All()) text += RenderText(diagnostic, files, options);
  return text;
}

}  // namespace ncport::diag
