// The rows of [tools]: what stands for the tools and registers of a source with T, H and D.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "backends/sinumerik/raise.h"

namespace ncport::backends::sinumerik {

/// `T5 D1`, `T="MILL_10" D2`.
struct TargetTool {
  std::string words, name;
  std::uint32_t tool = 0, edge = 1;
};

/// Reports a tool without a row once. Each row that is used comes into Translation::tools.
class ToolRows {
 public:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // tool, length, radius; 0: none

  ToolRows(const RaiseInput& input, Translation& out, diag::Sink& sink) : input_(input), out_(out), sink_(sink) {}

  /// The tool with its registers. Null: no row names it.
  const TargetTool* Find(const SourceRange& at, std::uint32_t tool, std::uint32_t length, std::uint32_t radius);
  /// What a row says, known as `key` from here on; `key_text`: how the source writes it. Null: `mapping` is none, or
  /// names no tool.
  const TargetTool* Take(const SourceRange& at, const dialects::WordMapping* mapping, const std::string& key_text,
                         const Key& key);
  /// The tool by itself: all rows of it name one.
  std::optional<TargetTool> Alone(const SourceRange& at, std::uint32_t tool);
  /// False behind a finding.
  [[nodiscard]] bool Ok() const { return ok_; }

 private:
  const RaiseInput& input_;
  Translation& out_;
  diag::Sink& sink_;
  std::map<Key, TargetTool> found_;
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> fixed_;      // by tool: its length and radius
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> radius_of_;  // by tool and length; 0: none yet
  std::set<std::string> asked_;
  bool ok_ = true;
};

}  // namespace ncport::backends::sinumerik
