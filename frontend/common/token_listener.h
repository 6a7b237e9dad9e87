// Hears of the tokens of a file as they are read, for showing them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/ids.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

class TokenListener {
 public:
  TokenListener() = default;
  TokenListener(const TokenListener&) = delete;
  TokenListener& operator=(const TokenListener&) = delete;
  virtual ~TokenListener() = default;
  /// Tokens of one block, up to the first place that could not be read. `text` is the whole line, `line` counts from 1;
  /// `kinds[kind]` is the name of a kind.
  virtual void OnTokens(FileId file, std::uint32_t line, std::string_view text, std::span<const Token> tokens,
                        std::span<const std::string_view> kinds) = 0;
};

}  // namespace ncport::frontend
