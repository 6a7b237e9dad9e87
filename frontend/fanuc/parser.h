// The generated parser of Fanuc blocks, and its trees as recipes.
#pragma once

#include <memory>
#include <span>

#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"

namespace ncport::frontend::fanuc {

class BlockParser {
 public:
  BlockParser();
  BlockParser(const BlockParser&) = delete;
  BlockParser& operator=(const BlockParser&) = delete;
  ~BlockParser();

  /// Recipe of the block with these token kinds.
  Recipe Parse(std::span<const Token> tokens);

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace ncport::frontend::fanuc
