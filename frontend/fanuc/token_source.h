// Splits one line of Fanuc, Mazak or Haas text into tokens (fanuc-2). Blanks mean nothing outside of comments, names
// and printed texts; keywords may be cut and glue to what stands beside them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/string_pool.h"
#include "frontend/common/line_error.h"
#include "frontend/common/token.h"
#include "frontend/fanuc/token_kind.h"

namespace ncport::frontend::fanuc {

/// A comment: bytes `begin` to `end` of the line lie between its brackets; `token` tokens stand before it.
struct CommentPart {
  std::uint32_t open = 0;  // place of `(`
  std::uint32_t begin = 0, end = 0;
  std::uint32_t token = 0;
};

class TokenSource {
 public:
  /// Limits that keep untrusted text harmless; far above what controls take.
  static constexpr std::uint32_t kMaxLineBytes = 8192;
  static constexpr std::uint32_t kMaxTokens = 1000;
  static constexpr std::uint32_t kMaxDepth = 64;  // brackets

  /// `bare_expressions`: a word may hold an expression without brackets, X#1+10 (mazak-lathe-6.4).
  TokenSource(StringPool& strings, bool bare_expressions) : strings_(strings), bare_expressions_(bare_expressions) {}

  /// Tokens of the block that begins at byte `begin` of `line`; blocks of one line are parted by `;` (fanuc-1).
  void Lex(std::string_view line, std::uint32_t begin);

  [[nodiscard]] std::span<const Token> Tokens() const { return tokens_; }
  [[nodiscard]] std::span<const CommentPart> Comments() const { return comments_; }
  /// Byte where the next block of the line begins; the line's length if there is none.
  [[nodiscard]] std::uint32_t Next() const { return next_; }
  /// Byte behind the text of this block.
  [[nodiscard]] std::uint32_t End() const { return end_; }
  /// Leading blanks.
  [[nodiscard]] std::uint32_t Indent() const { return indent_; }
  /// First thing that makes the block unreadable; null = none. Tokens end there.
  [[nodiscard]] const LineError* Error() const { return failed_ ? &error_ : nullptr; }
  /// First word that is known and refused; null = none.
  [[nodiscard]] const Token* Refused() const;
  /// First structure keyword of the block, or kNone: the block keeps its place in the structure even if it is refused.
  [[nodiscard]] TokenKind StructureWord() const { return structure_; }

 private:
  /// Letters one after the other, blanks between them left out.
  static constexpr std::size_t kMaxRun = 16;
  struct Run {
    char letters[kMaxRun];
    const char* ends[kMaxRun];  // behind each letter
    std::size_t count = 0;
    [[nodiscard]] std::string_view Text(std::size_t length) const { return {letters, length}; }
  };

  void LexHead();
  void LexBlock();
  void LexOne();
  void LexLetters();
  bool LexOperatorWord(const Run& run);
  bool LexFunctionWord(const Run& run);
  bool LexKeyword(const Run& run);
  void LexAddress(char letter, const char* from, const char* behind);
  void LexVariable();
  void LexName();
  void LexComment();
  void LexPrint();
  void LexMark();
  bool LexSkip(TokenKind kind);

  [[nodiscard]] const char* SkipBlanks(const char* at) const;
  [[nodiscard]] char At(const char* at) const { return at < stop_ ? *at : '\0'; }
  [[nodiscard]] bool StartsNumber(const char* at) const;
  /// Reads an unsigned number at `at`, blanks inside left out; null = there is none.
  const char* ReadNumber(const char* at, Token& token);
  Run ReadRun() const;
  [[nodiscard]] bool BehindOperand() const;
  [[nodiscard]] bool BehindOperator() const;

  Token& Push(TokenKind kind, const char* from, const char* to);
  void Fail(diag::Code code, const char* from, const char* to, const char* help = nullptr,
            const char* detail = nullptr);
  [[nodiscard]] TokenKind Last() const {
    return tokens_.empty() ? TokenKind::kNone : static_cast<TokenKind>(tokens_.back().kind);
  }
  [[nodiscard]] std::uint32_t OffsetOf(const char* at) const { return static_cast<std::uint32_t>(at - line_); }

  StringPool& strings_;
  const bool bare_expressions_;
  std::vector<Token> tokens_;
  std::vector<CommentPart> comments_;
  std::string digits_;  // of a number with blanks inside
  const char* line_ = nullptr;
  const char* at_ = nullptr;
  const char* stop_ = nullptr;  // end of the line
  std::uint32_t next_ = 0;
  std::uint32_t end_ = 0;
  std::uint32_t indent_ = 0;
  std::uint32_t depth_ = 0;
  std::uint32_t refused_ = 0;  // index + 1
  TokenKind structure_ = TokenKind::kNone;
  bool assigning_ = false;  // behind `=`: a slash divides
  bool done_ = false;
  bool failed_ = false;
  LineError error_;
  std::uint32_t open_[kMaxDepth] = {};
};

}  // namespace ncport::frontend::fanuc
