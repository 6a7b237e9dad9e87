// What the head of a translated program tells the one who runs it: where it comes from, what its letters, cells and
// tools are, what was compared and what was lost.
#pragma once

#include <string>
#include <vector>

#include "app/pipeline.h"
#include "backends/translate.h"
#include "prove/verify.h"

namespace ncport::app {

/// Comment lines for each program. `verification`: none = not compared.
std::vector<backends::ProgramHeader> HeadersOf(const Context& context, const ProgramSet& source,
                                               const dialects::Profile& target,
                                               const backends::Translation& translation,
                                               const prove::Verification* verification,
                                               const std::vector<prove::Input>& inputs);

/// The result of a comparison in plain words, a line each.
std::string SummaryOf(const prove::Verification& verification, const std::vector<prove::Input>& inputs);

}  // namespace ncport::app
