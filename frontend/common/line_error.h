// A finding about one line, kept as data until the reader reports it with its place.
#pragma once

#include <cstdint>
#include <span>

#include "base/diag/codes.h"
#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

struct LineError {
  diag::Code code{};
  std::uint32_t begin = 0;  // bytes in the line
  std::uint32_t length = 0;
  std::uint32_t limit = 0;                          // of NC9xxx codes
  std::uint32_t other_begin = 0, other_length = 0;  // second word: WordConflict
  const char* help = nullptr;                       // static text
  const char* detail = nullptr;  // static text that takes the place of the word, or a second argument
};

/// What the parser found, at its place among the tokens of a block.
inline LineError ErrorOf(const ShapeError& error, std::span<const Token> tokens) {
  const bool at_end = error.token >= tokens.size();
  const std::uint32_t end = tokens.empty() ? 0 : tokens.back().End();
  return {.code = error.code,
          .begin = at_end ? end : tokens[error.token].offset,
          .length = at_end ? 0 : tokens[error.token].length,
          .help = error.help,
          .detail = error.expected};
}

}  // namespace ncport::frontend
