#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/baseline.h"
#include "app/ncport.h"
#include "app/pipeline.h"
#include "app/value_rule_options.h"
#include "backends/translate.h"
#include "base/letter_case.h"
#include "check/rules.h"
#include "check/structure_rules.h"
#include "check/value_rules.h"
#include "dialects/machine.h"

namespace ncport {
namespace {

/// Codes that `list` names and that no diagnostic begins with are wrong usage (contracts section 2).
Status KnownCodes(const std::vector<std::string>& list, std::string_view option, diag::Sink& sink) {
  Status ok;
  for (const std::string& code : list) {
    bool known = code.size() > 2;
    if (known) {
      const auto& all = diag::AllInfos();
      known =
          std::any_of(all.begin(), all.end(), [&](const diag::Info& info) { return info.number.starts_with(code); });
    }
    if (known) continue;
    sink.Report(diag::Code::kBadOption, SourceRange{}, std::string(option), "there is no diagnostic " + code).help =
        "`ncport list rules` shows all";
    ok = Failure{};
  }
  return ok;
}

bool MatchesAny(std::string_view number, const std::vector<std::string>& codes) {
  for (const std::string& code : codes) {
    if (!code.empty() && number.starts_with(code)) return true;
  }
  return false;
}

/// One `ncport: ignore NC3001` of a comment.
struct Ignore {
  SourceRange at;    // the whole block
  std::string code;  // empty: none is named
  bool used = false;
};

/// All ignores by (file, line). A comment line silences the block below it, a comment in a block its own.
using Ignores = std::multimap<std::pair<std::uint32_t, std::uint32_t>, Ignore>;

/// Where the mark stands in `text`, in any case (some controls have capital letters only) and with any blanks around
/// its colon.
struct Mark {
  std::size_t begin = std::string_view::npos;  // nowhere
  std::size_t end = 0;
};

Mark FindMark(std::string_view text) {
  constexpr std::string_view kParts[] = {"ncport", ":", "ignore"};
  for (std::size_t begin = 0; begin < text.size(); ++begin) {
    std::size_t at = begin;
    bool found = true;
    for (const std::string_view part : kParts) {
      while (at > begin && at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
      found =
          found && at + part.size() <= text.size() &&
          std::equal(part.begin(), part.end(), text.substr(at).begin(), [](char a, char b) { return a == Lower(b); });
      at += part.size();
      if (!found) break;
    }
    if (found) return {begin, at};
  }
  return {};
}

void AddCodes(std::string_view text, SourceRange comment, std::string_view line, const SourceRange& silenced,
              Ignores& ignores) {
  const Mark mark = FindMark(text);
  if (mark.begin == std::string_view::npos) return;
  if (const Mark there = FindMark(line); there.begin != std::string_view::npos) {
    comment.begin = static_cast<std::uint32_t>(there.begin);
    comment.end = static_cast<std::uint32_t>(there.end);
  }
  std::string_view rest = text.substr(mark.end);
  bool any = false;
  for (;;) {
    const std::size_t begin = rest.find_first_not_of(" \t,)");
    if (begin == std::string_view::npos) break;
    rest.remove_prefix(begin);
    const std::size_t end = std::min(rest.find_first_of(" \t,)"), rest.size());
    std::string code(rest.substr(0, end));
    for (char& c : code) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (!code.starts_with("NC")) break;
    ignores.emplace(std::pair{silenced.file.value, silenced.line}, Ignore{comment, std::move(code), false});
    any = true;
    rest.remove_prefix(end);
  }
  if (!any) ignores.emplace(std::pair{silenced.file.value, silenced.line}, Ignore{comment, {}, false});
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
        AddCodes(module.View(module.comments[comment].text), own, files.Line(own.file, own.line), silenced, ignores);
      // The comment of a block that was not understood may still be part of its text.
      if ((block.flags & ir::Block::kRefused) != 0 && block.comments.Empty())
        AddCodes(files.Line(own.file, own.line), own, files.Line(own.file, own.line), own, ignores);
    }
  }
  return ignores;
}

/// One wrong block gives one finding: its first error, and no warnings beside an error but for ignores without effect.
/// What the options leave out still counts, so that the findings of a block do not depend on them.
void OneABlock(diag::Sink& findings) {
  using Line = std::pair<std::uint32_t, std::uint32_t>;
  const auto line_of = [](const diag::Diagnostic& finding) { return Line{finding.at.file.value, finding.at.line}; };
  std::map<Line, const diag::Diagnostic*> errors;
  for (const diag::Diagnostic& finding : findings.All()) {
    if (finding.at.Valid() && finding.severity == diag::Severity::kError)
      errors.try_emplace(line_of(finding), &finding);
  }
  findings.Remove([&](const diag::Diagnostic& finding) {
    if (!finding.at.Valid() || finding.code == diag::Code::kUselessIgnore) return false;
    const auto error = errors.find(line_of(finding));
    return error != errors.end() && error->second != &finding;
  });
}

/// Rules over the flow graphs and over the values of variables.
void CheckFlow(Context& context, const app::ProgramSet& set, const CheckOptions& options,
               const check::Subject& subject) {
  for (const ir::ProgramId program : set.module.programs.Ids()) {
    if (set.module.programs[program].library) continue;
    check::CheckBlockLengths(subject, program, context.files, context.findings);
    check::CheckUnreachable(set.module, program, subject.graphs, context.findings);
    check::CheckComparisons(set.module, program, context.findings);
    check::CheckExactLoopEnds(set.module, program, subject.graphs, context.findings);
  }
  const check::ValueRuleOptions rules = app::ValueRuleOptionsFor(context, set, options.config);
  (void)check::CheckValues(set.module, subject.machine, subject.graphs, subject.calls, subject.modal, rules,
                           context.findings);
}

/// What the control takes and only ncport does not translate is no mistake of the program: check mentions it.
void MentionUntranslated(const SourceFiles& files, diag::Sink& findings) {
  std::vector<diag::Diagnostic> untranslated;
  findings.Remove([&](const diag::Diagnostic& finding) {
    if (finding.code != diag::Code::kNotSupported || !finding.at.Valid()) return false;
    untranslated.push_back(finding);
    return true;
  });
  for (diag::Diagnostic& old : untranslated) {
    const std::string_view word = files.Line(old.at.file, old.at.line).substr(old.at.begin, old.at.end - old.at.begin);
    diag::Diagnostic& finding = findings.ReportAs(diag::Severity::kInfo, old.code, old.at, word);
    finding.help = std::move(old.help);
    finding.notes = std::move(old.notes);
  }
}

/// What `translate` to `target` would refuse.
void CheckPortability(Context& context, const app::ProgramSet& set, const dialects::Profile& target,
                      const CheckOptions& options) {
  const ir::Machine machine = dialects::MachineFor(set.profile);
  const dialects::Config config = options.config != nullptr ? options.config->For(options.target) : dialects::Config{};
  backends::Translation translation;
  (void)backends::Raise({&set.module, &set.profile, &machine, &target, &config}, translation, context.findings);
}

}  // namespace

