#include "tests/random/refusals.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>

#include "base/diag/codes.h"
#include "base/result.h"

namespace ncport::tests::random {

namespace {

bool IsNameChar(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0 || std::isdigit(static_cast<unsigned char>(c)) != 0 ||
         c == '_' || c == '$' || c == '"';
}

std::set<std::string, std::less<>> ReadList() {
  std::ifstream file(NCPORT_SOURCE_DIR "/tests/refusals.txt");
  NCPORT_CHECK(file.good(), "tests/refusals.txt is missing");
  std::set<std::string, std::less<>> list;
  for (std::string line; std::getline(file, line);) {
    line = line.substr(0, line.find("  #"));
    if (!line.empty() && line[0] != '#') list.insert(line);
  }
  return list;
}

}  // namespace

std::string ReasonOf(const diag::Sink& sink) {
  const auto error = std::ranges::find_if(
      sink.All(), [](const diag::Diagnostic& finding) { return finding.severity == diag::Severity::kError; });
  if (error == sink.All().end()) return "no reason given";
  std::string_view text = error->message;
  text = text.substr(0, text.find(" has no equivalent in "));
  std::string reason = std::string(diag::InfoOf(error->code).number) + " ";
  // Names of the program and numbers change from one program to the next.
  while (!text.empty()) {
    const auto end = static_cast<std::size_t>(std::ranges::find_if_not(text, IsNameChar) - text.begin());
    if (end == 0) {
      reason += text[0];
      text.remove_prefix(1);
      continue;
    }
    const std::string_view name = text.substr(0, end);
    const bool number = name.find_first_not_of("0123456789") == std::string_view::npos;
    const bool code = name[0] == 'G' && name.find_first_not_of("0123456789", 1) == std::string_view::npos;
    // Variables of the control are not the program's own.
    const bool kept = end == 1 || code || name[0] == '$';
    reason += number ? "#" : kept ? name : "*";
    text.remove_prefix(end);
  }
  return reason;
}

bool IsListed(std::string_view reason) {
  static const std::set<std::string, std::less<>> list = ReadList();
  return list.contains(reason);
}

}  // namespace ncport::tests::random
