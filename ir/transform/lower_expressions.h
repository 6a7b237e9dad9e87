// Rewrites operations that a target does not have by ones that it has: the integer quotient as a cut quotient, the
// remainder by its definition, truth values as numbers, functions by a local and a test, a comparison within a
// tolerance as a difference against a band. What needs statements gets them in front of the block; a WHILE whose
// condition needs some becomes a LOOP with a jump out of it.
//
// Run after SplitStatements (one statement a block) and before StructureToJumps (it makes IF blocks).
#pragma once

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir::transform {

struct LowerExpressionsConfig {
  bool has_modulo = false;            // an operation that means Modulo, negative operands included
  bool has_integer_quotient = false;  // DIV
  bool truth_values = false;          // a comparison may stand where a number stands
  bool has_min_max = false;
  bool has_round_up = false;  // toward plus infinity
  bool has_square = false;
  bool signed_atan2 = false;  // -180..180; else 0..360 or by parameter: normalised
  bool signed_asin = false;   // -90..90; else normalised
  // Comparisons flagged kTolerance, and the end of a FOR loop, hold within this part of their sides (the source's
  // Machine::compare_tolerance); those of numbers that may be fractions which were computed are written out. 0: none.
  double compare_tolerance = 0;
  bool for_counter_rounds = false;  // the start of a FOR loop is rounded (the source's Machine)
  bool round_in_words = false;      // ROUND in the value of a word gives a whole number; else it stands in a statement
};

/// Changes one program. What has no form is a finding (NC6xxx) at its block; returns false then.
bool LowerExpressions(Module& module, ProgramId program, const LowerExpressionsConfig& config, diag::Sink& sink);

}  // namespace ncport::ir::transform