Status Check(Context& context, std::vector<Input> inputs, const CheckOptions& options) {
  Status known = KnownCodes(options.select, "select", context.findings);
  known &= KnownCodes(options.ignore, "ignore", context.findings);
  NCPORT_TRY(known);
  std::optional<dialects::Profile> target;
  if (!options.target.empty()) {
    NCPORT_TRY_ASSIGN(target, dialects::LoadProfile(options.target, context.files, context.findings));
  }
  app::Baseline baseline;
  if (options.baseline != nullptr) {
    NCPORT_TRY_ASSIGN(baseline,
                      app::Baseline::Parse(options.baseline->bytes, options.baseline->name, context.findings));
  }
  app::ProgramSet set;
  const Status read = app::ReadSet(context, std::move(inputs), options, app::ProfileNeed::kGuess, set);
  if (set.inputs.empty()) return read & Failure{};
  const ir::ModalState entry = options.config != nullptr ? options.config->entry : ir::ModalState{};
  const check::Subject subject(set.module, set.profile, entry);
  MentionUntranslated(context.files, context.findings);
  check::CheckPrograms(subject, context.findings);

  CheckFlow(context, set, options, subject);
  // What is wrong in its own language is refused for that already.
  if (target && !context.findings.HasErrors()) CheckPortability(context, set, *target, options);

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
          ignore.code.empty() ? "name the code: ncport: ignore NC3001" : "take " + ignore.code + " out of the comment";
  }

  OneABlock(context.findings);

  context.findings.Remove([&](const diag::Diagnostic& finding) {
    const std::string_view number = diag::InfoOf(finding.code).number;
    const bool selected = options.select.empty() || MatchesAny(number, options.select);
    return !selected || MatchesAny(number, options.ignore);
  });
  baseline.Silence(context.findings, context.files);
  if (options.new_baseline != nullptr) {
    const app::Baseline all = app::Baseline::Of(context.findings, context.files);
    *options.new_baseline = all.Render();
    all.Silence(context.findings, context.files);
  }
  return context.findings.HasErrors() ? Status(Failure{}) : Status{};
}

}  // namespace ncport
