// The generated parser of flat blocks, and its trees as recipes: one action a token that carries a word.
#pragma once

#include <memory>
#include <span>

#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"

namespace ncport::frontend::iso {

class BlockParser {
 public:
  BlockParser();
  BlockParser(const BlockParser&) = delete;
  BlockParser& operator=(const BlockParser&) = delete;
  ~BlockParser();

  /// Recipe of the block with these token kinds. Action::op is the TokenKind, `first` the token, `last` the token of
  /// its second word (dwell, limit, extended offset).
  Recipe Parse(std::span<const Token> tokens);

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace ncport::frontend::iso
