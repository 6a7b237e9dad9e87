// The expressions of a word: those whose values it takes, and the places that it writes.
#pragma once

#include <functional>

#include "ir/module.h"

namespace ncport::ir {

/// Calls `visit` for every expression whose value the word takes: its own value, operands of its records, arguments,
/// indices of the places that it writes. Arguments by reference are among them, initialisers of a definition too.
void VisitValues(const Module& module, const Word& word, const std::function<void(ExprId)>& visit);

/// Calls `visit` for every place that the word itself writes: of an assignment, of a list (its first element), the
/// counter of a loop. What a called program writes is not among them.
void VisitPlaces(const Module& module, const Word& word, const std::function<void(ExprId)>& visit);

/// Calls `visit` for every argument that the program called by the word may write: those of parameters by reference,
/// and all variables where the program is not known.
void VisitReferences(const Module& module, const Word& word, const std::function<void(ExprId)>& visit);

}  // namespace ncport::ir
