#include "backends/fanuc/tool_words.h"

#include <algorithm>
#include <charconv>

namespace ncport::backends::fanuc {

namespace {

std::optional<std::uint32_t> NumberOf(std::string_view digits) {
  std::uint32_t number = 0;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || last != digits.data() + digits.size()) return std::nullopt;
  return number;
}

}  // namespace

bool HoldsWord(std::string_view line, std::string_view word) {
  if (word.empty()) return false;
  for (std::size_t at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || line[at - 1] == ' ') && (end == line.size() || line[end] == ' ')) return true;
  }
  return false;
}

std::uint32_t NumberBehind(std::string_view words, char letter, std::size_t* digits) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != letter || (i > 0 && words[i - 1] != ' ')) continue;
    std::uint32_t number = 0;
    const char* first = words.data() + i + 1;
    const auto [last, error] = std::from_chars(first, words.data() + words.size(), number);
    if (error != std::errc{}) continue;
    if (digits != nullptr) *digits = static_cast<std::size_t>(last - first);
    return number;
  }
  return 0;
}

std::uint32_t ToolSuffix(std::string_view words) {
  std::size_t at = words.find('T');
  if (at == std::string_view::npos) return 0;
  at = words.find_first_not_of("0123456789", at + 1);
  if (at == std::string_view::npos || words[at] != '.') return 0;
  std::uint32_t suffix = 0;
  std::uint32_t unit = 10;
  for (++at; at < words.size() && words[at] >= '0' && words[at] <= '9'; ++at, unit /= 10)
    suffix += unit * static_cast<std::uint32_t>(words[at] - '0');
  return suffix;
}

std::optional<MillToolWords> ParseMillTool(std::string_view words) {
  MillToolWords parsed;
  bool has_tool = false;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    const std::string_view word = words.substr(0, end);
    words.remove_prefix(std::min(end + 1, words.size()));
    if (word.empty()) continue;
    const auto number = NumberOf(word.substr(1));
    if (word[0] == 'H' && number) {
      parsed.length = *number;
      continue;
    }
    if (word[0] == 'D' && number) {
      parsed.radius = *number;
      continue;
    }
    if (word[0] == 'T' && number) {
      parsed.tool = *number;
      has_tool = true;
    }
    parsed.call += (parsed.call.empty() ? "" : " ") + std::string(word);
  }
  if (!has_tool) return std::nullopt;
  return parsed;
}

bool HasChange(std::string_view call) {
  return call.find(" M6") != std::string_view::npos || call.find(" M06") != std::string_view::npos;
}

void TellKeptOffset(const RaiseInput& input, Translation& out) {
  if (input.source_profile != nullptr && input.source_profile->language == input.profile->language) return;
  constexpr std::string_view kText =
      "G53 leaves the tool offset out, in the source it stays in machine coordinates unless D0 is in force: where one "
      "is in force the place differs by it (sinumerik-12, row 30)";
  if (std::ranges::find(out.assumptions, kText) == out.assumptions.end()) out.assumptions.emplace_back(kText);
}

}  // namespace ncport::backends::fanuc
