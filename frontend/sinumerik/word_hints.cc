// What a character or word was meant to be that the tokens do not know.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "frontend/common/chars.h"
#include "frontend/sinumerik/hints.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

using diag::Code;

bool ExplainJumpWithZeros(std::string_view line, LineError& error, std::string& help) {
  const auto in_word = [&](std::size_t i) { return i < line.size() && (IsLetter(line[i]) || IsDigit(line[i])); };
  std::size_t begin = std::min<std::size_t>(error.begin, line.size());
  while (begin > 0 && in_word(begin - 1)) --begin;
  std::size_t end = begin;
  while (in_word(end)) ++end;
  std::string word(line.substr(begin, end - begin));
  if (word.find('0') == std::string::npos) return false;
  for (char& letter : word) letter = letter == '0' ? 'O' : Upper(letter);
  constexpr std::string_view kJumps[] = {"GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS"};
  if (std::ranges::find(kJumps, word) == std::end(kJumps)) return false;
  help = fmt::format("did you mean {}?", word);
  error = {.code = Code::kUnknownWord,
           .begin = static_cast<std::uint32_t>(begin),
           .length = static_cast<std::uint32_t>(end - begin)};
  error.help = help.c_str();
  return true;
}

namespace {

/// `M3 (TOOL #1)`, `(100%)`: start of a bracket around `at` that begins the block or stands apart behind a finished
/// word and closes at the end of the line, as comments of other controls do; npos: there is none.
std::size_t BracketedComment(std::string_view line, std::size_t at) {
  const std::size_t open = line.substr(0, at).find('(');
  const std::size_t last = line.find_last_not_of(" \t\r");
  if (open == std::string_view::npos || last == std::string_view::npos || line[last] != ')' ||
      line.substr(0, at).find_first_of("\"=;") < open)
    return std::string_view::npos;
  const std::size_t before = open == 0 ? std::string_view::npos : line.find_last_not_of(" \t", open - 1);
  if (before == std::string_view::npos || (before + 1 < open && IsDigit(line[before]))) return open;
  return std::string_view::npos;
}

}  // namespace

