// NC5010, a part of CheckCompensation.
#pragma once

#include "base/diag/sink.h"
#include "check/comp_flow.h"

namespace ncport::check {

/// Compensation that begins where no way names a tool, an edge or a radius, or where D0 is in force on every way.
void CheckCompTool(const Subject& subject, const CompFlow& comp, diag::Sink& sink);

}  // namespace ncport::check
