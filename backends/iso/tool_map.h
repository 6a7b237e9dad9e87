// Which words of a flat program select a tool and its offsets. A number of the source stands for itself; a named tool
// and an edge need a line in [tools] of ncport.toml. One case is taken without it and listed: edge 1 of a numbered tool
// uses the offset registers with the tool's number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/diag/codes.h"
#include "dialects/config.h"

namespace ncport::backends::iso {

class ToolMap {
 public:
  /// Words of the target. `problem` set: there are none, or they were assumed.
  struct Answer {
    std::optional<diag::Code> problem;
    std::string source;   // the words of the source: `T1 D1`
    std::string assumed;  // kAssumedOffset: the words that were taken
    std::string help;
    std::string tool;                    // digits behind T
    std::optional<std::int64_t> length;  // H register
    std::optional<std::int64_t> radius;  // D register
    bool offset_in_tool = false;         // lathe: `tool` holds tool and offset
    [[nodiscard]] bool Failed() const { return problem && *problem != diag::Code::kAssumedOffset; }
  };

  ToolMap(const dialects::Config* config, bool lathe) : config_(config), lathe_(lathe) {}

  /// A tool call of the source: by number, or by name when `name` is not empty.
  void Select(std::uint32_t number, std::string_view name);
  [[nodiscard]] bool Known() const { return known_; }
  [[nodiscard]] std::uint32_t Number() const { return number_; }
  [[nodiscard]] bool Named() const { return !name_.empty(); }

  /// Words for the tool alone.
  [[nodiscard]] Answer Tool() const;
  /// Words for the tool with this edge.
  [[nodiscard]] Answer Edge(std::uint32_t edge) const;

 private:
  [[nodiscard]] std::string Word() const;
  [[nodiscard]] Answer Mapped(const dialects::WordMapping& mapping, std::string source) const;

  const dialects::Config* config_;
  bool lathe_;
  bool known_ = false;
  std::uint32_t number_ = 0;
  std::string name_;
};

}  // namespace ncport::backends::iso
