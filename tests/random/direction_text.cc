// The program as text of its own language, SINUMERIK or FANUC: printed, read back, run, printed again.
#include <string>
#include <vector>

#include "app/bind_inputs.h"
#include "ir/verify.h"
#include "tests/random/direction_checks.h"
#include "tests/random/runs.h"
#include "tests/random/texts.h"

namespace ncport::tests::random {

Finding CheckText(const Subject& subject, const Direction& /*direction*/) {
  const ir::Module& module = *subject.module;
  if (const auto violation = ir::FindViolation(module, {.names_resolved = true, .structure_built = true}))
    return {Verdict::kFails, "verify", *violation, {}};
  const std::vector<TextFile> texts = PrintAll(module, *subject.profile);

  SourceFiles files;
  ir::Module read;
  diag::Sink sink;
  if (!ReadAll(texts, *subject.profile, files, read, sink))
    return {Verdict::kFails, "read back, " + FirstError(sink), TextOf(sink), Listing(texts)};
  if (const auto violation = ir::FindViolation(read, {.names_resolved = true, .structure_built = true})) {
    return {Verdict::kFails, "verify what was read", *violation, Listing(texts)};
  }
  const std::vector<TextFile> again = PrintAll(read, *subject.profile);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (again.size() <= i || again[i].text != texts[i].text) {
      return {Verdict::kFails, "print again", FirstDifference(texts[i].text, again.size() <= i ? "" : again[i].text),
              Listing(texts)};
    }
  }

  Subject other = subject;
  other.module = &read;
  other.main = app::FindByName(read, module.View(module.programs[subject.main].name));
  if (!other.main.Valid()) return {Verdict::kFails, "main program lost", "no program of that name", Listing(texts)};
  const SkipSets skips = SkipSetsOf(module);
  for (std::uint32_t i = 0; i < skips.count; ++i) {
    Run first;
    RunProgram(subject, skips.sets[i], first);
    Run second;
    RunProgram(other, skips.sets[i], second);
    if (first.text != second.text || first.outcome != second.outcome) {
      return {Verdict::kFails, "trace, " + KindOfDifference(first.text, second.text),
              FirstDifference(first.text, second.text) + second.findings, Listing(texts)};
    }
  }
  return {};
}

}  // namespace ncport::tests::random
