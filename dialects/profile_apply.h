// Puts the keys of one profile file into a Profile: types, ranges, near names.
#pragma once

#include <vector>

#include "base/diag/sink.h"
#include "dialects/profile.h"
#include "dialects/toml_document.h"

namespace ncport::dialects {

/// Applies the top level of a file. `inherited`: the profile already holds the values of another file. `mentioned` has
/// one entry a row of ProfileKeys and notes the keys that the file answers or asks. Findings are errors in `sink`.
void ApplyProfileFile(const TomlNode& root, bool inherited, Profile& profile, std::vector<bool>& mentioned,
                      diag::Sink& sink);

}  // namespace ncport::dialects
