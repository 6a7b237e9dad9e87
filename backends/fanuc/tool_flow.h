// Which tool word of the source is in force at each block, followed through jumps, loops, branches and calls.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ir/analysis/forward_flow.h"

namespace ncport::backends::fanuc {

class ToolFlow {
 public:
  explicit ToolFlow(const ir::analysis::FlowSources& sources);

  /// The tool call as the source writes it ("T1", `T="DRILL"`); empty where none is in force, or not one on every way.
  [[nodiscard]] std::string_view Before(ir::BlockId block) const;

 private:
  static constexpr int kMixed = -1;
  static constexpr int kNone = 0;  // else 1 + index in names_
  struct Client;

  int NameOf(const ir::Module& module, const ir::Word& word);

  std::vector<std::string> names_;
  std::map<ir::WordId, int> tools_;  // of tool words
  std::map<ir::BlockId, int> before_;
};

}  // namespace ncport::backends::fanuc
