// What the rules of values need to know of a language and a project.
#pragma once

#include "app/ncport.h"
#include "app/pipeline.h"
#include "check/value_findings.h"
#include "dialects/config.h"

namespace ncport::app {

/// `config`: its [ranges] are promises of what arguments and cells hold where a run starts; null: none. NC2101 for a
/// range of a checked program that names none of its parameters, and for a cell that the machine has not.
check::ValueRuleOptions ValueRuleOptionsFor(Context& context, const ProgramSet& set, const dialects::Config* config);

}  // namespace ncport::app
