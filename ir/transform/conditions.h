// Conditions as chains of jumps on single comparisons.
#pragma once

#include <cstdint>
#include <vector>

#include "ir/module.h"

namespace ncport::ir::transform {

/// One comparison of two numbers, perhaps in brackets, whose sides every target can compute inside a condition: no
/// truth value as a number, no function that needs statements of its own elsewhere.
bool IsPlainComparison(const Module& module, ExprId condition);
/// A variable, a cell with a fixed number, or a literal: reading it twice costs nothing and changes nothing.
bool IsSimplePlace(const Module& module, ExprId expr);
/// A comparison, AND, OR, XOR or NOT, perhaps in brackets: its value is a truth value.
bool IsTruth(const Module& module, ExprId expr);

/// One jump of a chain.
struct ConditionalJump {
  static constexpr std::int32_t kTarget = -1;

  ExprId condition;           // a comparison; none = always
  std::int32_t to = kTarget;  // kTarget, or the index of a later step of the chain; its size = behind the chain
};

/// The chain that jumps to the target when `condition` has the truth value `sense` and falls through otherwise. Both
/// sides of AND and OR are free of effects, so that stopping early changes nothing.
std::vector<ConditionalJump> JumpsFor(Module& module, ExprId condition, bool sense);

}  // namespace ncport::ir::transform
