// What the numbers of words can hold (fanuc-2.1, 2.2).
#pragma once

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// Computed values of F get the decimals of their unit: per minute those of lengths, per revolution 0.0001 mm, the lead
/// of a thread 0.000001 mm. A value that they hold with an error above 0.1 % is a finding (NC6010).
bool RoundFeeds(const RaiseInput& input, Translation& out, diag::Sink& sink);
/// An address takes 8 digits. Zeros at the end of longer numbers go; what is still longer is a finding (NC6001).
bool CheckDigits(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
