#include "base/source_files.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/result.h"

namespace ncport {

namespace {

std::size_t EndLength(std::string_view whole) {
  if (whole.ends_with("\r\n")) return 2;
  return whole.ends_with('\n') || whole.ends_with('\r') ? 1 : 0;
}

}  // namespace

FileId SourceFiles::Add(std::string name, std::string utf8_text) {
  NCPORT_CHECK(utf8_text.size() <= kMaxBytes, "text of {} bytes in {}", utf8_text.size(), name);
  auto file = std::make_unique<File>();
  file->name = std::move(name);
  file->text = std::move(utf8_text);
  const std::string_view text = file->text;
  std::vector<std::uint32_t>& starts = file->starts;
  constexpr std::size_t kBytesALine =
      16;  // fewer than lines of programs have; room that is never touched costs nothing
  starts.reserve(file->text.size() / kBytesALine + 2);
  starts.push_back(0);
  const bool has_cr = text.find('\r') != std::string_view::npos;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const char* p = begin;
  while (p < end) {
    const char* stop = nullptr;
    if (has_cr) {
      stop = std::find_if(p, end, [](char c) { return c == '\n' || c == '\r'; });
      if (stop + 1 < end && stop[0] == '\r' && stop[1] == '\n') ++stop;
    } else {
      const void* const found = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
      stop = found == nullptr ? end : static_cast<const char*>(found);
    }
    p = stop < end ? stop + 1 : end;
    starts.push_back(static_cast<std::uint32_t>(p - begin));
  }
  files_.push_back(std::move(file));
  return FileId{files_.size() - 1};
}

std::uint32_t SourceFiles::LineCount(FileId file) const {
  return static_cast<std::uint32_t>(Get(file).starts.size() - 1);
}

std::string_view SourceFiles::WholeLine(FileId file, std::uint32_t line) const {
  if (!file.Valid() || file.value >= files_.size() || line == 0 || line > LineCount(file)) return {};
  const File& source = Get(file);
  const std::uint32_t start = source.starts[line - 1];
  return std::string_view{source.text}.substr(start, source.starts[line] - start);
}

std::string_view SourceFiles::Line(FileId file, std::uint32_t line) const {
  const std::string_view whole = WholeLine(file, line);
  return whole.substr(0, whole.size() - EndLength(whole));
}

std::string_view SourceFiles::LineEnd(FileId file, std::uint32_t line) const {
  const std::string_view whole = WholeLine(file, line);
  return whole.substr(whole.size() - EndLength(whole));
}

std::string_view SourceFiles::View(const SourceRange& range) const {
  const std::string_view text = Line(range.file, range.line);
  if (range.begin >= text.size() || range.end <= range.begin) return {};
  return text.substr(range.begin, range.end - range.begin);
}

FileId SourceFiles::Find(std::string_view name) const {
  for (std::size_t index = 0; index < files_.size(); ++index) {
    if (files_[index]->name == name) return FileId{index};
  }
  return {};
}

}  // namespace ncport
