// Looking for words in a block.
#pragma once

#include "ir/module.h"

namespace ncport::ir {

/// The first word of the block with this meaning; null: there is none.
inline const Word* FindWord(const Module& module, const Block& block, WordOp op) {
  for (const WordId id : block.words) {
    if (module.words[id].op == op) return &module.words[id];
  }
  return nullptr;
}

inline bool HasWord(const Module& module, const Block& block, WordOp op) {
  return FindWord(module, block, op) != nullptr;
}

}  // namespace ncport::ir
