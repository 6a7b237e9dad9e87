// Which tool word of the source is in force at each block, followed through jumps, loops, branches and calls.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ir/module.h"

namespace ncport::backends::fanuc {

class ToolFlow {
 public:
  explicit ToolFlow(const ir::Module& module);

  /// The tool call as the source writes it ("T1", `T="DRILL"`); empty where none is in force, or not one on every way.
  [[nodiscard]] std::string_view Before(ir::BlockId block) const;

 private:
  static constexpr int kNever = -2;  // no way leads here
  static constexpr int kMixed = -1;
  static constexpr int kNone = 0;  // else 1 + index in names_

  static int Join(int a, int b) { return a == kNever ? b : b == kNever || a == b ? a : kMixed; }
  [[nodiscard]] int Through(const ir::Block& block, int before) const;
  int NameOf(const ir::Word& word);

  const ir::Module& module_;
  std::vector<std::string> names_;
  std::map<ir::WordId, int> tools_;  // of tool words
  std::map<ir::BlockId, int> before_;
  std::vector<int> entry_, exit_;  // per program
  std::vector<bool> selects_;      // per program: it, or one that it calls, has a tool word
};

}  // namespace ncport::backends::fanuc
