// The recipe of a block: out of the cache, or from the parser when its shape is new.
#pragma once

#include <span>

#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

/// `Parser` is the BlockParser of a language.
template <class Parser>
class RecipeSource {
 public:
  /// Without `cached` every block is parsed: for tests that compare the two ways.
  explicit RecipeSource(bool cached) : cached_(cached) {}

  /// Valid until the next call.
  const Recipe& Of(std::span<const Token> tokens) {
    if (!cached_) return parsed_ = parser_.Parse(tokens);
    if (const Recipe* known = cache_.Find(tokens)) return *known;
    return cache_.Add(tokens, parser_.Parse(tokens));
  }

 private:
  bool cached_;
  ShapeCache cache_;
  Parser parser_;
  Recipe parsed_;
};

}  // namespace ncport::frontend
