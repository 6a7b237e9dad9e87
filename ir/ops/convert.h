// Conversions between the types of values. A value that does not fit is an error, never cut.
#pragma once

#include "ir/machine.h"
#include "ir/nodes.h"
#include "ir/ops/result.h"

namespace ncport::ir::ops {

/// REAL to INT: nearest, halves away from zero (sinumerik-3.4), inside the INT range of the machine.
Number ToInt(double value, const Machine& machine);
/// The same, but the fraction is cut.
Number ToIntCut(double value, const Machine& machine);
/// 0..255, rounded.
Number ToChar(double value);

/// Number `value` as `type` (kInt, kReal, kBool, kChar; other types give it back).
Number Convert(double value, Type type, const Machine& machine);

/// Factorial, BCD and other functions of whole numbers need one: rounded, kDomain outside 0..limit.
Number WholeUpTo(double value, double limit);

}  // namespace ncport::ir::ops
