#include "frontend/fanuc/hints.h"

#include <fmt/format.h>

#include <vector>

#include "base/near_name.h"
#include "dialects/fanuc/words.h"
#include "frontend/common/chars.h"

namespace ncport::frontend::fanuc {

namespace {

using diag::Code;

class Hints {
 public:
  Hints(std::string_view line, LineError& error, std::string& help) : line_(line), error_(error), help_(help) {}

  void Run() {
    if (error_.begin > line_.size()) return;
    (void)(LetterForDigit() || NoValue() || Comparison() || Condition() || Function() || Gap() || OtherComment());
    if (!help_.empty()) error_.help = help_.c_str();
  }

 private:
  [[nodiscard]] char At(std::size_t at) const { return at < line_.size() ? line_[at] : '\0'; }
  [[nodiscard]] std::string_view Rest() const { return line_.substr(error_.begin); }
  /// Last character in front of the error that is no blank, or NUL.
  [[nodiscard]] char Before() const {
    for (std::size_t at = error_.begin; at-- > 0;) {
      if (!IsBlank(line_[at])) return line_[at];
    }
    return '\0';
  }
  [[nodiscard]] bool InBrackets() const {
    int depth = 0;
    for (std::size_t at = 0; at < error_.begin; ++at) {
      if (line_[at] == '[') ++depth;
      if (line_[at] == ']') --depth;
    }
    return depth > 0;
  }
  template <class... Args>
  bool Say(fmt::format_string<Args...> text, Args&&... args) {
    help_ = fmt::format(text, std::forward<Args>(args)...);
    return true;
  }

  // `X1O.`: the letter O behind a digit.
  bool LetterForDigit() {
    if (Upper(At(error_.begin)) != 'O' || error_.begin == 0 || !IsDigit(line_[error_.begin - 1])) return false;
    std::size_t begin = error_.begin;
    const auto number = [](char c) { return IsDigit(c) || c == '.' || c == '-'; };
    while (begin > 0 && number(line_[begin - 1])) --begin;
    if (begin > 0 && (IsLetter(line_[begin - 1]) || line_[begin - 1] == '#')) --begin;
    std::size_t end = error_.begin;
    while (end < line_.size() && (number(line_[end]) || Upper(line_[end]) == 'O')) ++end;
    std::string word(line_.substr(begin, end - begin));
    for (char& c : word) c = Upper(c) == 'O' ? '0' : c;
    error_ = {.code = Code::kBadNumber,
              .begin = static_cast<std::uint32_t>(begin),
              .length = static_cast<std::uint32_t>(end - begin)};
    return Say("did you mean {}?", word);
  }

  // `X Y5.`: an address, a blank, and the next one.
  bool NoValue() {
    if (error_.code != Code::kUnknownWord || !IsLetter(At(error_.begin)) || !IsBlank(At(error_.begin + 1)))
      return false;
    error_.code = Code::kMissingValue;
    error_.length = 1;
    return Say("a number, a variable or an expression in [] follows the address");
  }

  // Signs of other languages for EQ NE GT GE LT LE.
  bool Comparison() {
    struct Sign {
      std::string_view text, word;
    };
    constexpr Sign kSigns[] = {{"==", "EQ"}, {"<>", "NE"}, {"!=", "NE"}, {">=", "GE"},
                               {"<=", "LE"}, {"=", "EQ"},  {">", "GT"},  {"<", "LT"}};
    // `<` also opens the name of a variable: the error is then where that name has no end.
    if (error_.code == Code::kExpectedText && error_.detail != nullptr && std::string_view(error_.detail) == ">") {
      for (std::size_t at = 1; at < error_.begin; ++at) {
        if (line_[at] != '<' || line_[at - 1] == '#') continue;
        error_ = {.code = Code::kUnknownCharacter, .begin = static_cast<std::uint32_t>(at), .length = 1};
      }
    }
    if (!InBrackets()) {
      return At(error_.begin) == '=' && Before() == '=' && Say("a value is set with one =");
    }
    for (const Sign& sign : kSigns) {
      if (Rest().starts_with(sign.text)) return Say("two values are compared with words: {}", sign.word);
    }
    return false;
  }

  // `IF #1 EQ 5`.
  bool Condition() {
    std::size_t end = error_.begin;
    while (end > 0 && IsBlank(line_[end - 1])) --end;
    // Round brackets make a comment of the condition.
    if (end > 0 && line_[end - 1] == ')') {
      const std::size_t open = line_.rfind('(', end - 1);
      end = open == std::string_view::npos ? end : open;
      while (end > 0 && IsBlank(line_[end - 1])) --end;
    }
    for (const std::string_view word : {"IF", "WHILE"}) {
      if (end >= word.size() && IsWord(line_.substr(end - word.size(), word.size()), word) && At(error_.begin) != '[')
        return Say("the condition stands in square brackets: {}[..]", word);
    }
    return false;
  }

  // `SQTR[..]`: letters in front of a bracket that make no function.
  bool Function() {
    if (error_.code != Code::kUnknownWord) return false;
    std::size_t begin = error_.begin;
    while (begin > 0 && IsLetter(line_[begin - 1])) --begin;
    std::size_t end = error_.begin;
    while (end < line_.size() && IsLetter(line_[end])) ++end;
    const std::string_view word = line_.substr(begin, end - begin);
    std::vector<std::string_view> names;
    if (At(end) == '[') {
      for (const auto& row : dialects::fanuc::Functions()) names.push_back(row.text);
    } else {
      names = {"IF", "GOTO", "WHILE", "THEN", "END", "DPRNT", "POPEN", "PCLOS"};
    }
    const std::string_view near = word.size() < 3 ? std::string_view() : NearName(word, names);
    if (near.empty()) return false;
    // The word itself, where it cannot stand: the condition in front of it is still open.
    if (IsWord(word, near)) {
      const std::size_t open = line_.substr(0, begin).rfind('[');
      if (open == std::string_view::npos || line_.substr(open, begin - open).find(']') != std::string_view::npos)
        return false;
      error_ = {.code = Code::kUnclosedBracket, .begin = static_cast<std::uint32_t>(open), .length = 1};
      return Say("] is missing before {}", near);
    }
    error_.begin = static_cast<std::uint32_t>(begin);
    error_.length = static_cast<std::uint32_t>(end - begin);
    return Say("did you mean {}?", near);
  }

  // A value is missing between two signs; a comma for the point.
  bool Gap() {
    const char c = At(error_.begin);
    const char before = Before();
    if (c == ',' && IsDigit(before) && IsDigit(At(error_.begin + 1))) return Say("the decimal sign is a point");
    if (error_.code != Code::kUnexpectedText && error_.code != Code::kExpectedText) return false;
    constexpr std::string_view kOperators = "+-*/=";
    if (before == '[' && c == ']') return Say("the brackets are empty: a value is missing");
    if (before != '\0' && kOperators.find(before) != std::string_view::npos &&
        (c == ']' || c == '\0' || kOperators.find(c) != std::string_view::npos))
      return Say("a value is missing behind {}", before);
    return false;
  }

  // A comment of another language.
  bool OtherComment() {
    const std::size_t sign = line_.find(';');
    return sign != std::string_view::npos && sign < error_.begin && Say("a comment stands in ( )");
  }

  std::string_view line_;
  LineError& error_;
  std::string& help_;
};

}  // namespace

void ExplainError(std::string_view line, LineError& error, std::string& help) {
  if (error.help != nullptr) return;
  help.clear();
  Hints(line, error, help).Run();
}

}  // namespace ncport::frontend::fanuc
