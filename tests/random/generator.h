// Random programs in IR. Each is valid by construction: values stay in ranges that are known before the run, so there
// is no division by zero and no argument outside a domain; positions stay within 1000 mm; every loop is counted and
// every jump leads forward or is counted; modal state that differs by the way is written again before it decides
// anything.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dialects/profile.h"
#include "ir/machine.h"
#include "ir/module.h"
#include "tests/random/features.h"

namespace ncport::tests::random {

struct Options {
  Flavour flavour = Flavour::kSinumerik;
  const dialects::Profile* profile = nullptr;  // whose words, variables and axes the programs use
  Weights weights;
  std::uint32_t statements = 14;         // of the main program, about; subprograms have fewer
  std::uint32_t subprograms = 3;         // at most
  std::uint64_t executed_blocks = 3000;  // at most, about
};

struct Sample {
  ir::Module module;
  ir::ProgramId main;
};

/// The program of this seed: the same for the same seed and options on every machine.
Sample Generate(std::uint64_t seed, const Options& options);

}  // namespace ncport::tests::random
