#include "app/baseline.h"

namespace ncport::app {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// The block without blanks around it and without its number.
std::string_view WithoutNumber(std::string_view block) {
  const auto skip_blanks = [&] {
    while (!block.empty() && IsBlank(block.front())) block.remove_prefix(1);
  };
  skip_blanks();
  while (!block.empty() && IsBlank(block.back())) block.remove_suffix(1);
  if (block.size() < 2 || (block[0] != 'N' && block[0] != 'n') || !IsDigit(block[1])) return block;
  block.remove_prefix(1);
  while (!block.empty() && IsDigit(block.front())) block.remove_prefix(1);
  skip_blanks();
  return block;
}

}  // namespace

Baseline::Key Baseline::KeyOf(const diag::Diagnostic& finding, const SourceFiles& files) {
  return {std::string(files.Name(finding.at.file)), std::string(diag::InfoOf(finding.code).number),
          std::string(WithoutNumber(files.Line(finding.at.file, finding.at.line)))};
}

Baseline Baseline::Of(const diag::Sink& findings, const SourceFiles& files) {
  Baseline baseline;
  for (const diag::Diagnostic& finding : findings.All()) {
    if (finding.at.Valid()) ++baseline.counts_[KeyOf(finding, files)];
  }
  return baseline;
}

void Baseline::Silence(diag::Sink& findings, const SourceFiles& files) const {
  std::map<Key, std::uint32_t> left = counts_;
  findings.Remove([&](const diag::Diagnostic& finding) {
    if (!finding.at.Valid()) return false;
    const auto known = left.find(KeyOf(finding, files));
    if (known == left.end() || known->second == 0) return false;
    --known->second;
    return true;
  });
}

}  // namespace ncport::app
