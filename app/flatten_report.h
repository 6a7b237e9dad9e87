// The sheet that goes with a flat program (contracts section 2, `flatten --report`).
#pragma once

#include "app/ncport.h"
#include "app/pipeline.h"
#include "app/report.h"
#include "backends/iso/flat_record.h"
#include "dialects/profile.h"

namespace ncport::app {

/// All but the envelopes and the findings.
Report FlattenReport(const Context& context, const ProgramSet& set, const dialects::Profile& target,
                     const FlattenOptions& options, const backends::iso::FlatRecord& record);

/// How a rapid of several axes goes: "straight", "axis by axis", "unknown".
std::string_view RapidWay(const dialects::Profile& profile);
/// Whether such a rapid may go another way on the target. A way that is not known may be any.
bool RapidsMayDiffer(const dialects::Profile& source, const dialects::Profile& target);

}  // namespace ncport::app
