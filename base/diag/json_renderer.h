// Findings as JSON (docs/contracts.md, section 4).
#pragma once

#include <string>

#include "base/diag/sink.h"
#include "base/source_files.h"

namespace ncport::diag {

/// {"version": 1, "findings": [...]}, each with file, line, column, endLine, endColumn (of the character behind the
/// range), severity, code, message, notes, help, fixes, alarm. What does not exist is null; columns count characters
/// from 1.
std::string RenderJson(const Sink& sink, const SourceFiles& files);

}  // namespace ncport::diag
