// Sets up the comparison of a program with its translation: reads the output back through the target's frontend, binds
// the inputs of both sides, runs prove::Verify.
#pragma once

#include <vector>

#include "app/pipeline.h"
#include "backends/translate.h"
#include "exec/run.h"
#include "prove/verify.h"

namespace ncport::app {

struct ComparisonSetup {
  std::uint32_t runs = 200;
  std::uint64_t seed = 1;
  std::uint64_t max_blocks = 10'000'000;
  double tolerance = 0.0001;  // mm, degrees: on top of the words' errors (contracts section 6)
  bool vary_inputs = true;    // false: one set: arguments as written, cells that nothing wrote 0
};

/// `run` names the entry; arguments in it are values seen. Findings of reading the output back are bugs of the writer
/// and are reported as such (NC7002).
prove::Verification CompareTranslation(Context& context, const ProgramSet& source, const ir::Machine& source_machine,
                                       const exec::RunOptions& run, const dialects::Profile& target,
                                       const backends::Translation& translation,
                                       const std::vector<backends::OutputFile>& files, const dialects::Config* config,
                                       const ComparisonSetup& setup, std::vector<prove::Input>& inputs);

}  // namespace ncport::app
