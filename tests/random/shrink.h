// Makes a failing program small: blocks, words and expressions are taken out or replaced by simpler ones as long as it
// fails in the same way (delta debugging on the IR). Whether a smaller one is still a program is for the predicate to
// say.
#pragma once

#include <cstddef>
#include <functional>

#include "ir/module.h"

namespace ncport::tests::random {

/// True if the module fails as the first one did.
using StillFails = std::function<bool(const ir::Module& module)>;

struct ShrinkLimits {
  std::size_t tries = 4000;  // calls of the predicate
};

/// A smaller module that still fails, compact: without records that nothing uses being printed.
ir::Module Shrink(const ir::Module& module, const StillFails& still_fails, const ShrinkLimits& limits = {});

/// Number of blocks and words of all programs.
std::size_t SizeOf(const ir::Module& module);

}  // namespace ncport::tests::random
