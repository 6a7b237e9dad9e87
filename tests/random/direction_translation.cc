// Translations: raised, printed, read back and compared over both programs.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/comparison.h"
#include "backends/translate.h"
#include "tests/random/direction_checks.h"
#include "tests/random/refusals.h"
#include "tests/random/runs.h"
#include "tests/random/texts.h"

namespace ncport::tests::random {

namespace {

std::string ListingOf(const std::vector<backends::OutputFile>& files) {
  std::string all;
  for (const backends::OutputFile& file : files) all += fmt::format("--- {}\n{}", file.name, file.text);
  return all;
}

}  // namespace

Finding CheckTranslation(const Subject& subject, const Direction& /*direction*/) {
  const std::vector<TextFile> texts = PrintCalled(*subject.module, subject.main, *subject.profile);
  Context context;
  app::ProgramSet set;
  set.profile = *subject.profile;
  if (!ReadAll(texts, set.profile, context.files, set.module, context.findings))
    return {Verdict::kFails, "read the source, " + FirstError(context.findings), TextOf(context.findings),
            Listing(texts)};
  const ir::ProgramId entry =
      set.module.FindProgram(subject.module->View(subject.module->programs[subject.main].name), true);
  if (!entry.Valid()) return {Verdict::kFails, "main program lost", "no program of that name", Listing(texts)};

  backends::Translation translation;
  if (!backends::Raise({&set.module, &set.profile, subject.machine, subject.target, subject.config}, translation,
                       context.findings)) {
    return {Verdict::kRefused, ReasonOf(context.findings), TextOf(context.findings), Listing(texts)};
  }
  const std::vector<backends::OutputFile> files = backends::Print(*subject.target, translation, {});
  // Values of arguments stay as written: what they may be is known to the generator alone.
  app::ComparisonSetup setup;
  setup.max_blocks = subject.max_blocks * 4;
  setup.vary_inputs = false;
  exec::RunOptions run;
  run.entry = entry;
  std::vector<prove::Input> varied;
  const prove::Verification verification = app::CompareTranslation(context, set, *subject.machine, run, *subject.target,
                                                                   translation, files, subject.config, setup, varied);
  const auto artefact = [&] { return Listing(texts) + ListingOf(files); };
  if (verification.difference) {
    return {Verdict::kFails, "compare, " + KindOfText(verification.difference->what),
            fmt::format("{} ({})", verification.difference->what, verification.difference_start), artefact()};
  }
  // Branches that no run took are no fault here: the next program takes others.
  if (verification.sets_run == 0 || (verification.open_branches.empty() && !verification.compared))
    return {Verdict::kFails, "not compared, " + KindOfText(verification.not_compared),
            verification.not_compared + "\n" + TextOf(context.findings), artefact()};
  return {};
}

}  // namespace ncport::tests::random
