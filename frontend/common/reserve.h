// Room for the records of a text before it is read.
#pragma once

#include <cstddef>

#include "ir/module.h"

namespace ncport::frontend {

/// Reserves words and expressions for `bytes` more bytes of text, so that the arrays of a large program are not copied
/// each time they double. Generous: room that is never touched costs no memory.
inline void ReserveFor(std::size_t bytes, ir::Module& module) {
  constexpr std::size_t kBytesAWord = 6;
  if (bytes < std::size_t{1} << 20U) return;  // many small files grow together
  const std::size_t words = bytes / kBytesAWord;
  module.words.Reserve(module.words.Size() + words);
  module.exprs.Reserve(module.exprs.Size() + words);
}

}  // namespace ncport::frontend
