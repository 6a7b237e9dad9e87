#include "backends/sinumerik/tool_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

namespace ncport::backends::sinumerik {

namespace {

std::optional<TargetTool> ParseTarget(std::string_view words) {
  TargetTool target;
  target.words = words;
  bool tool = false;
  for (std::size_t begin = 0; begin < words.size();) {
    std::size_t end = begin;
    for (bool quoted = false; end < words.size() && (quoted || words[end] != ' '); ++end) quoted ^= words[end] == '"';
    const std::string_view word = words.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    const char* last = word.data() + word.size();
    if (word.starts_with("T=\"") && word.ends_with('"') && word.size() > 4) {
      target.name = word.substr(3, word.size() - 4);
      tool = true;
    } else if (word[0] == 'T' || word[0] == 'D') {
      std::uint32_t& number = word[0] == 'T' ? target.tool : target.edge;
      if (std::from_chars(word.data() + 1, last, number).ptr != last || word.size() < 2) return std::nullopt;
      tool = tool || word[0] == 'T';
    } else if (word != "M6") {
      return std::nullopt;
    }
  }
  return tool ? std::optional(target) : std::nullopt;
}

}  // namespace

const TargetTool* ToolRows::Find(const SourceRange& at, std::uint32_t tool, std::uint32_t length,
                                 std::uint32_t radius) {
  const Key key{tool, length, radius};
  if (const auto known = found_.find(key); known != found_.end()) return &known->second;
  const std::string t = fmt::format("T{}", tool);
  std::vector<std::string> keys;
  if (radius != 0) keys.push_back(fmt::format("{} H{} D{}", t, length, radius));
  // Without a D a row stands for one radius: an edge has one.
  const auto radius_of = radius_of_.try_emplace({tool, length}, radius).first;
  if (radius_of->second == 0) radius_of->second = radius;
  if (radius == 0 || radius_of->second == radius) keys.push_back(fmt::format("{} H{}", t, length));
  // The tool alone stands for one length and one radius.
  const auto [fixed, added] = fixed_.try_emplace(tool, std::pair{length, radius});
  const bool same_length = fixed->second.first == length;
  if (radius != 0 && fixed->second.second == 0) fixed->second.second = radius;
  const bool same_radius = radius == 0 || fixed->second.second == radius;
  if (same_length && same_radius) keys.push_back(t);
  const dialects::WordMapping* mapping = nullptr;
  for (const std::string& each : keys) {
    if (mapping == nullptr && input_.config != nullptr) mapping = input_.config->FindTool(each);
  }
  return Take(at, mapping, keys.front(), key);
}

const TargetTool* ToolRows::Take(const SourceRange& at, const dialects::WordMapping* mapping,
                                 const std::string& key_text, const Key& key) {
  const std::optional<TargetTool> target = mapping == nullptr ? std::nullopt : ParseTarget(mapping->target);
  if (!target) {
    ok_ = false;
    if (!asked_.insert(key_text).second) return nullptr;
    sink_.Report(diag::Code::kUnmappedTool, at, key_text).help =
        fmt::format("add to ncport.toml, with the tool and edge of your machine:  [tools]  \"{}\" = \"T{} D1\"",
                    key_text, std::get<0>(key));
    return nullptr;
  }
  const auto [tool, length, radius] = key;
  ToolUse use;
  use.source_words = key_text;
  use.target_words = target->words;
  use.source_tool = tool;
  use.source_edge = length;
  use.source_radius = radius;
  use.target_name = target->name;
  use.target_tool = target->tool;
  use.target_offset = target->edge;
  out_.tools.push_back(use);
  return &found_.emplace(key, *target).first->second;
}

std::optional<TargetTool> ToolRows::Alone(const SourceRange& at, std::uint32_t tool) {
  std::optional<TargetTool> target;
  if (tool == 0) target = TargetTool{.words = "T0", .name = {}};  // empties the spindle on both
  if (input_.config != nullptr) {
    const std::string t = fmt::format("T{}", tool);
    for (const dialects::WordMapping& mapping : input_.config->tools) {
      if (mapping.source != t && !mapping.source.starts_with(t + " ")) continue;
      const std::optional<TargetTool> here = ParseTarget(mapping.target);
      if (!here) continue;
      if (target && (target->tool != here->tool || target->name != here->name)) {
        ok_ = false;
        sink_.Report(diag::Code::kNotExpressible, at, fmt::format("{}, which [tools] maps to more than one tool,", t),
                     input_.profile->name);
        return std::nullopt;
      }
      target = here;
    }
  }
  if (!target) {
    ok_ = false;
    if (asked_.insert(fmt::format("T{}", tool)).second) {
      sink_.Report(diag::Code::kUnmappedTool, at, fmt::format("T{}", tool)).help = fmt::format(
          "add to ncport.toml, with the tool and edge of your machine:  [tools]  \"T{0} H{0}\" = \"T{0} D1\"", tool);
    }
    return std::nullopt;
  }
  const auto known = std::find_if(out_.tools.begin(), out_.tools.end(),
                                  [&](const ToolUse& use) { return use.source_tool == tool && use.source_edge == 0; });
  if (known == out_.tools.end()) {
    ToolUse use;
    use.source_words = fmt::format("T{}", tool);
    use.target_words = target->name.empty() ? fmt::format("T{}", target->tool) : fmt::format("T=\"{}\"", target->name);
    use.source_tool = tool;
    use.target_name = target->name;
    use.target_tool = target->tool;
    out_.tools.push_back(use);
  }
  return target;
}

}  // namespace ncport::backends::sinumerik
