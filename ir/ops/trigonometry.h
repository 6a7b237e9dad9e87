// Trigonometry in degrees, exact where the true value is: Sin(30) = 0.5, Cos(90) = 0, Tan(45) = 1, and the way back.
#pragma once

#include "ir/ops/result.h"

namespace ncport::ir::ops {

double Sin(double degrees);
double Cos(double degrees);
/// kDomain at odd multiples of 90 degrees.
Number Tan(double degrees);
/// -90..90; kDomain outside -1..1.
Number Asin(double value);
/// 0..180; kDomain outside -1..1.
Number Acos(double value);
/// -90..90.
double Atan(double value);
/// Angle of the vector with component `along` in the reference direction and `across` perpendicular to it, -180..180;
/// both 0 gives 0.
double Atan2(double across, double along);

}  // namespace ncport::ir::ops
