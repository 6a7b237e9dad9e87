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

  /// A tool word of the source: by number, or by name when `name` is not empty. The tool stands ready until Take.
  void Select(std::uint32_t number, std::string_view name);
  /// The tool that stands ready comes in: edges are its edges from now on.
  void Take() { in_ = called_; }
  /// A tool came in during this run.
  [[nodiscard]] bool Known() const { return in_.known; }
  [[nodiscard]] std::uint32_t Number() const { return in_.number; }

  /// Words for the tool of the last tool word alone.
  [[nodiscard]] Answer Tool() const;
  /// Words for the tool that is in, with this edge.
  [[nodiscard]] Answer Edge(std::uint32_t edge) const;

 private:
  struct Called {
    bool known = false;
    std::uint32_t number = 0;
    std::string name;
  };
  [[nodiscard]] static std::string WordOf(const Called& tool);
  [[nodiscard]] Answer Mapped(const dialects::WordMapping& mapping, std::string source) const;

  const dialects::Config* config_;
  bool lathe_;
  Called called_;  // by the last tool word
  Called in_;      // in the spindle
};

}  // namespace ncport::backends::iso
