// The sheet that goes to the machine with a translation: `translate --report`.
#pragma once

#include <vector>

#include "app/ncport.h"
#include "app/pipeline.h"
#include "app/report.h"
#include "backends/translate.h"
#include "prove/verify.h"

namespace ncport::app {

struct TranslateReportInput {
  const Context& context;
  const ProgramSet& source;
  const dialects::Profile& target;
  const dialects::Config& config;
  const backends::Translation& translation;
  const std::vector<backends::OutputFile>& files;
  const prove::Verification* verification = nullptr;  // null: not asked for
  const std::vector<prove::Input>& inputs;            // of the comparison
};

/// All but the envelopes and the findings.
Report TranslateReport(const TranslateReportInput& input);

}  // namespace ncport::app
