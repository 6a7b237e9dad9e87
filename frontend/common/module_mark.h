// The size of a module at one moment, to take back what a refused block has added.
#pragma once

#include "ir/module.h"

namespace ncport::frontend {

class ModuleMark {
 public:
  explicit ModuleMark(const ir::Module& module);
  /// Drops all records added since; interned strings, spellings and system variables stay: caches hold their numbers.
  void Rollback(ir::Module& module) const;

 private:
  std::size_t words_, exprs_, expr_items_, variables_, jumps_, switches_, switch_arms_, calls_, args_, parts_, fors_,
      externs_, extern_params_, assign_lists_;
};

}  // namespace ncport::frontend
