// Moves to the reference point: G28 goes by way of the point that its axis words name (fanuc-8.1), other controls go
// straight there.
#pragma once

#include <cstdint>

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// The letters of increments stand for X, Y, Z, C (Printer::PrintAddress).
bool HasIncrementLetter(const dialects::Profile& profile, std::uint8_t axis);

/// The axis words of a straight move become steps of nothing: letters of increments where the target has them for all
/// axes of the block, else G91 before and G90 behind. Behind AbsoluteDimensions: all other words are absolute then.
void ReferencesToSteps(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
