#include "backends/iso/tool_map.h"

#include <fmt/format.h>

namespace ncport::backends::iso {

void ToolMap::Select(std::uint32_t number, std::string_view name) { called_ = {true, number, std::string(name)}; }

std::string ToolMap::WordOf(const Called& tool) {
  return tool.name.empty() ? fmt::format("T{}", tool.number) : fmt::format("T=\"{}\"", tool.name);
}

// The target side of a [tools] line: T with digits; H, D and M6 on a mill. Anything else is not a tool call of flat
// blocks.
ToolMap::Answer ToolMap::Mapped(const dialects::WordMapping& mapping, std::string source) const {
  Answer answer;
  answer.source = std::move(source);
  std::string_view rest = mapping.target;
  while (!rest.empty()) {
    const std::size_t blank = rest.find(' ');
    const std::string_view word = rest.substr(0, blank);
    rest = blank == std::string_view::npos ? std::string_view{} : rest.substr(blank + 1);
    if (word.empty() || word == "M6" || word == "M06" || word == "G43") continue;
    std::int64_t number = 0;
    bool digits = word.size() > 1 && word.size() < 10;
    for (const char c : word.substr(1)) {
      digits = digits && c >= '0' && c <= '9';
      number = number * 10 + (c - '0');
    }
    if (digits && word[0] == 'T') {
      answer.tool = word.substr(1);
    } else if (digits && word[0] == 'H' && !lathe_) {
      answer.length = number;
    } else if (digits && word[0] == 'D' && !lathe_) {
      answer.radius = number;
    } else {
      answer.tool.clear();
      break;
    }
  }
  if (answer.tool.empty()) {
    answer.problem = diag::Code::kUnmappedTool;
    answer.help = fmt::format("[tools] gives \"{}\" for it; flat blocks take {}", mapping.target,
                              lathe_ ? "one word, such as \"T0101\"" : "words such as \"T1 H1 D1\"");
    return answer;
  }
  answer.offset_in_tool = lathe_;
  return answer;
}

ToolMap::Answer ToolMap::Tool() const {
  const std::string word = WordOf(called_);
  if (config_ != nullptr) {
    if (const dialects::WordMapping* mapping = config_->FindTool(word)) return Mapped(*mapping, word);
  }
  Answer answer;
  answer.source = word;
  if (called_.name.empty()) {
    answer.tool = fmt::format("{}", called_.number);
    return answer;
  }
  answer.problem = diag::Code::kUnmappedTool;
  answer.help = fmt::format("add to [tools] in ncport.toml: '{} D1' = \"{}\"", word, lathe_ ? "T0101" : "T1 H1 D1");
  return answer;
}

ToolMap::Answer ToolMap::Edge(std::uint32_t edge) const {
  Answer answer;
  if (!in_.known) {
    answer.source = fmt::format("D{}", edge);
    answer.problem = diag::Code::kOffsetWithoutTool;
    answer.help = fmt::format("write the tool call in front of it: D{} is an edge of the tool that is active", edge);
    return answer;
  }
  const std::string words = fmt::format("{} D{}", WordOf(in_), edge);
  if (config_ != nullptr) {
    if (const dialects::WordMapping* mapping = config_->FindTool(words)) return Mapped(*mapping, words);
  }
  answer.source = words;
  const bool two_digits_enough = !lathe_ || in_.number < 100;
  if (!in_.name.empty() || edge != 1 || !two_digits_enough) {
    answer.problem = diag::Code::kUnmappedTool;
    answer.help = fmt::format("add to [tools] in ncport.toml: '{}' = \"{}\", with the registers that hold this edge",
                              words, lathe_ ? "T0111" : "T1 H11 D11");
    return answer;
  }
  answer.problem = diag::Code::kAssumedOffset;
  answer.tool = fmt::format("{}", in_.number);
  answer.length = in_.number;
  answer.radius = in_.number;
  if (lathe_) {
    answer.tool = fmt::format("{:02}{:02}", in_.number, in_.number);
    answer.offset_in_tool = true;
    answer.assumed = "T" + answer.tool;
  } else {
    answer.assumed = fmt::format("T{0} H{0} D{0}", in_.number);
  }
  answer.help = fmt::format("if the registers are others, add to [tools] in ncport.toml: '{}' = \"...\"", words);
  return answer;
}

}  // namespace ncport::backends::iso
