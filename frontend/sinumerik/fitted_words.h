// Words of the language that the control of a profile does not have (card 11).
#pragma once

#include "base/diag/sink.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

/// NC1014 for the first word of each block that the profile says the control lacks: structures (nesting.loop,
/// nesting.if 0), DEF and parameters (sinumerik.definitions), AND OR XOR NOT (sinumerik.logic-words), GOTO and computed
/// targets (sinumerik.jumps-both-ways). The block keeps its meaning, so that nothing else is said
/// about its names.
void CheckFittedWords(const ir::Module& module, const dialects::Profile& profile, diag::Sink& sink);

}  // namespace ncport::frontend::sinumerik
