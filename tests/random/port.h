// One translation of a random program: what is translated, and what came of it.
#pragma once

#include <string>
#include <vector>

#include "app/pipeline.h"
#include "backends/translate.h"
#include "dialects/config.h"
#include "dialects/profile.h"
#include "ir/machine.h"
#include "tests/random/checks.h"
#include "tests/random/texts.h"

namespace ncport::tests::random {

struct Port {
  Context context;
  app::ProgramSet set;  // profile and module of the source
  ir::Machine machine;  // of the source
  ir::ProgramId entry;
  const dialects::Profile* target = nullptr;
  const dialects::Config* config = nullptr;
  std::vector<TextFile> texts;  // of the source
  backends::Translation translation;
  std::vector<backends::OutputFile> files;
};

/// Reads the texts as programs of `profile` and looks for the main program. A failure is a finding.
Finding ReadSource(Port& port, std::vector<TextFile> texts, const dialects::Profile& profile, std::string_view main);
/// Raises and prints. kRefused with the reason where the target has no form.
Finding Translate(Port& port);
/// Compares source and output, as `ncport translate --verify` does; arguments stay as written: what they may be is
/// known to the generator alone.
Finding Compare(Port& port, std::uint64_t max_blocks);
/// Both texts, one below the other.
std::string Listing(const Port& port);

}  // namespace ncport::tests::random
