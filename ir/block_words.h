// Looking for words in a block, and giving it others.
#pragma once

#include <cstdint>
#include <span>

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

/// Puts `words` behind each other at the end of the word store and gives the block their range.
inline void SetWords(Module& module, Block& block, std::span<const Word> words) {
  block.words = {static_cast<std::uint32_t>(module.words.Size()), static_cast<std::uint32_t>(words.size())};
  for (const Word& word : words) module.words.Add(word);
}

}  // namespace ncport::ir
