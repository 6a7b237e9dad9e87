// Lines of flat ISO as tokens: a letter and a number each. Comments are set aside.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/profile.h"
#include "frontend/common/line_error.h"
#include "frontend/common/token.h"

namespace ncport::frontend::iso {

class TokenSource {
 public:
  /// Limits that keep untrusted text harmless; far above what a control takes.
  static constexpr std::uint32_t kMaxLineBytes = 4096;  // without comments
  static constexpr std::uint32_t kMaxTokens = 1000;

  /// A comment: its text without brackets, and the number of tokens in front of it.
  struct Comment {
    std::uint32_t begin, length;
    std::uint16_t tokens;
    std::uint16_t gap;
  };

  explicit TokenSource(const dialects::Profile& profile);

  /// Reads one line. What it returns is valid until the next call.
  void Lex(std::string_view line);
  [[nodiscard]] std::span<const Token> Tokens() const { return tokens_; }
  [[nodiscard]] std::span<const Comment> Comments() const { return comments_; }
  [[nodiscard]] std::uint32_t Indent() const { return indent_; }
  /// The first thing that is no word, or null.
  [[nodiscard]] const LineError* Error() const { return failed_ ? &error_ : nullptr; }

 private:
  bool LexComment(std::string_view line, std::size_t& at);
  bool LexWord(std::string_view line, std::size_t& at);
  bool Classify(Token& token, std::string_view text, char letter, bool whole);
  bool ClassifyCode(Token& token, std::string_view text, char letter, bool whole);
  bool Fail(diag::Code code, std::size_t begin, std::size_t length, const char* help = nullptr);

  std::string limit_code_;  // "G92": the code of the profile's speed limit, upper case; empty: none
  std::uint16_t axes_ = 0;  // bit per axis of the machine
  bool lathe_;
  std::vector<Token> tokens_;
  std::vector<Comment> comments_;
  std::uint32_t indent_ = 0;
  bool failed_ = false;
  LineError error_;
};

}  // namespace ncport::frontend::iso
