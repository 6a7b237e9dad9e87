// The recipe of a block: out of the cache, or from the parser when its shape is new.
#pragma once

#include <memory>
#include <span>

#include "frontend/common/block_parser.h"
#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

class RecipeSource {
 public:
  /// `make`: the parser of the language, made with the first block. Without `cached` every block is parsed: for tests
  /// that compare the two ways.
  RecipeSource(MakeBlockParser* make, bool cached) : make_(make), cached_(cached) {}

  /// Valid until the next call.
  const Recipe& Of(std::span<const Token> tokens) {
    if (!cached_) return parsed_ = Parse(tokens);
    if (const Recipe* known = cache_.Find(tokens)) return *known;
    return cache_.Add(tokens, Parse(tokens));
  }

 private:
  Recipe Parse(std::span<const Token> tokens) {
    if (parser_ == nullptr) parser_ = make_();
    return parser_->Parse(tokens);
  }

  MakeBlockParser* make_;
  bool cached_;
  ShapeCache cache_;
  std::unique_ptr<BlockParser> parser_;
  Recipe parsed_;
};

}  // namespace ncport::frontend
