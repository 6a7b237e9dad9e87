// The texts of all input files of a run and their lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/source_range.h"

namespace ncport {

/// Owns names and decoded (UTF-8) texts. Views stay valid as long as this object lives.
/// A line ends with LF, CRLF or a CR alone; the last one may lack an end. "a\n" has one line, "" has none.
class SourceFiles {
 public:
  /// Longest text of one file in bytes: places hold 32 bits. The reader of files must refuse longer ones.
  static constexpr std::size_t kMaxBytes = 0xFFFFFFF0U;

  FileId Add(std::string name, std::string utf8_text);

  [[nodiscard]] std::size_t Size() const { return files_.size(); }
  [[nodiscard]] std::string_view Name(FileId file) const { return Get(file).name; }
  [[nodiscard]] std::string_view Text(FileId file) const { return Get(file).text; }
  [[nodiscard]] std::uint32_t LineCount(FileId file) const;
  /// Line `line` (from 1) without its end; empty if there is no such line.
  [[nodiscard]] std::string_view Line(FileId file, std::uint32_t line) const;
  /// The end of line `line` as it stands in the file: "\n", "\r\n", "\r" or "".
  [[nodiscard]] std::string_view LineEnd(FileId file, std::uint32_t line) const;
  /// The text under `range`; empty if there is none. Ranges that reach over the end of the line are cut.
  [[nodiscard]] std::string_view View(const SourceRange& range) const;
  /// The file of this name, or an invalid id.
  [[nodiscard]] FileId Find(std::string_view name) const;

 private:
  struct File {
    std::string name;
    std::string text;
    std::vector<std::uint32_t> starts;  // of each line, and one behind the last
  };

  [[nodiscard]] const File& Get(FileId file) const { return *files_[file.value]; }
  [[nodiscard]] std::string_view WholeLine(FileId file, std::uint32_t line) const;

  std::vector<std::unique_ptr<File>> files_;  // pointers, so that views survive growth
};

}  // namespace ncport
