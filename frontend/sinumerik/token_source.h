// Splits one line of SINUMERIK text into tokens (card section 2). Works line by line, without allocation once its
// buffer has grown, and knows nothing of blocks: the parser decides what may stand where.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/string_pool.h"
#include "frontend/common/line_error.h"
#include "frontend/common/token.h"
#include "frontend/sinumerik/macros.h"
#include "frontend/sinumerik/token_kind.h"

namespace ncport::frontend::sinumerik {

class TokenSource {
 public:
  /// Limits that keep untrusted text harmless; far above what the control takes (card 10).
  static constexpr std::uint32_t kMaxLineBytes = 4096;  // without comment
  static constexpr std::uint32_t kMaxTokens = 1000;
  static constexpr std::uint32_t kMaxDepth = 64;  // brackets
  static constexpr std::uint32_t kMaxUnary = 32;  // signs and NOT behind each other

  static constexpr std::uint32_t kNoComment = 0xFFFFFFFFU;

  explicit TokenSource(StringPool& strings) : strings_(strings) {}

  /// Tokens of `line`, a text without line end. `macros` stand for their texts.
  void Lex(std::string_view line, const Macros& macros);

  [[nodiscard]] std::span<const Token> Tokens() const { return tokens_; }
  /// Leading blanks.
  [[nodiscard]] std::uint32_t Indent() const { return indent_; }
  /// Where the `;` stands.
  [[nodiscard]] std::uint32_t Comment() const { return comment_; }
  /// First thing that makes the line unreadable; null = none. Tokens end there.
  [[nodiscard]] const LineError* Error() const { return failed_ ? &error_ : nullptr; }
  /// First word that is known and refused; null = none.
  [[nodiscard]] const Token* Refused() const;
  /// Structure keyword that the block starts with, or kNone: its block keeps its place in the structure even if it is
  /// refused.
  [[nodiscard]] TokenKind StructureWord() const { return structure_; }

 private:
  struct Cursor {
    const char* at;
    const char* end;
  };

  void LexStart(Cursor& c);
  void LexWords(Cursor& c);
  bool LexLetter(Cursor& c);
  void LexIdentifier(Cursor& c, const char* word_end);
  bool LexMacro(Cursor& c);
  void LexAddress(Cursor& c);
  void LexAxis(Cursor& c, const char* start, const char* digits_end);
  void LexCode(Cursor& c);
  void LexNumberedWord(Cursor& c, TokenKind kind);
  void LexNumber(Cursor& c);
  void LexBased(Cursor& c);
  void LexText(Cursor& c);
  void LexSystem(Cursor& c);
  void LexPath(Cursor& c);
  bool LexOperator(Cursor& c);

  /// Reads a constant with sign at `at`; null = there is none. On success the token's number and format are set.
  const char* ReadValue(const char* at, const char* end, Token& token);
  const char* ReadUnsigned(const char* at, const char* end, Token& token);
  void ReadExponent(const char* start, const char*& at, const char* end, Token& token);

  Token& Push(TokenKind kind, const char* from, const char* to);
  void Fail(diag::Code code, const char* from, const char* to, const char* help = nullptr,
            const char* detail = nullptr);
  [[nodiscard]] std::uint32_t OffsetOf(const char* at) const {
    return in_macro_ != nullptr ? macro_offset_ : static_cast<std::uint32_t>(at - line_);
  }
  [[nodiscard]] TokenKind Last() const {
    return tokens_.empty() ? TokenKind::kNone : static_cast<TokenKind>(tokens_.back().kind);
  }
  [[nodiscard]] bool WantsTarget() const;
  /// Nothing but skip level, number and label so far.
  [[nodiscard]] bool OnlyHead() const;

  StringPool& strings_;
  std::vector<Token> tokens_;
  const char* line_ = nullptr;
  const Macros* macros_ = nullptr;
  const Macros::Macro* in_macro_ = nullptr;
  std::uint32_t macro_offset_ = 0;
  std::uint32_t macro_length_ = 0;
  std::uint32_t indent_ = 0;
  std::uint32_t comment_ = kNoComment;
  std::uint32_t depth_ = 0;
  std::uint32_t unary_ = 0;
  std::uint32_t refused_ = 0;  // index + 1
  TokenKind structure_ = TokenKind::kNone;
  bool defines_ = false;  // a DEFINE block: no substitution, no checks of its text
  bool failed_ = false;
  LineError error_;
  struct Open {
    std::uint32_t offset;
    char bracket;
  };
  Open open_[kMaxDepth] = {};
};

}  // namespace ncport::frontend::sinumerik
