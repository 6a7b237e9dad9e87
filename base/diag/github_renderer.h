// Findings as workflow commands of GitHub Actions, which shows them beside the changed lines.
#pragma once

#include <string>

#include "base/diag/sink.h"
#include "base/source_files.h"

namespace ncport::diag {

/// One line a finding: "::error file=x.spf,line=12,...,title=NC3001::message".
std::string RenderGithub(const Sink& sink, const SourceFiles& files);

}  // namespace ncport::diag
