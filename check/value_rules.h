// The rules that rest on the values of variables, one file a rule, and all of them over a module.
#pragma once

#include <memory>

#include "check/value_findings.h"
#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/analysis/modal_state.h"

namespace ncport::check {

std::unique_ptr<ValueRule> MakeDivisionByZero(const ValueRuleInput& input, ValueFindings& findings);
std::unique_ptr<ValueRule> MakeFunctionDomain(const ValueRuleInput& input, ValueFindings& findings);
std::unique_ptr<ValueRule> MakeNumberRange(const ValueRuleInput& input, ValueFindings& findings);
std::unique_ptr<ValueRule> MakeArrayIndex(const ValueRuleInput& input, ValueFindings& findings);
/// Loops that never run or never end.
std::unique_ptr<ValueRule> MakeLoops(const ValueRuleInput& input, ValueFindings& findings,
                                     const ir::analysis::FlowGraphs& graphs);
/// Loops of a jump back with a condition that never end, or whose jump is never taken.
std::unique_ptr<ValueRule> MakeJumpLoops(const ValueRuleInput& input, ValueFindings& findings,
                                         const ir::analysis::FlowGraphs& graphs);
/// Calls of cycles that end in an alarm because of what they pass.
std::unique_ptr<ValueRule> MakeCallAlarms(const ValueRuleInput& input, ValueFindings& findings,
                                          const ir::analysis::FlowGraphs& graphs);
/// NC5004, NC2005, NC1013: arcs whose points and centre do not lie on one circle, whose radius does not reach from the
/// start to the end, or has a radius where both are one point.
std::unique_ptr<ValueRule> MakeArcs(const ValueRuleInput& input, ValueFindings& findings,
                                    const ir::analysis::FlowGraphs& graphs, const ir::analysis::ModalFlow& modal);
/// NC2005: values that words cannot take: below 0, a feed or scale factor of 0, too many repetitions.
std::unique_ptr<ValueRule> MakeWordValues(const ValueRuleInput& input, ValueFindings& findings);

/// NC5002: a move, a cycle or a thread that needs a feed, where none is set or F0 was the last one: an error where that
/// is so on every way, a warning where a way lacks it.
std::unique_ptr<ValueRule> MakeFeed(const ValueRuleInput& input, ValueFindings& findings,
                                    const ir::analysis::FlowSources& sources);

/// NC5007: a hole without level or depth, pecks without a size, a reference move inside a cycle: an error where that is
/// so on every way, a warning where it is on some.
std::unique_ptr<ValueRule> MakeCycleWords(const ValueRuleInput& input, ValueFindings& findings,
                                          const ir::analysis::FlowSources& sources);

/// Reports what the rules find. Severity follows certainty: an error where every run that comes there alarms, a warning
/// where the program lets such values through.
ir::analysis::RangeStatistics CheckValues(const ir::Module& module, const ir::Machine& machine,
                                          const ir::analysis::FlowGraphs& graphs, const ir::analysis::CallGraph& calls,
                                          const ir::analysis::ModalFlow& modal, const ValueRuleOptions& options,
                                          diag::Sink& sink);

}  // namespace ncport::check
