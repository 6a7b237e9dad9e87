// Checks that a module holds what the other parts rely on. A violation is a bug of ours, never of the user's program.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ir/module.h"

namespace ncport::ir {

struct VerifyOptions {
  bool names_resolved = false;   // no ExprOp::kName is left
  bool structure_built = false;  // every structure mark outside refused blocks has its link
};

/// The first violation in plain words with its place, or none. Takes time linear in the module; reads no record that is
/// out of range, whatever the module holds. Checked are: ids and ranges, enumerators, flags, index and extra of each
/// word by its row (ir/word_shape.h), value use, structure links, children before parents, depth, arity, places that
/// are written, disjoint programs. In refused blocks words may lack their value or extra, and marks need not stand
/// alone.
std::optional<std::string> FindViolation(const Module& module, const VerifyOptions& options = {});

/// True, or the program stops (exit 70) with the violation shown inside the dump. `when`: "after SplitRapids".
bool Verify(const Module& module, std::string_view when, const VerifyOptions& options = {});

}  // namespace ncport::ir
