// Which programs a run starts in with nothing given.
#pragma once

#include "ir/module.h"

namespace ncport::ir::analysis {

/// True for main programs. Where the text does not say what a program is (the first one of a set counts as main), one
/// that returns and has no end word is a macro: its callers, and what they give, are not known.
bool StartsAsMain(const Module& module, ProgramId program);

}  // namespace ncport::ir::analysis
