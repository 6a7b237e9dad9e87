// Small text files that are settings, not programs: profiles and ncport.toml.
#pragma once

#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"

namespace ncport::dialects {

inline constexpr std::size_t kMaxSettingsBytes = std::size_t{1} << 20U;

/// Adds the file at `path` to `files`. Reports a file that cannot be read, is no UTF-8 or is longer than
/// kMaxSettingsBytes.
Result<FileId> ReadTextFile(std::string_view path, SourceFiles& files, diag::Sink& sink);

}  // namespace ncport::dialects
