// A place in a source file.
#pragma once

#include <cstdint>

#include "base/ids.h"

namespace ncport {

struct FileTag;
using FileId = Id<FileTag>;

/// Part of one line: bytes [begin, end) of the decoded text of line `line`, which counts from 1. Line 0: no place (or,
/// with a valid file, the file as a whole).
struct SourceRange {
  FileId file;
  std::uint32_t line = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] constexpr bool Valid() const { return line != 0; }
  constexpr bool operator==(const SourceRange&) const = default;
};

/// From the start of `first` to the end of `last`. When they stand in different lines or files: `first`, as a range has
/// one line.
constexpr SourceRange Join(const SourceRange& first, const SourceRange& last) {
  if (first.file != last.file || first.line != last.line) return first;
  return {first.file, first.line, first.begin < last.begin ? first.begin : last.begin,
          first.end > last.end ? first.end : last.end};
}

}  // namespace ncport
