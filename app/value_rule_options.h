// What the rules of values need to know of a language and a project.
#pragma once

#include "app/ncport.h"
#include "app/pipeline.h"
#include "check/value_findings.h"
#include "dialects/config.h"

namespace ncport::app {

/// `config`: its [ranges] are promises of what arguments may be; null: none.
check::ValueRuleOptions ValueRuleOptionsFor(const Context& context, const ProgramSet& set,
                                            const dialects::Config* config);

}  // namespace ncport::app
