// Indices of arrays: the source's control alarms outside the array, numbered cells do not.
#pragma once

#include "backends/fanuc/raise.h"
#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::backends::fanuc {

/// An index that may lie outside its array, as far as the values of the program say, is a finding.
bool RefuseOpenIndices(const RaiseInput& input, const ir::Module& module, diag::Sink& sink);

}  // namespace ncport::backends::fanuc
