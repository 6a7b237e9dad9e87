#include "tests/random/port.h"

#include <fmt/format.h>

#include <utility>

#include "app/bind_inputs.h"
#include "app/comparison.h"
#include "dialects/machine.h"
#include "tests/random/refusals.h"
#include "tests/random/runs.h"

namespace ncport::tests::random {

Finding ReadSource(Port& port, std::vector<TextFile> texts, const dialects::Profile& profile, std::string_view main) {
  port.texts = std::move(texts);
  port.set.profile = profile;
  port.machine = dialects::MachineFor(profile);
  if (!ReadAll(port.texts, profile, port.context.files, port.set.module, port.context.findings))
    return {Verdict::kFails, "read the source, " + FirstError(port.context.findings), TextOf(port.context.findings),
            Listing(port.texts)};
  port.entry = app::FindByName(port.set.module, main);
  if (!port.entry.Valid())
    return {Verdict::kFails, "main program lost", "no program of that name", Listing(port.texts)};
  return {};
}

Finding Translate(Port& port) {
  if (!backends::Raise({&port.set.module, &port.set.profile, &port.machine, port.target, port.config}, port.translation,
                       port.context.findings)) {
    return {Verdict::kRefused, ReasonOf(port.context.findings), TextOf(port.context.findings), Listing(port.texts)};
  }
  port.files = backends::Print(*port.target, port.translation, {});
  return {};
}

Finding Compare(Port& port, std::uint64_t max_blocks) {
  app::ComparisonSetup setup;
  setup.max_blocks = max_blocks;
  setup.vary_inputs = false;
  exec::RunOptions run;
  run.entry = port.entry;
  std::vector<prove::Input> varied;
  const prove::Verification verification =
      app::CompareTranslation(port.context, port.set, port.machine, run, *port.target, port.translation, port.files,
                              port.config, setup, varied);
  if (verification.difference) {
    return {Verdict::kFails, "compare, " + KindOfText(verification.difference->what),
            fmt::format("{} ({})", verification.difference->what, verification.difference_start), Listing(port)};
  }
  // Branches that no run took are no fault here: the next program takes others.
  if (verification.sets_run == 0 || (verification.open_branches.empty() && !verification.compared))
    return {Verdict::kFails, "not compared, " + KindOfText(verification.not_compared),
            verification.not_compared + "\n" + TextOf(port.context.findings), Listing(port)};
  return {};
}

std::string Listing(const Port& port) {
  std::string all = Listing(port.texts);
  for (const backends::OutputFile& file : port.files) all += fmt::format("--- {}\n{}", file.name, file.text);
  return all;
}

}  // namespace ncport::tests::random
