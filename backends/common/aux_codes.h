// M functions of the machine builder by [mcodes]: the rules of the project, then those of the profile.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "backends/common/translation.h"
#include "base/diag/sink.h"
#include "dialects/config.h"
#include "dialects/profile.h"

namespace ncport::backends {

/// Makes `word` what the rule says in place of it, and returns the number of that M function. None: the target cannot
/// say it.
using WriteAux =
    std::function<std::optional<std::uint32_t>(ir::Module& module, ir::Word& word, const std::string& target)>;

/// A function without a rule is a finding with the line to add; M7, M8 and M9 mean the same everywhere.
bool MapAuxiliaries(const dialects::Profile& profile, const dialects::Config* config, const WriteAux& write,
                    Translation& out, diag::Sink& sink);

}  // namespace ncport::backends
