// Shifts and rotations that stand beside each other (G52, G68) as programmable frames, of which each word replaces the
// whole (sinumerik-8.7).
#pragma once

#include "backends/sinumerik/raise.h"

namespace ncport::backends::sinumerik {

/// Exact where one kind is used alone, and shifts name the same axes each time: all else is a finding. Run after
/// LowerVacantValues, which decides whether a word is there.
bool MapFrames(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::sinumerik
