// The slips that ExplainSyntax knows, one function each: true if it fits, with the error moved and its help set. One
// file for each kind (syntax_hints_*.cc).
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/common/line_error.h"
#include "frontend/common/token.h"
#include "frontend/sinumerik/token_kind.h"

namespace ncport::frontend::sinumerik {

class SyntaxHints {
 public:
  /// `at`: first token that does not fit, tokens.size() = the end of the block.
  SyntaxHints(std::span<const Token> tokens, std::size_t at, std::string_view line, LineError& error, std::string& help)
      : tokens_(tokens), at_(at), line_(line), error_(error), help_(help) {}

  void Run();

 private:
  using Code = diag::Code;
  using K = TokenKind;

  [[nodiscard]] K KindAt(std::size_t token) const {
    return token < tokens_.size() ? static_cast<K>(tokens_[token].kind) : K::kNone;
  }
  [[nodiscard]] K Kind() const { return KindAt(at_); }
  [[nodiscard]] K Before() const { return at_ == 0 ? K::kNone : KindAt(at_ - 1); }
  [[nodiscard]] std::string_view TextOf(std::size_t token) const {
    return line_.substr(tokens_[token].offset, tokens_[token].length);
  }
  /// First token behind skip mark, block number and label.
  [[nodiscard]] std::size_t First() const {
    std::size_t first = 0;
    while (KindAt(first) == K::kSkip || KindAt(first) == K::kBlockNumber || KindAt(first) == K::kMainNumber ||
           KindAt(first) == K::kLabel)
      ++first;
    return first;
  }
  [[nodiscard]] bool Holds(K kind) const {
    for (std::size_t i = 0; i < at_ && i < tokens_.size(); ++i) {
      if (KindAt(i) == kind) return true;
    }
    return false;
  }
  bool Put(Code code, std::size_t token, const char* detail = nullptr) {
    error_.code = code;
    error_.begin = tokens_[token].offset;
    error_.length = tokens_[token].length;
    error_.detail = detail;
    return true;
  }
  template <class... Args>
  bool Say(fmt::format_string<Args...> text, Args&&... args) {
    help_ = fmt::format(text, std::forward<Args>(args)...);
    return true;
  }
  static bool IsValue(K kind);
  static bool IsOperator(K kind);
  static bool StartsValue(K kind);

  // numbers
  bool TornNumber();
  bool LettersInNumber();
  bool LettersBehindSign();
  bool SecondSign();
  [[nodiscard]] std::size_t TokenAt(std::uint32_t offset) const;

  // names
  bool NewName();
  bool TornName();
  bool MissingType();

  // signs
  bool ForeignOperator();
  bool ForeignSign();
  bool Comparison();
  bool Closer();

  // heads of blocks
  bool Head();
  bool Conditional();
  /// Brackets that are open at the error.
  [[nodiscard]] std::size_t OpenBrackets() const;

  // missing parts
  bool Incomplete();
  bool NoFunction();
  bool NoBrackets();
  bool NoOperator();
  /// True in the brackets of a call, which hold a list.
  [[nodiscard]] bool InCall() const;
  [[nodiscard]] std::string_view BetweenTokens() const;
  bool LooseCell();
  bool Gap();
  bool MissingValue();

  // words
  bool GroupIndex();
  bool JumpWithoutBlank();
  bool RunTogether();
  bool Dwell();
  bool ForeignName();
  bool TornWord();
  bool ColonOfLabel();
  bool InnerWord();
  bool Statement();
  bool CommentMark();
  /// A word behind which no bracket can go on.
  static bool IsCompleteWord(K kind);
  /// A blank in front of the bracket, and up to the end of the line nothing but words without an operator between them.
  [[nodiscard]] bool LooksLikeComment() const;

  std::span<const Token> tokens_;
  std::size_t at_;
  std::string_view line_;
  LineError& error_;
  std::string& help_;
};

}  // namespace ncport::frontend::sinumerik
