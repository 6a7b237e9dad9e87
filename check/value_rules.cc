#include "check/value_rules.h"

#include <vector>

namespace ncport::check {

namespace {

using ir::ExprId;
using ir::analysis::Interval;
using ir::analysis::RangeLookup;
using ir::analysis::RangeObserver;
using ir::analysis::RangeSite;

/// Hands everything to all rules.
class AllRules final : public RangeObserver {
 public:
  explicit AllRules(const std::vector<std::unique_ptr<ValueRule>>& rules) : rules_(rules) {}

  void Operation(const RangeSite& site, ExprId expr, const Interval* operands, std::size_t count,
                 RangeLookup& values) override {
    for (const auto& rule : rules_) rule->Operation(site, expr, operands, count, values);
  }
  void Conversion(const RangeSite& site, ExprId expr, ir::Type type, const Interval& value,
                  RangeLookup& values) override {
    for (const auto& rule : rules_) rule->Conversion(site, expr, type, value, values);
  }
  void Index(const RangeSite& site, ExprId element, std::uint32_t dimension, const Interval& index, std::uint32_t size,
             RangeLookup& values) override {
    for (const auto& rule : rules_) rule->Index(site, element, dimension, index, size, values);
  }
  void Condition(const RangeSite& site, ExprId expr, const Interval& truth) override {
    for (const auto& rule : rules_) rule->Condition(site, expr, truth);
  }
  void Block(const RangeSite& site, RangeLookup& values) override {
    for (const auto& rule : rules_) rule->Block(site, values);
  }
  void WordTurn(const RangeSite& site, RangeLookup& values) override {
    for (const auto& rule : rules_) rule->WordTurn(site, values);
  }
  void Exit(const RangeSite& site, RangeLookup& values) override {
    for (const auto& rule : rules_) rule->Exit(site, values);
  }
  void StartDone() override {
    for (const auto& rule : rules_) rule->StartDone();
  }
  void CountedLoop(const RangeSite& site, const Interval& start, const Interval& end, const Interval& step) override {
    for (const auto& rule : rules_) rule->CountedLoop(site, start, end, step);
  }

 private:
  const std::vector<std::unique_ptr<ValueRule>>& rules_;
};

}  // namespace

ir::analysis::RangeStatistics CheckValues(const ir::Module& module, const ir::Machine& machine,
                                          const ir::analysis::FlowGraphs& graphs, const ir::analysis::CallGraph& calls,
                                          const ir::analysis::ModalFlow& modal, const ValueRuleOptions& options,
                                          diag::Sink& sink) {
  const ValueRuleInput input{module, machine, options};
  ValueFindings findings(input);
  std::vector<std::unique_ptr<ValueRule>> rules;
  rules.push_back(MakeDivisionByZero(input, findings));
  rules.push_back(MakeFunctionDomain(input, findings));
  rules.push_back(MakeNumberRange(input, findings));
  rules.push_back(MakeArrayIndex(input, findings));
  rules.push_back(MakeLoops(input, findings, graphs));
  rules.push_back(MakeJumpLoops(input, findings, graphs));
  rules.push_back(MakeCallAlarms(input, findings, graphs));
  rules.push_back(MakeArcs(input, findings, graphs, modal));
  rules.push_back(MakeWordValues(input, findings));
  rules.push_back(MakeFeed(input, findings, {module, machine, graphs, calls, &modal}));
  rules.push_back(MakeCycleWords(input, findings, {module, machine, graphs, calls, &modal}));
  AllRules all(rules);
  ir::analysis::RangeOptions range_options;
  range_options.declared = options.declared;
  range_options.declared_cells = options.declared_cells;
  const auto statistics = ir::analysis::FindValueRanges(module, machine, graphs, calls, range_options, all);
  findings.Report(sink);
  for (const auto& rule : rules) rule->Finish(sink);
  return statistics;
}

}  // namespace ncport::check
