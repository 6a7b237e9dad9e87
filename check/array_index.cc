// Indices outside their arrays.
#include <fmt/format.h>

#include "check/value_rules.h"

namespace ncport::check {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

namespace {

class ArrayIndex final : public ValueRule {
 public:
  using ValueRule::ValueRule;

  void Index(const Site& site, ExprId element, std::uint32_t dimension, const Interval& index, std::uint32_t size,
             Lookup& lookup) override {
    if (!index.HasNumber() || (index.low >= 0 && index.high <= size - 1.0)) return;
    const bool outside = index.high < 0 || index.low > size - 1.0;
    const Certainty certainty = outside          ? Certainty::kCertain
                                : IsKnown(index) ? Certainty::kLikely
                                                 : Certainty::kPossible;
    if (!findings_.IsNews(diag::Code::kArrayIndex, element, dimension, certainty)) return;
    const Expr& expr = input_.module.exprs[element];
    ValueFinding finding{.code = diag::Code::kArrayIndex, .certainty = certainty};
    finding.first = outside || dimension == kListEnd
                        ? check::TextOf(index)
                        : fmt::format("{} (can be {})", TextOf(site, Item(expr, dimension)), check::TextOf(index));
    finding.second = NameOf(expr);
    finding.third = fmt::format("{}", size - 1);
    finding.at = RangeOf(site, element);
    if (dimension == kListEnd) {
      finding.notes.push_back({{},
                               index.low < 0 ? "a list cannot fill fewer elements than none"
                                             : "the list has more values than elements are left"});
    } else {
      finding.notes = Reasons(site, Item(expr, dimension), lookup);
    }
    if (dimension == 0) finding.control = ControlAlarm(ir::AlarmClass::kIndex);
    findings_.Add(element, dimension, std::move(finding));
  }

 private:
  [[nodiscard]] std::string NameOf(const Expr& expr) const {
    const ir::Module& module = input_.module;
    if (expr.op == ExprOp::kElement)
      return std::string(module.View(module.variables[ir::VariableId{std::size_t{expr.a}}].name));
    if (expr.op == ExprOp::kSystem)
      return std::string(module.View(module.systems[ir::SystemId{std::size_t{expr.a}}].name));
    return std::string(module.View(module.spaces[ir::SpaceId{std::size_t{expr.b}}].name));
  }
  [[nodiscard]] ExprId Item(const Expr& expr, std::uint32_t dimension) const {
    return expr.op == ExprOp::kElement || expr.op == ExprOp::kSystem ? input_.module.Item(expr.b + dimension)
                                                                     : ExprId{std::size_t{expr.a}};
  }
};

}  // namespace

std::unique_ptr<ValueRule> MakeArrayIndex(const ValueRuleInput& input, ValueFindings& findings) {
  return std::make_unique<ArrayIndex>(input, findings);
}

}  // namespace ncport::check
