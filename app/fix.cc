// Repairs that findings offer, put into the texts: `check --fix`.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "app/ncport.h"

namespace ncport {
namespace {

using Place = std::pair<std::uint32_t, std::uint32_t>;  // line, first byte

Place PlaceOf(const diag::Fix& fix) { return {fix.at.line, fix.at.begin}; }

/// Puts `fixes`, ordered by place, into the text of `file`; `done` gets those that were.
std::string Repaired(const SourceFiles& files, FileId file, const std::vector<const diag::Fix*>& fixes,
                     std::set<const diag::Fix*>& done) {
  std::string repaired;
  auto next = fixes.begin();
  for (std::uint32_t line = 1; line <= files.LineCount(file); ++line) {
    const std::string_view text = files.Line(file, line);
    std::size_t at = 0;
    for (; next != fixes.end() && (*next)->at.line == line; ++next) {
      const SourceRange& range = (*next)->at;
      if (range.begin < at || range.end > text.size()) continue;
      repaired += text.substr(at, range.begin - at);
      repaired += (*next)->replacement;
      at = range.end;
      done.insert(*next);
    }
    repaired += text.substr(at);
    repaired += files.LineEnd(file, line);
  }
  return repaired;
}

}  // namespace

std::vector<FixedFile> Fix(Context& context) {
  std::map<std::uint32_t, std::vector<const diag::Fix*>> by_file;
  for (const diag::Diagnostic& finding : context.findings.All()) {
    for (const diag::Fix& fix : finding.fixes) by_file[fix.at.file.value].push_back(&fix);
  }
  std::vector<FixedFile> made;
  std::set<const diag::Fix*> done;
  for (auto& [number, fixes] : by_file) {
    std::ranges::stable_sort(fixes, {}, [](const diag::Fix* fix) { return PlaceOf(*fix); });
    FileId file;
    file.value = number;
    const std::size_t before = done.size();
    std::string text = Repaired(context.files, file, fixes, done);
    if (done.size() == before) continue;
    made.push_back({std::string(context.files.Name(file)), std::string(context.files.Text(file)), std::move(text),
                    done.size() - before});
  }
  context.findings.Remove([&](const diag::Diagnostic& finding) {
    return !finding.fixes.empty() &&
           std::ranges::all_of(finding.fixes, [&](const diag::Fix& fix) { return done.contains(&fix); });
  });
  return made;
}

}  // namespace ncport
