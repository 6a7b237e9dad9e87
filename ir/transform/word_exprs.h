// The values that a word takes and the places that it writes, in one go; see word_values.h.
#pragma once

#include <functional>

#include "ir/module.h"

namespace ncport::ir::transform {

/// Calls `visit` with the root of each expression of the word; `place`: it names what is written.
void VisitWordExprs(const Module& module, const Word& word, const std::function<void(ExprId root, bool place)>& visit);

/// True if the word reads the variable: a value of it, an index, an argument, by reference too.
bool ReadsVariable(const Module& module, const Word& word, VariableId variable);

}  // namespace ncport::ir::transform
