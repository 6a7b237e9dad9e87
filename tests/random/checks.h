// What must hold for a random program, stage by stage: each direction prints it, reads it back and compares what the
// machine does.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "dialects/config.h"
#include "dialects/profile.h"
#include "ir/machine.h"
#include "ir/module.h"
#include "tests/random/features.h"

namespace ncport::tests::random {

/// A program and the machine it is for.
struct Subject {
  const ir::Module* module = nullptr;
  ir::ProgramId main;
  const dialects::Profile* profile = nullptr;
  const ir::Machine* machine = nullptr;
  const dialects::Profile* target = nullptr;  // of a translation
  const dialects::Config* config = nullptr;   // shop data of the source for this target
  std::uint64_t max_blocks = 200'000;
};

/// kNoProgram: the program gave this direction nothing to check, for example nothing that is translated once more.
enum class Verdict : std::uint8_t { kAgrees, kRefused, kFails, kNoProgram };

/// How a check ended.
struct Finding {
  Verdict verdict = Verdict::kAgrees;
  std::string stage;     // "verify", "run NC5008", "read back", "compare" ...: shrinking keeps it
  std::string text;      // what was found
  std::string artefact;  // the program text or dump that shows it
};

/// One way of a program through the compiler.
struct Direction {
  std::string_view name;  // --direction
  std::string_view title;
  Flavour flavour;
  std::string_view mill, lathe;  // profiles of the source
  Finding (*check)(const Subject& subject, const Direction& direction);
  std::string_view target_mill = {}, target_lathe = {};
  // Weights for what the target cannot say: "frame-turns=0,...". Programs take the two by turns.
  std::string_view without[2] = {};
};
std::span<const Direction> Directions();
const Direction* FindDirection(std::string_view name);

}  // namespace ncport::tests::random
