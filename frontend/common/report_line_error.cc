#include "frontend/common/report_line_error.h"

#include <fmt/format.h>

#include <string>

namespace ncport::frontend {

void ReportLineError(const LineError& error, std::string_view line, SourceRange at, diag::Sink& sink,
                     std::string_view alarm) {
  using diag::Code;
  at.begin = error.begin;
  at.end = error.begin + error.length;
  const auto slice = [&](std::uint32_t begin, std::uint32_t length) {
    return begin <= line.size() ? line.substr(begin, length) : std::string_view();
  };
  // The place says where the word is; a very long one needs no second copy in the message.
  constexpr std::size_t kLongestWord = 200;
  const auto shortened = [](std::string_view text) {
    if (text.size() <= kLongestWord) return std::string(text);
    std::size_t end = kLongestWord;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return std::string(text.substr(0, end)) + "...";
  };
  const std::string cut = shortened(slice(error.begin, error.length));
  std::string_view word = cut;
  if (word.empty()) word = error.code == Code::kUnexpectedText ? "end of the block" : "the end of the block";
  const std::string_view detail = error.detail != nullptr ? error.detail : "";
  diag::Diagnostic* finding = nullptr;
  switch (error.code) {
    case Code::kExpectedText:
      finding = &sink.Report(error.code, at, detail, word);
      break;
    case Code::kUnclosedString:
      finding = &sink.Report(error.code, at);
      break;
    case Code::kWordConflict:
      finding = &sink.Report(error.code, at, shortened(slice(error.other_begin, error.other_length)), word);
      break;
    case Code::kNestingLimit:
      finding = &sink.Report(error.code, at, detail, error.limit);
      break;
    case Code::kBlockTooLong:
      finding = &sink.Report(error.code, at, line.size(), error.limit);
      break;
    case Code::kTooManyWords:
      finding = &sink.Report(error.code, at, error.limit);
      break;
    case Code::kNameTooLong:
      finding = &sink.Report(error.code, at, word, error.limit);
      break;
    case Code::kOutOfRange:
      finding = &sink.Report(error.code, at, word, detail);
      break;
    case Code::kTypeMismatch:
      finding = &sink.Report(error.code, at, detail, word);
      break;
    case Code::kArgumentCount: {
      const std::string range = error.other_begin == error.other_length
                                    ? fmt::format("{}", error.other_begin)
                                    : fmt::format("{} to {}", error.other_begin, error.other_length);
      finding = &sink.Report(error.code, at, word, range, error.limit);
      break;
    }
    default:
      finding = &sink.Report(error.code, at, word);
      break;
  }
  if (error.help != nullptr) finding->help = error.help;
  finding->control = alarm;
  if (error.code == Code::kSplitOperator) {
    std::string joined;
    for (const char c : word) {
      if (c != ' ' && c != '\t') joined.push_back(c);
    }
    finding->fixes.push_back({at, joined});
  }
}

}  // namespace ncport::frontend
