#include "dialects/toml_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/near_name.h"

#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace ncport::dialects {
namespace {

/// Byte offset of a column that counts characters from 1.
std::uint32_t ByteOffset(std::string_view line, std::uint32_t column) {
  std::uint32_t offset = 0;
  for (std::uint32_t character = 1; character < column && offset < line.size(); ++character) {
    ++offset;
    while (offset < line.size() && (static_cast<unsigned char>(line[offset]) & 0xC0U) == 0x80U) ++offset;
  }
  return offset;
}

class Converter {
 public:
  Converter(const SourceFiles& files, FileId file) : files_(files), file_(file) {}

  [[nodiscard]] SourceRange Range(const toml::source_region& region) const {
    const std::string_view line = files_.Line(file_, region.begin.line);
    SourceRange at{file_, region.begin.line, ByteOffset(line, region.begin.column), 0};
    at.end = region.end.line == region.begin.line ? ByteOffset(line, region.end.column)
                                                  : static_cast<std::uint32_t>(line.size());
    if (at.end <= at.begin) at.end = at.begin + 1;
    return at;
  }

  [[nodiscard]] TomlNode Convert(const toml::node& node) const {
    TomlNode result;
    result.at = Range(node.source());
    if (const toml::table* table = node.as_table()) {
      result.kind = TomlKind::kTable;
      for (const auto& [key, value] : *table) {
        result.members.push_back({std::string(key.str()), Range(key.source()), Convert(value)});
      }
      // The library sorts by name; findings and repeated runs want the order of the file.
      std::stable_sort(result.members.begin(), result.members.end(), [](const TomlMember& a, const TomlMember& b) {
        return std::pair(a.key_at.line, a.key_at.begin) < std::pair(b.key_at.line, b.key_at.begin);
      });
    } else if (const toml::array* array = node.as_array()) {
      result.kind = TomlKind::kList;
      for (const toml::node& item : *array) result.items.push_back(Convert(item));
    } else if (const auto* text = node.as_string()) {
      result.kind = TomlKind::kText;
      result.text = text->get();
    } else if (const auto* integer = node.as_integer()) {
      result.kind = TomlKind::kInteger;
      result.integer = integer->get();
      result.number = static_cast<double>(integer->get());
    } else if (const auto* number = node.as_floating_point()) {
      result.kind = TomlKind::kNumber;
      result.number = number->get();
    } else if (const auto* flag = node.as_boolean()) {
      result.kind = TomlKind::kFlag;
      result.flag = flag->get();
    } else {
      result.kind = TomlKind::kDate;
    }
    return result;
  }

 private:
  const SourceFiles& files_;
  FileId file_;
};

}  // namespace

std::string TomlNode::Describe() const {
  switch (kind) {
    case TomlKind::kText:
      return fmt::format("text \"{}\"", text);
    case TomlKind::kInteger:
      return fmt::format("number {}", integer);
    case TomlKind::kNumber:
      return fmt::format("number {}", number);
    case TomlKind::kFlag:
      return flag ? "true" : "false";
    case TomlKind::kDate:
      return "a date or time";
    case TomlKind::kList:
      return "a list";
    case TomlKind::kTable:
      return "a table";
  }
  return {};
}

const TomlMember* TomlNode::Find(std::string_view key) const {
  for (const TomlMember& member : members) {
    if (member.key == key) return &member;
  }
  return nullptr;
}

Result<TomlNode> ParseToml(const SourceFiles& files, FileId file, diag::Sink& sink) {
  const toml::parse_result parsed = toml::parse(files.Text(file));
  const Converter converter(files, file);
  if (!parsed) {
    sink.Report(diag::Code::kTomlSyntax, converter.Range(parsed.error().source()), parsed.error().description());
    return Failure{};
  }
  return converter.Convert(parsed.table());
}

void ReportUnknownKey(std::string_view path, const TomlMember& member, std::span<const std::string_view> names,
                      diag::Sink& sink) {
  diag::Diagnostic& finding = sink.Report(diag::Code::kUnknownKey, member.key_at, path);
  if (const std::string_view near = NearName(member.key, names); !near.empty()) {
    finding.help = fmt::format("did you mean {}?", near);
    finding.fixes.push_back({member.key_at, std::string(near)});
  } else {
    finding.help = fmt::format("keys here: {}", fmt::join(names, ", "));
  }
}

}  // namespace ncport::dialects