void ExplainWord(std::string_view line, LineError& error, std::string& help) {
  help.clear();
  if (error.begin < line.size()) {
    if (const std::size_t open = BracketedComment(line, error.begin); open != std::string_view::npos) {
      help = "a comment begins with ; and brackets hold expressions";
      error = {.code = Code::kUnexpectedText, .begin = static_cast<std::uint32_t>(open), .length = 1};
      error.help = help.c_str();
      return;
    }
  }
  if (error.begin >= line.size() || error.help != nullptr) return;
  if (ExplainJumpWithZeros(line, error, help)) return;
  if (error.code == Code::kUnknownCode) {
    // Its own text: no copy is needed.
    error.help = InsteadOfCode(line.substr(error.begin, error.length));
    return;
  }
  const char c = Upper(line[error.begin]);
  const std::string_view behind = line.substr(error.begin + 1);
  const auto digit_at = [&](std::size_t i) { return i < line.size() && IsDigit(line[i]); };
  const std::size_t next = error.begin + 1;
  if (error.code == Code::kUnknownAddress && c == 'E' && error.begin > 0 && digit_at(error.begin - 1) &&
      (digit_at(next) || (next < line.size() && (line[next] == '-' || line[next] == '+') && digit_at(next + 1)))) {
    // `2.5E-3`.
    std::size_t begin = error.begin;
    while (begin > 0 && (IsDigit(line[begin - 1]) || line[begin - 1] == '.')) --begin;
    std::size_t end = next + 1;
    while (digit_at(end)) ++end;
    help = fmt::format("the exponent is written with EX: {}EX{}", line.substr(begin, error.begin - begin),
                       line.substr(next, end - next));
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(end - begin)};
  } else if (error.code == Code::kUnclosedBracket && behind.find(';') != std::string_view::npos &&
             behind.find(line[error.begin] == '(' ? ')' : ']', behind.find(';')) != std::string_view::npos) {
    help = "; begins a comment, so the closing bracket behind it does not count";
  } else if (error.code == Code::kUnknownAddress && c == 'O' && error.begin > 0 && IsDigit(line[error.begin - 1])) {
    // `Y2O`: the letter O behind a digit.
    std::size_t begin = error.begin;
    while (begin > 0 && (IsDigit(line[begin - 1]) || line[begin - 1] == '.' || line[begin - 1] == '-')) --begin;
    if (begin > 0) --begin;
    std::size_t end = error.begin;
    while (end < line.size() && (IsDigit(line[end]) || line[end] == '.' || Upper(line[end]) == 'O')) ++end;
    std::string word(line.substr(begin, end - begin));
    for (char& letter : word) letter = Upper(letter) == 'O' ? '0' : letter;
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(end - begin)};
    help = fmt::format("did you mean {}?", word);
  } else if (error.code == Code::kUnknownAddress && c == 'O' && error.begin == 0 && digit_at(next)) {
    help = "programs have names, that of the file or %_N_NAME_MPF in front of them; is the digit 0 meant?";
  } else if (error.code == Code::kMissingValue && error.begin + error.length < line.size() &&
             line[error.begin + error.length] == '"') {
    const std::string_view text = line.substr(error.begin + error.length);
    const std::size_t quote = text.find('"', 1);
    if (quote != std::string_view::npos)
      help = fmt::format("a text stands behind =: {}={}", line.substr(error.begin, error.length),
                         text.substr(0, quote + 1));
  } else if (error.code == Code::kUnknownCharacter && c == '^') {
    help = "there is no sign for powers: POT(..) is the square";
  } else if (error.code == Code::kUnknownAddress && c == 'O' && error.begin > 0 &&
             (line[error.begin - 1] == '-' || line[error.begin - 1] == '+')) {
    // `Z-O5`: the letter O behind a sign.
    const std::size_t begin = error.begin > 1 && IsLetter(line[error.begin - 2]) ? error.begin - 2 : error.begin - 1;
    std::size_t end = error.begin;
    while (end < line.size() && (IsDigit(line[end]) || line[end] == '.' || Upper(line[end]) == 'O')) ++end;
    std::string word(line.substr(begin, end - begin));
    std::replace(word.begin() + 1, word.end(), 'O', '0');
    std::replace(word.begin() + 1, word.end(), 'o', '0');
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(end - begin)};
    help = fmt::format("did you mean {}?", word);
  } else if (error.code == Code::kUnknownAddress && c == 'O') {
    help = "the letter O; is the digit 0 meant?";
  } else if (error.code == Code::kUnknownCharacter && c == '!' && behind.starts_with('=')) {
    help = "not equal is written <>";
  } else if (error.code == Code::kUnknownCharacter && c == '#') {
    help = digit_at(next) ? "variables of this control are R parameters, R1, and names from DEF"
                          : "variables of this control are R parameters, R1 or R[..], and names from DEF";
  } else if (error.code == Code::kBadNumber && c == '\'') {
    // `'H3G'`: the digit that its base does not have.
    const bool hex = behind.starts_with('H') || behind.starts_with('h');
    const bool binary = behind.starts_with('B') || behind.starts_with('b');
    std::size_t wrong = 0;
    for (std::size_t i = 1; (hex || binary) && i < behind.size() && behind[i] != '\''; ++i) {
      const char digit = Upper(behind[i]);
      if (hex ? IsDigit(digit) || (digit >= 'A' && digit <= 'F') : digit == '0' || digit == '1') continue;
      // One wrong digit is a slip, letters alone are a word.
      if (++wrong > 1) {
        const std::string_view content = behind.substr(0, behind.find('\''));
        if (std::none_of(content.begin(), content.end(), IsDigit))
          help = "a text stands in double quotes; these mark hexadecimal and binary numbers";
        break;
      }
      help = fmt::format("{} is no digit of a {} number", behind[i], hex ? "hexadecimal" : "binary");
    }
    if (!hex && !binary) help = "a text stands in double quotes; these mark hexadecimal and binary numbers";
  } else if (error.code == Code::kMissingValue && (c == 'I' || c == 'L') && error.begin > 1 &&
             digit_at(error.begin - 1) && (behind.empty() || behind[0] <= ' ')) {
    // `X3I`: the letter for the digit 1 behind a number.
    std::size_t begin = error.begin;
    while (begin > 0 && (IsDigit(line[begin - 1]) || line[begin - 1] == '.' || line[begin - 1] == '-')) --begin;
    if (begin > 0) --begin;
    help = fmt::format("did you mean {}1?", line.substr(begin, error.begin - begin));
    error = {.code = Code::kBadNumber,
             .begin = static_cast<std::uint32_t>(begin),
             .length = static_cast<std::uint32_t>(error.begin + 1 - begin)};
  } else if (error.code == Code::kUnknownCharacter && c == '|') {
    help = "the word OR joins two conditions";
  } else if (error.code == Code::kUnexpectedText && (c == ')' || c == ']')) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < error.begin; ++i) {
      if (line[i] == '(' || line[i] == '[') open.push_back(i);
      if ((line[i] == ')' || line[i] == ']') && !open.empty()) open.pop_back();
    }
    if (open.empty()) {
      help = "no bracket is open here";
    } else {
      const bool round = line[open.back()] == '(';
      help = fmt::format("{} is closed by {}", round ? "(" : "[", round ? ")" : "]");
      error = {.code = Code::kUnclosedBracket, .begin = static_cast<std::uint32_t>(open.back()), .length = 1};
    }
  } else if (error.code == Code::kUnclosedString) {
    // Nothing behind the quote that could be the text.
    const std::size_t letter =
        std::find_if(behind.begin(), behind.end(), [](char b) { return IsLetter(b) || IsDigit(b); }) - behind.begin();
    if (letter == behind.size() || behind.find(';') < letter)
      help = "if a text ends here, its quote is missing in front";
  }
  if (!help.empty()) error.help = help.c_str();
}

}  // namespace ncport::frontend::sinumerik
