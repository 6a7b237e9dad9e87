// Slips that show in the line as a whole: frames without `:`, blocks that go on in the next line.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/hints.h"
#include "frontend/sinumerik/token_kind.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
namespace words = dialects::sinumerik;

namespace {

bool IsNameSign(char sign) { return IsLetter(sign) || IsDigit(sign) || sign == '_'; }

/// In `X,1 Y,2` the place of Y, if `at` is the blank before it; else npos. An operator of letters has no comma behind.
std::size_t AxisWithoutComma(std::string_view line, std::size_t at) {
  const std::size_t axis = line.find_first_not_of(" \t", at);
  if (axis == std::string_view::npos || axis == at || !IsNameSign(line[at - 1]) || !IsLetter(line[axis]))
    return std::string_view::npos;
  std::size_t end = axis;
  while (end < line.size() && IsNameSign(line[end])) ++end;
  return end < line.size() && line[end] == ',' ? axis : std::string_view::npos;
}

}  // namespace

void ExplainFrameSign(std::string_view line, std::uint32_t word, LineError& error, std::string& help) {
  constexpr std::string_view kFrames[] = {"CTRANS", "CROT", "CSCALE", "CMIRROR", "CFINE", "CROTS", "CRPL"};
  constexpr std::string_view kOperators = "+-*/";
  const auto wrong = [&](std::size_t at) {
    error = {.code = Code::kUnexpectedText, .begin = static_cast<std::uint32_t>(at), .length = 1};
    help = "frames are chained with :";
    error.help = help.c_str();
  };
  line = line.substr(0, line.find(';'));
  for (std::size_t at = word; at < line.size();) {
    std::size_t end = at;
    while (end < line.size() && IsNameSign(line[end])) ++end;
    if (end == at) {
      ++at;
      continue;
    }
    const std::string_view name = line.substr(at, end - at);
    const std::size_t open = line.find_first_not_of(" \t", end);
    const bool frame = std::any_of(std::begin(kFrames), std::end(kFrames),
                                   [&](std::string_view known) { return IsWord(name, known); });
    if (frame && open != std::string_view::npos && line[open] == '(') {
      const std::size_t before = at == 0 ? std::string_view::npos : line.find_last_not_of(" \t", at - 1);
      if (before != std::string_view::npos && kOperators.find(line[before]) != std::string_view::npos)
        return wrong(before);
      int depth = 0;
      std::size_t close = open;
      for (; close < line.size(); ++close) {
        if (const std::size_t axis = AxisWithoutComma(line, close); axis != std::string_view::npos) {
          wrong(axis);
          help = "a comma stands between axis and value";
          error.help = help.c_str();
          return;
        }
        if (line[close] == '(') ++depth;
        if (line[close] == ')' && --depth == 0) break;
      }
      const std::size_t next = close < line.size() ? line.find_first_not_of(" \t", close + 1) : std::string_view::npos;
      if (next != std::string_view::npos) {
        const bool glued = IsNameSign(line[next]) || line[next] == '$' || line[next] == '(';
        if (glued || kOperators.find(line[next]) != std::string_view::npos) return wrong(next);
        if (line[next] == ':' && line.find_first_not_of(" \t\r", next + 1) == std::string_view::npos)
          return wrong(next);
      }
      end = close;
    }
    at = std::max(end, at + 1);
  }
}

void ExplainFramePart(std::string_view line, LineError& error, std::string& help) {
  // Card 3.2: parts of a frame; 8.7: the settable ones by their number.
  constexpr std::string_view kSettable = "$P_UIFR[";
  constexpr std::string_view kParts[] = {"TR", "FI", "RT", "SC", "MI"};
  line = line.substr(0, line.find(';'));
  for (std::size_t at = 0; at + kSettable.size() < line.size(); ++at) {
    if (!IsWord(line.substr(at, kSettable.size()), kSettable)) continue;
    const std::size_t close = line.find(']', at);
    if (close == std::string_view::npos) return;
    const std::string_view inside = line.substr(at + kSettable.size(), close - at - kSettable.size());
    const std::size_t first = inside.find(','),
                      second = inside.find(',', first == std::string_view::npos ? first : first + 1);
    if (second == std::string_view::npos) continue;
    const std::size_t begin = inside.find_first_not_of(" \t", second + 1);
    if (begin == std::string_view::npos) continue;
    std::size_t end = begin;
    while (end < inside.size() && IsNameSign(inside[end])) ++end;
    const std::string_view part = inside.substr(begin, end - begin);
    const bool known = std::ranges::any_of(kParts, [&](std::string_view name) { return IsWord(part, name); });
    if (known || part.empty()) continue;
    error = {.code = Code::kUnknownWord,
             .begin = static_cast<std::uint32_t>(at + kSettable.size() + begin),
             .length = static_cast<std::uint32_t>(part.size())};
    help = "the parts of a frame are TR, FI, RT, SC and MI";
    error.help = help.c_str();
    return;
  }
}

