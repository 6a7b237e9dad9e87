// From texts to a linked module and its runs: what all commands share. Holds no rule of a language.
#pragma once

#include <vector>

#include "app/ncport.h"
#include "base/result.h"
#include "dialects/config.h"
#include "dialects/profile.h"
#include "exec/event.h"
#include "exec/run.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::frontend {
class TokenListener;
}

namespace ncport::app {

/// What a command asks of `--from`: without it the profile is guessed (check, trace, dump) or refused (translate,
/// flatten).
enum class ProfileNeed : std::uint8_t { kGuess, kNamed };

/// A complete set of programs in one module.
struct ProgramSet {
  dialects::Profile profile;
  ir::Module module;
  std::vector<FileId> inputs;  // of the command, in order
};

/// Chooses the profile (contracts section 1). Fails after findings.
Result<dialects::Profile> ChooseProfile(Context& context, const Input& first, const ReadSettings& settings,
                                        ProfileNeed need);

/// Reads the inputs (their tokens go to `tokens` where it is given), then the called programs that they lack and
/// `settings.find` has, and resolves all names. Fails after errors, but the set is complete as far as it could be read.
/// Takes the bytes of the inputs over.
Status ReadSet(Context& context, std::vector<Input> inputs, const ReadSettings& settings, ProfileNeed need,
               ProgramSet& set, frontend::TokenListener* tokens = nullptr);

/// Entry, arguments, start values of a run. Fails after findings.
Result<exec::RunOptions> RunOptionsFor(Context& context, const ProgramSet& set, const RunSettings& settings);

/// For a translation of a program that --call names: a file whose programs carry no mark of their kind has a subprogram
/// there, and its callers give the letters of the call.
void TakeCall(const exec::RunOptions& run, ProgramSet& set, dialects::Config& config);

}  // namespace ncport::app
