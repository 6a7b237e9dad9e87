// What a reader asks of the parser of its language, behind which the generated parser stands: only the parser.cc of
// each language sees ANTLR.
#pragma once

#include <memory>
#include <span>

#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

class BlockParser {
 public:
  BlockParser() = default;
  BlockParser(const BlockParser&) = delete;
  BlockParser& operator=(const BlockParser&) = delete;
  virtual ~BlockParser() = default;

  /// Recipe of the block with these token kinds, or why they are no block.
  virtual Recipe Parse(std::span<const Token> tokens) = 0;
};

using MakeBlockParser = std::unique_ptr<BlockParser>();

}  // namespace ncport::frontend
