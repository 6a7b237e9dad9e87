// Reads the tokens of one line of a dump. The first failure sticks: what is read afterwards is empty and changes
// nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace ncport::ir {

class DumpScanner {
 public:
  void Start(std::string_view line);

  [[nodiscard]] bool Failed() const { return failed_; }
  /// What was expected, and the place of the failure.
  [[nodiscard]] const std::string& Expected() const { return expected_; }
  [[nodiscard]] std::uint32_t Begin() const { return static_cast<std::uint32_t>(at_); }
  /// The text from here on, shortened, for messages.
  [[nodiscard]] std::string Found() const;
  void Fail(std::string expected);
  /// Fails at a place already passed.
  void FailAt(std::size_t begin, std::string expected) {
    if (!failed_) at_ = begin;
    Fail(std::move(expected));
  }

  /// The next character behind blanks; NUL at the end of the line or before a comment.
  char Peek();
  /// The character behind that one, without skipping blanks.
  [[nodiscard]] char PeekSecond() const { return at_ + 1 < line_.size() ? line_[at_ + 1] : '\0'; }
  bool AtEnd() { return Peek() == '\0'; }

  /// Takes `symbol` if it comes next.
  bool Take(std::string_view symbol);
  void Need(std::string_view symbol);
  /// Takes `keyword` if it comes next and ends there.
  bool TakeKeyword(std::string_view keyword);
  /// Small letters, digits, `-`; empty if there are none.
  std::string_view Keyword();
  /// The keyword that comes next, not taken.
  std::string_view PeekKeyword();

  /// A whole number up to `max`.
  std::uint32_t Number(std::uint32_t max);
  /// A number in any form that std::from_chars knows. Must be finite.
  double Double();
  /// Bare or in quotes.
  std::string_view Name();
  [[nodiscard]] bool AtName();
  /// In quotes.
  std::string_view Text();
  /// `~2`; 1 if there is none.
  std::uint32_t Ordinal();

  /// For ParseDecimal: the raw text from here on, and how much of it was used.
  std::string_view Rest();
  void Advance(std::size_t count) { at_ += count; }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
  bool failed_ = false;
  std::string expected_;
  std::string text_;  // of the last Name or Text with escapes
};

}  // namespace ncport::ir
