// Rotations in the plane as the coordinate rotation G68 of a mill (fanuc-8.5), for frames that cannot be worked into
// the coordinates because programs are called under them or angles are computed.
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// The frames are shifts and rotations in XY of one main program that the target can say with G52 and G68, and working
/// them in would be refused.
bool RotationsAreNative(const RaiseInput& input, const Translation& out);

/// Afterwards Frame words are kTranslate (G52, all axes), kRotateAbout (about the shifted zero) and kRotateEnd. Sums
/// that a loop makes are held in locals. Run before AbsoluteDimensions.
void RotationsToNative(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
