// Words that stand where a definition wants a new name and cannot be one.
#include <fmt/format.h>

#include <algorithm>

#include "frontend/common/chars.h"
#include "frontend/sinumerik/hints.h"
#include "frontend/sinumerik/token_kind.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using K = TokenKind;

namespace {

constexpr std::string_view kRule = "a name begins with two letters, or with _ and a letter";

K KindOf(const Token& token) { return static_cast<K>(token.kind); }

/// True if the block wants a new name behind these tokens.
bool WantsName(std::span<const Token> before) {
  std::size_t first = 0;
  while (first < before.size() && (KindOf(before[first]) == K::kSkip || KindOf(before[first]) == K::kBlockNumber ||
                                   KindOf(before[first]) == K::kLabel))
    ++first;
  if (first >= before.size()) return false;
  const bool definition = KindOf(before[first]) == K::kDef;
  if (!definition && KindOf(before[first]) != K::kProc) return false;
  const K last = KindOf(before.back());
  if (last == K::kType) return true;
  int depth = 0;
  std::size_t open = 0;  // the last bracket of the outermost level
  bool typed = false;
  for (std::size_t i = first; i < before.size(); ++i) {
    const K kind = KindOf(before[i]);
    typed = typed || kind == K::kType || kind == K::kStringType;
    if (kind == K::kLeftParen || kind == K::kLeftBracket) {
      open = i;
      ++depth;
    }
    if (kind == K::kRightParen || kind == K::kRightBracket) --depth;
  }
  if (last == K::kRightBracket) return open > 0 && KindOf(before[open - 1]) == K::kStringType;
  return definition && typed && depth == 0 && last == K::kComma;
}

bool IsInName(char c) {
  return IsLetter(c) || IsDigit(c) || c == '_' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

bool ExplainNewName(std::span<const Token> tokens, std::string_view line, LineError& error, std::string& help) {
  std::size_t begin = std::min<std::size_t>(error.begin, line.size());
  while (begin > 0 && IsInName(line[begin - 1])) --begin;
  std::size_t end = begin;
  while (end < line.size() && IsInName(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  const auto behind =
      std::find_if(tokens.begin(), tokens.end(), [&](const Token& token) { return token.End() > begin; });
  if (word.empty() || !WantsName(tokens.first(static_cast<std::size_t>(behind - tokens.begin())))) return false;
  const auto is_name = [](char c) { return IsLetter(c) || IsDigit(c) || c == '_'; };
  const bool letter = IsLetter(word[0]);
  const bool number = letter && word.size() > 1 && std::all_of(word.begin() + 1, word.end(), IsDigit);
  LineError found = {.code = Code::kExpectedText,
                     .begin = static_cast<std::uint32_t>(begin),
                     .length = static_cast<std::uint32_t>(word.size()),
                     .detail = "a name"};
  const char head = Upper(word[0]);
  std::string text;
  if (!std::all_of(word.begin(), word.end(), is_name)) {
    text = "a name holds letters A to Z, digits and _";
  } else if (letter && word.size() == 1) {
    text = fmt::format("{} alone is an address; {}", word, kRule);
  } else if (number && head == 'R') {
    text = fmt::format("{} is an R parameter, which is always there; {}", word, kRule);
  } else if (number && (head == 'G' || head == 'M')) {
    found.code = Code::kReservedName;
    found.detail = nullptr;
  } else if (number && head == 'L') {
    text = fmt::format("{} is the name of a subprogram; {}", word, kRule);
  } else if (number && head == 'N') {
    text = fmt::format("{} is a block number; {}", word, kRule);
  } else if (number) {
    text = fmt::format("{} is the address {} with a number; {}", word, word[0], kRule);
  } else if (IsDigit(word[0]) || (letter && IsDigit(word[1]))) {
    text = std::string(kRule);
  } else {
    return false;
  }
  error = found;
  help = std::move(text);
  error.help = help.empty() ? nullptr : help.c_str();
  return true;
}

}  // namespace ncport::frontend::sinumerik
