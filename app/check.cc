#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/ncport.h"
#include "app/pipeline.h"
#include "check/labels.h"

namespace ncport {
namespace {

constexpr std::string_view kIgnoreMark = "ncport: ignore";

bool MatchesAny(std::string_view number, const std::vector<std::string>& codes) {
  for (const std::string& code : codes) {
    if (!code.empty() && number.starts_with(code)) return true;
  }
  return false;
}

/// One `ncport: ignore NC3001` of a comment.
struct Ignore {
  SourceRange at;  // the whole block
  std::string code;
  bool used = false;
};

/// All ignores by (file, line). A comment line silences the block below it, a comment in a block its own.
using Ignores = std::multimap<std::pair<std::uint32_t, std::uint32_t>, Ignore>;

void AddCodes(std::string_view text, const SourceRange& comment, const SourceRange& silenced, Ignores& ignores) {
  std::size_t at = text.find(kIgnoreMark);
  if (at == std::string_view::npos) return;
  std::string_view rest = text.substr(at + kIgnoreMark.size());
  while (!rest.empty()) {
    const std::size_t begin = rest.find_first_not_of(" ,)");
    if (begin == std::string_view::npos) break;
    rest.remove_prefix(begin);
    const std::size_t end = rest.find_first_of(" ,)");
    const std::string_view code = rest.substr(0, end);
    if (!code.starts_with("NC")) break;
    ignores.emplace(std::pair{silenced.file.value, silenced.line}, Ignore{comment, std::string(code), false});
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end);
  }
}

Ignores CollectIgnores(const SourceFiles& files, const ir::Module& module) {
  Ignores ignores;
  for (const ir::Program& program : module.programs.All()) {
    for (const ir::BlockId id : program.blocks) {
      const ir::Block& block = module.blocks[id];
      const SourceRange own = module.RangeOf(block);
      SourceRange silenced = own;
      if (block.words.Empty()) {
        for (std::uint32_t below = id.value + 1; below < program.blocks.begin + program.blocks.count; ++below) {
          const ir::Block& next = module.blocks[ir::BlockId{below}];
          if (next.words.Empty()) continue;
          silenced = module.RangeOf(next);
          break;
        }
      }
      for (const ir::CommentId comment : block.comments)
        AddCodes(module.View(module.comments[comment].text), own, silenced, ignores);
      // The comment of a block that was not understood may still be part of its text.
      if ((block.flags & ir::Block::kRefused) != 0 && block.comments.Empty())
        AddCodes(files.Line(own.file, own.line), own, own, ignores);
    }
  }
  return ignores;
}

}  // namespace

Status Check(Context& context, const std::vector<Input>& inputs, const CheckOptions& options) {
  app::ProgramSet set;
  (void)app::ReadSet(context, inputs, options, app::ProfileNeed::kGuess, set);

  for (const ir::ProgramId program : set.module.programs.Ids()) {
    if (!set.module.programs[program].library)
      check::CheckLabels(set.module, program, set.profile.names.ignore_case.Or(true), context.findings);
  }

  Ignores ignores = CollectIgnores(context.files, set.module);
  context.findings.Remove([&](const diag::Diagnostic& finding) {
    const auto [first, last] = ignores.equal_range({finding.at.file.value, finding.at.line});
    for (auto it = first; it != last; ++it) {
      if (it->second.code != diag::InfoOf(finding.code).number) continue;
      it->second.used = true;
      return true;
    }
    return false;
  });
  for (const auto& [place, ignore] : ignores) {
    if (!ignore.used)
      context.findings.Report(diag::Code::kUselessIgnore, ignore.at).help =
          "take " + ignore.code + " out of the comment";
  }

  context.findings.Remove([&](const diag::Diagnostic& finding) {
    const std::string_view number = diag::InfoOf(finding.code).number;
    const bool selected = options.select.empty() || MatchesAny(number, options.select);
    return !selected || MatchesAny(number, options.ignore);
  });
  return context.findings.HasErrors() ? Status(Failure{}) : Status{};
}

}  // namespace ncport