void ExplainComment(std::span<const Token> tokens, std::string_view line, LineError& error, std::string& help) {
  // Of words that open a block of their own the rest is judged, not the whole.
  const auto opening = tokens.empty() ? TokenKind::kNone : static_cast<TokenKind>(tokens.front().kind);
  if (opening >= TokenKind::kDef && opening <= TokenKind::kRefused) return;
  line = line.substr(0, line.find(';'));
  std::size_t first = line.find_first_not_of(" \t");
  if (first != std::string_view::npos && (line[first] == 'N' || line[first] == 'n') && first + 1 < line.size() &&
      IsDigit(line[first + 1]))
    first = line.find_first_not_of(" \t", line.find_first_not_of("0123456789", first + 1));
  if (first == std::string_view::npos) return;
  int words = 0, letters = 0;
  std::size_t end = line.size();
  for (std::size_t at = first; at < line.size(); ++at) {
    if (IsLetter(line[at])) {
      if (++letters == 3) ++words;
      continue;
    }
    letters = 0;
    if (std::string_view(" \t\r-.,").find(line[at]) == std::string_view::npos) return;
    end = std::min(end, at);
  }
  if (words < 2) return;
  error = {.code = Code::kUnknownWord,
           .begin = static_cast<std::uint32_t>(first),
           .length = static_cast<std::uint32_t>(end - first)};
  help = "a comment begins with ;";
  error.help = help.c_str();
}

bool GoesOn(std::string_view line) {
  int depth = 0;
  bool text = false;
  std::string_view code;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i == line.size() || (line[i] == ';' && !text)) {
      code = line.substr(0, i);
      break;
    }
    if (line[i] == '"') text = !text;
    if (text) continue;
    if (line[i] == '(' || line[i] == '[') ++depth;
    if (line[i] == ')' || line[i] == ']') --depth;
  }
  while (!code.empty() && static_cast<unsigned char>(code.back()) <= ' ') code.remove_suffix(1);
  return depth > 0 && !text && (code.ends_with(',') || code.ends_with("<<") || code.ends_with('+'));
}

void ExplainSecondLine(std::string_view before, std::uint32_t line_before, std::string_view line, LineError& error,
                       std::string& help) {
  help = fmt::format("line {} goes on here, but a block ends with its line: write both in one", line_before);
  error.help = help.c_str();
  // A list of parameters: names behind types. The second one of a name is the finding, as no other block tells of it.
  std::vector<std::string_view> names;
  bool typed = false;
  const auto scan = [&](std::string_view text, bool second) {
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = at;
      while (end < text.size() && (IsLetter(text[end]) || IsDigit(text[end]) || text[end] == '_')) ++end;
      if (end == at) {
        ++at;
        continue;
      }
      const std::string_view word = text.substr(at, end - at);
      if (typed) {
        for (const std::string_view name : names) {
          if (!second || name.size() != word.size() ||
              !std::equal(name.begin(), name.end(), word.begin(), [](char a, char b) { return Upper(a) == Upper(b); }))
            continue;
          error = {.code = Code::kDoubleName,
                   .begin = static_cast<std::uint32_t>(at),
                   .length = static_cast<std::uint32_t>(word.size()),
                   .help = help.c_str()};
        }
        names.push_back(word);
      }
      typed = false;
      for (const auto& row : words::Types()) typed = typed || IsWord(word, row.text);
      at = end;
    }
  };
  scan(before, false);
  scan(line, true);
}

}  // namespace ncport::frontend::sinumerik
