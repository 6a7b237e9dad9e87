// A LineError as a finding.
#pragma once

#include <string_view>

#include "base/diag/sink.h"
#include "frontend/common/line_error.h"

namespace ncport::frontend {

/// `line`: the text that the error's bytes count in; `at`: its file and line.
void ReportLineError(const LineError& error, std::string_view line, SourceRange at, diag::Sink& sink,
                     std::string_view alarm = {});

}  // namespace ncport::frontend
