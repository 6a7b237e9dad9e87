// A TOML file as a plain tree with places. The only user of the TOML library is toml_document.cc.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"
#include "base/source_range.h"

namespace ncport::dialects {

enum class TomlKind : std::uint8_t { kText, kInteger, kNumber, kFlag, kDate, kList, kTable };

struct TomlMember;

struct TomlNode {
  TomlKind kind = TomlKind::kTable;
  std::string text;                 // kText
  std::int64_t integer = 0;         // kInteger
  double number = 0;                // kInteger, kNumber
  bool flag = false;                // kFlag
  std::vector<TomlNode> items;      // kList
  std::vector<TomlMember> members;  // kTable, in the order of the file
  SourceRange at;

  [[nodiscard]] bool IsText(std::string_view value) const { return kind == TomlKind::kText && text == value; }
  /// "text \"abc\"", "number 1.5", "a table": what a message says was found.
  [[nodiscard]] std::string Describe() const;
  [[nodiscard]] const TomlMember* Find(std::string_view key) const;
};

struct TomlMember {
  std::string key;
  SourceRange key_at;
  TomlNode value;
};

/// Parses the text of `file`. A syntax error is reported at its place.
Result<TomlNode> ParseToml(const SourceFiles& files, FileId file, diag::Sink& sink);

/// A finding on a key that means nothing in its table, with the nearest of the keys that do. `path`: as the message
/// names it.
void ReportUnknownKey(std::string_view path, const TomlMember& member, std::span<const std::string_view> names,
                      diag::Sink& sink);

}  // namespace ncport::dialects
