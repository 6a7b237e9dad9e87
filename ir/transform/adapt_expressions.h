// Operations that the target does not have as expressions of ones that it has, without any statement: angles in another
// range, rounding away from zero, MOD of rounded operands, comparisons that must be exact where the target compares
// with a tolerance. The values are the same to the last bit, but for the sum of a turn.
#pragma once

#include <cstdint>

#include "ir/module.h"

namespace ncport::ir::transform {

struct AdaptExpressionsConfig {
  bool relative_comparisons = false;  // the target compares with a relative tolerance
  bool positive_angles = true;        // it has atan2 and asin with results from 0 to 360
  bool has_atan = true;               // of one argument
  bool has_round_away = true;
  bool has_round_to_increment = true;
  bool modulo_rounds_operands = true;  // kOperandsToInt is what its MOD does
  double increment = 0.001;            // of Function::kRoundToIncrement
};

/// Changes one program.
void AdaptExpressions(Module& module, ProgramId program, const AdaptExpressionsConfig& config);

/// `value` rounded to the nearest multiple of `increment`, as ops::RoundToIncrement does it to the last bit:
/// ROUND(value*1000.00000001)/1000.
ExprId RoundedTo(Module& module, ExprId value, double increment);

}  // namespace ncport::ir::transform
