// Counts of repeated parts: the source's control alarms below 0 and above its most, a counter in a cell does not.
#pragma once

#include <vector>

#include "backends/fanuc/raise.h"
#include "base/diag/sink.h"
#include "ir/analysis/value_range.h"
#include "ir/module.h"

namespace ncport::backends::fanuc {

/// A computed count that may lie outside, as far as the values of the program and `declared` say, is a finding. Before
/// any pass changes the blocks.
bool RefuseOpenRepeats(const RaiseInput& input, const ir::Module& module,
                       const std::vector<ir::analysis::DeclaredRange>& declared, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
