// Translations: raised, printed, read back and compared over both programs; and the output of one translated once more,
// back to the language that it came from.
#include <string>
#include <vector>

#include "tests/random/direction_checks.h"
#include "tests/random/port.h"
#include "tests/random/shop.h"
#include "tests/random/texts.h"

namespace ncport::tests::random {

Finding CheckTranslation(const Subject& subject, const Direction& /*direction*/) {
  const ir::Module& module = *subject.module;
  Port port;
  port.target = subject.target;
  port.config = subject.config;
  if (Finding finding = ReadSource(port, PrintCalled(module, subject.main, *subject.profile), *subject.profile,
                                   module.View(module.programs[subject.main].name));
      finding.verdict != Verdict::kAgrees)
    return finding;
  if (Finding finding = Translate(port); finding.verdict != Verdict::kAgrees) return finding;
  return Compare(port, subject.max_blocks * 4);
}

Finding CheckTranslationBack(const Subject& subject, const Direction& /*direction*/) {
  const ir::Module& module = *subject.module;
  Port there;
  there.target = subject.target;
  there.config = subject.config;
  if (Finding finding = ReadSource(there, PrintCalled(module, subject.main, *subject.profile), *subject.profile,
                                   module.View(module.programs[subject.main].name));
      finding.verdict != Verdict::kAgrees)
    return finding;
  // What has no form there is counted by the direction that goes there.
  if (Translate(there).verdict != Verdict::kAgrees) return {Verdict::kNoProgram, {}, {}, {}};
  std::string main;
  for (const backends::ProgramName& name : there.translation.programs) {
    if (name.main) main = name.target;
  }
  std::vector<TextFile> texts;
  for (const backends::OutputFile& file : there.files)
    texts.push_back({file.name.empty() ? "programs.nc" : file.name, file.text});

  const dialects::Config config = ShopDataBack(*subject.target);
  Port back;
  back.target = subject.profile;
  back.config = &config;
  if (Finding finding = ReadSource(back, std::move(texts), backends::ForReading(*subject.target), main);
      finding.verdict != Verdict::kAgrees)
    return finding;
  if (Finding finding = Translate(back); finding.verdict != Verdict::kAgrees) {
    finding.artefact = Listing(there.texts) + finding.artefact;
    return finding;
  }
  Finding finding = Compare(back, subject.max_blocks * 16);
  if (!finding.artefact.empty()) finding.artefact = Listing(there.texts) + finding.artefact;
  return finding;
}

}  // namespace ncport::tests::random
