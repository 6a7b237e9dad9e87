// Kinds of motions.
#pragma once

#include "ir/modes.h"

namespace ncport::ir {

/// G2 and G3: in the active plane, to an end point by a centre or a radius.
constexpr bool IsPlaneArc(Motion motion) { return motion == Motion::kArcCw || motion == Motion::kArcCcw; }
constexpr bool IsArc(Motion motion) {
  return IsPlaneArc(motion) || motion == Motion::kArcVia || motion == Motion::kArcTangent;
}
/// Moves at the programmed feed along a path of their own; threads and tapping go by the spindle.
constexpr bool IsFeedMotion(Motion motion) { return motion == Motion::kLinear || IsArc(motion); }

}  // namespace ncport::ir
