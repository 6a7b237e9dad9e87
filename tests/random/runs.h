// Runs of random programs.
#pragma once

#include <cstdint>
#include <string>

#include "base/diag/sink.h"
#include "exec/run.h"
#include "prove/recorded_trace.h"
#include "tests/random/checks.h"

namespace ncport::tests::random {

/// What a run left behind.
struct Run {
  exec::Outcome outcome = exec::Outcome::kEnded;
  prove::RecordedTrace trace;
  std::string text;      // the trace as text
  std::string findings;  // of runs that could not go on
  std::string code;      // of the first of them, or the class of an alarm
};

/// Runs the main program with these skip levels on.
void RunProgram(const Subject& subject, std::uint16_t skip_levels, Run& run);

/// Skip levels that are worth a run each: none; all, if a block of the module has a level.
struct SkipSets {
  std::uint16_t sets[2] = {0, 0};
  std::uint32_t count = 1;
};
SkipSets SkipSetsOf(const ir::Module& module);

/// First line in which two texts differ, both with their numbers.
std::string FirstDifference(std::string_view a, std::string_view b);

/// First words of the lines in which two texts differ first: what kind of event it is.
std::string KindOfDifference(std::string_view a, std::string_view b);

/// First words of a finding, up to the first number in it: what kind it is.
std::string KindOfText(std::string_view what);

/// The number of the first error, empty if there is none.
std::string FirstError(const diag::Sink& sink);

/// All findings as text, one a line.
std::string TextOf(const diag::Sink& sink);

}  // namespace ncport::tests::random
