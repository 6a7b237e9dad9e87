// What a flat program was told about besides its blocks: maps, losses, rapids. For reports.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/source_range.h"
#include "ir/module.h"

namespace ncport::backends::iso {

struct FlatUse {
  std::string source;  // words as the source writes them: `T1 D1`, `G505`, `M41`
  std::string target;  // what stands for them; empty: nothing
};

struct FlatLoss {
  SourceRange source;
  std::string what;
  std::uint64_t line = 0;  // of the comment in the output, from 1
};

/// A rapid of several axes: where it stands first, however often its block runs.
struct FlatRapid {
  ir::BlockId block;
  std::uint64_t line = 0;
  std::uint16_t axes = 0;
};

struct FlatRecord {
  std::vector<FlatUse> tools, offsets, functions;
  std::vector<FlatLoss> losses;
  std::vector<FlatRapid> rapids;  // only when FlatOptions::list_rapids
  std::vector<std::string> assumptions;

  /// Adds a line to a map, each once.
  static void Add(std::vector<FlatUse>& uses, std::string_view source, std::string_view target) {
    for (const FlatUse& use : uses) {
      if (use.source == source && use.target == target) return;
    }
    uses.push_back({std::string(source), std::string(target)});
  }
};

}  // namespace ncport::backends::iso
