#include "app/pipeline.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "app/run_arguments.h"
#include "base/encoding.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
#include "ir/verify.h"

namespace ncport::app {
namespace {

/// Decodes one file and adds it; takes its bytes. Fails when it is no text.
Status AddFile(Context& context, Input& input, FileId& id) {
  if (input.bytes.size() > SourceFiles::kMaxBytes) {
    id = context.files.Add(input.name, {});
    context.findings.Report(diag::Code::kFileTooLarge, SourceRange{.file = id}, input.bytes.size(),
                            SourceFiles::kMaxBytes);
    return Failure{};
  }
  DecodedText decoded = DecodeText(std::move(input.bytes));
  id = context.files.Add(input.name, std::move(decoded.text));
  if (decoded.is_binary) {
    context.findings.Report(diag::Code::kBinaryFile, SourceRange{.file = id}, std::string(decoded.binary_reason));
    return Failure{};
  }
  if (decoded.control_bytes != 0)
    context.findings.Report(diag::Code::kControlBytes, SourceRange{.file = id}, decoded.control_bytes);
  return {};
}

/// Reads called programs until nothing new is asked for. `read`: names of the files that the set has; another set of
/// the same context may have read the same files.
Status ReadCalled(Context& context, const ReadSettings& settings, std::unordered_set<std::string>& read,
                  ProgramSet& set) {
  Status ok;
  if (!settings.find) return ok;
  std::set<std::string> asked;
  bool more = true;
  while (more) {
    more = false;
    for (const StringId callee : frontend::UnknownCallees(set.module, set.profile.language)) {
      const std::string name(set.module.View(callee));
      if (!asked.insert(name).second) continue;
      std::optional<Input> found = settings.find(name);
      if (!found || !read.insert(found->name).second) continue;
      FileId id;
      const Status added = AddFile(context, *found, id);
      ok &= added;
      if (added.Ok()) ok &= frontend::ReadFile(context.files, id, set.profile, {}, set.module, context.findings);
      more = true;
    }
  }
  return ok;
}

/// The language was guessed from the first file: another file that is certainly in another language is not read by it.
Status SameLanguage(Context& context, const std::vector<Input>& inputs, const ReadSettings& settings,
                    const dialects::Profile& profile) {
  if (!settings.from.empty() || (settings.config != nullptr && settings.config->from)) return {};
  Status ok;
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    const dialects::LanguageGuess guess = dialects::GuessLanguage(inputs[i].name, DecodeText(inputs[i].bytes).text);
    if (!guess.Certain() || guess.languages.front() == profile.language) continue;
    const std::string why =
        fmt::format("it seems to be {} ({}), and {} is read as {}", dialects::NameOf(guess.languages.front()),
                    guess.reasons.front(), inputs.front().name, dialects::NameOf(profile.language));
    context.findings.Report(diag::Code::kUnclearLanguage, SourceRange{}, inputs[i].name, why).help =
        "give files of one control at a time, or name the machine of all with --from";
    ok = Failure{};
  }
  return ok;
}

}  // namespace

Result<dialects::Profile> ChooseProfile(Context& context, const Input& first, const ReadSettings& settings,
                                        ProfileNeed need) {
  if (!settings.from.empty()) return dialects::LoadProfile(settings.from, context.files, context.findings);
  if (settings.config != nullptr && settings.config->from) {
    return dialects::LoadProfile(*settings.config->from, context.files, context.findings);
  }
  if (need == ProfileNeed::kNamed) {
    context.findings.Report(diag::Code::kNoProfile, SourceRange{}, first.name).help =
        "name the machine with --from, or `from` in ncport.toml; `ncport list profiles` shows them";
    return Failure{};
  }
  const DecodedText decoded = DecodeText(first.bytes);
  const dialects::LanguageGuess guess = dialects::GuessLanguage(first.name, decoded.text);
  NCPORT_TRY(dialects::NeedLanguage(guess, first.name, SourceRange{}, context.findings));
  const std::string name(dialects::UsualProfile(guess));
  std::string reason = guess.reasons.front();
  if (guess.lathe && reason.find(guess.lathe_reason) == std::string::npos) reason += ", " + guess.lathe_reason;
  context.findings.Report(diag::Code::kGuessedProfile, SourceRange{}, name, reason).help =
      "name the machine with --from";
  return dialects::LoadProfile(name, context.files, context.findings);
}

Status ReadSet(Context& context, std::vector<Input> inputs, const ReadSettings& settings, ProfileNeed need,
               ProgramSet& set, frontend::TokenListener* tokens) {
  NCPORT_TRY_ASSIGN(set.profile, ChooseProfile(context, inputs.front(), settings, need));
  NCPORT_TRY(SameLanguage(context, inputs, settings, set.profile));
  frontend::ReadOptions reading;
  reading.tokens = tokens;
  Status ok;
  std::unordered_set<std::string> named;
  for (Input& input : inputs) {
    if (!named.insert(input.name).second) continue;  // named twice
    FileId id;
    const Status added = AddFile(context, input, id);
    set.inputs.push_back(id);
    ok &= added;
    if (added.Ok()) ok &= frontend::ReadFile(context.files, id, set.profile, reading, set.module, context.findings);
  }
  ok &= ReadCalled(context, settings, named, set);
  frontend::ResolveNames(context.files, set.module, set.profile, context.findings);
  if (context.findings.HasErrors()) return ok & Failure{};
  // Larger ones are literal blocks out of a CAM system, which take few of the ways through the frontend.
  constexpr std::size_t kMostVerifiedWords = 200'000;
  if (set.module.words.Size() <= kMostVerifiedWords)
    ir::Verify(set.module, "after reading", {.names_resolved = true, .structure_built = true});
  return ok;
}

Result<exec::RunOptions> RunOptionsFor(Context& context, const ProgramSet& set, const RunSettings& settings) {
  exec::RunOptions options;
  options.max_blocks = settings.max_blocks;
  options.max_cells = settings.max_cells;
  options.max_text_bytes = settings.max_text_bytes;
  const bool ignore_case = set.profile.names.ignore_case.Or(true);
  if (!settings.call.empty()) {
    NCPORT_TRY(ApplyCall(settings.call, set.module, set.profile, options, context.findings));
  } else {
    for (const ir::ProgramId id : set.module.programs.Ids()) {
      if (set.module.programs[id].file != set.inputs.front()) continue;
      options.entry = id;
      break;
    }
    if (!options.entry.Valid()) {
      context.findings.Report(diag::Code::kUnknownProgram, SourceRange{.file = set.inputs.front()}, "to run");
      return Failure{};
    }
  }
  Status ok;
  for (const std::string& start : settings.set)
    ok &= ApplySet(start, set.module, ignore_case, options, context.findings);
  if (!settings.start.empty()) ok &= ApplyStart(settings.start, set.profile, options, context.findings);
  NCPORT_TRY(ok);
  return options;
}

void TakeCall(const exec::RunOptions& run, ProgramSet& set, dialects::Config& config) {
  if (!run.is_call) return;
  ir::Program& program = set.module.programs[run.entry];
  program.kind = ir::ProgramKind::kSub;
  for (const exec::EntryArgument& argument : run.arguments) {
    if (argument.letter != 0 && !argument.value.IsVacant())
      config.given.push_back(fmt::format("{}.{}", set.module.View(program.name), argument.letter));
  }
}

}  // namespace ncport::app
