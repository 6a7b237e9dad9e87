// How a block parses depends only on the kinds of its tokens. The parse tree of a kind sequence is turned once into a
// recipe, a flat list of actions with token numbers; replaying it on the tokens of a block makes the block's IR. Blocks
// of a known shape need no parser.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/diag/codes.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

/// One step of a recipe. The language's lowering knows what the numbers mean; `first` and `last` are token numbers.
struct Action {
  std::uint8_t op = 0;
  std::uint8_t arg = 0;
  std::uint16_t count = 0;
  std::uint16_t first = 0;
  std::uint16_t last = 0;
};

/// What the parser found wrong with a shape.
struct ShapeError {
  diag::Code code{};
  std::uint16_t token = 0;         // may be the number of tokens: the end of the block
  const char* help = nullptr;      // static text
  const char* expected = nullptr;  // static text, of ExpectedText
};

/// Recipe of one shape, or why it has none.
struct Recipe {
  std::vector<Action> actions;
  ShapeError error;
  bool failed = false;
};

/// Bounded: when it is full, all recipes are dropped, so that memory stays small whatever is read.
class ShapeCache {
 public:
  static constexpr std::size_t kMaxShapes = 4096;
  static constexpr std::size_t kMaxKinds = 1U << 18U;

  /// Recipe of the kinds of these tokens, or null.
  [[nodiscard]] const Recipe* Find(std::span<const Token> tokens);
  /// Keeps the recipe of the sequence that Find was asked for last.
  const Recipe& Add(std::span<const Token> tokens, Recipe recipe);
  [[nodiscard]] std::size_t Size() const { return shapes_.size(); }

 private:
  struct Shape {
    std::uint64_t hash;
    std::uint32_t begin, count;  // in kinds_
    Recipe recipe;
  };
  static constexpr std::uint32_t kFree = 0xFFFFFFFFU;

  static std::uint64_t HashOf(std::span<const Token> tokens);
  [[nodiscard]] bool Equal(const Shape& shape, std::span<const Token> tokens) const;
  void Clear();

  std::vector<Shape> shapes_;
  std::vector<std::uint16_t> kinds_;
  std::vector<std::uint32_t> slots_;  // power of two
  std::uint64_t last_hash_ = 0;
};

}  // namespace ncport::frontend
