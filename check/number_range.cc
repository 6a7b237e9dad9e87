// Results and assigned values that their type cannot hold, and fractions that a whole type loses.
#include <fmt/format.h>

#include <cmath>

#include "check/value_rules.h"

namespace ncport::check {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

namespace {

class NumberRange final : public ValueRule {
 public:
  using ValueRule::ValueRule;

  void Operation(const Site& site, ExprId id, const Interval* operands, std::size_t count, Lookup& lookup) override {
    const Expr& expr = input_.module.exprs[id];
    const Interval& a = operands[0];
    const Interval& b = operands[count - 1];
    if (!a.HasNumber() || !b.HasNumber()) return;
    Interval result;
    switch (expr.op) {
      case ExprOp::kNegate:
        result = ir::analysis::Negated(a);
        break;
      case ExprOp::kAdd:
        result = ir::analysis::Sum(a, b);
        break;
      case ExprOp::kSubtract:
        result = ir::analysis::Difference(a, b);
        break;
      case ExprOp::kMultiply:
        result = ir::analysis::Product(a, b);
        break;
      case ExprOp::kDivide:
        if (b.HasZero()) return;  // another rule
        result = ir::analysis::Quotient(a, b);
        break;
      case ExprOp::kDivideInteger:
      case ExprOp::kModulo:
        if (b.HasZero()) return;
        result = ir::analysis::WholeQuotient(a, b);
        break;
      default:
        return;
    }
    const bool rounds = (expr.flags & Expr::kOperandsToInt) != 0;
    const bool whole =
        expr.op != ExprOp::kDivide && (rounds || (a.Has(Interval::kInteger) && b.Has(Interval::kInteger)));
    const double most = whole ? static_cast<double>(input_.machine.int_max) : 1.7976931348623157e308;
    const double least = whole ? static_cast<double>(input_.machine.int_min) : -most;
    if (result.HasNumber() && result.low >= least && result.high <= most) return;
    const bool certain = !result.HasNumber() || result.low > most || result.high < least;
    const bool likely = whole && IsKnown(a) && IsKnown(b);
    const Certainty certainty = certain ? Certainty::kCertain : likely ? Certainty::kLikely : Certainty::kPossible;
    if (!findings_.IsNews(diag::Code::kOverflow, id, 0, certainty)) return;
    ValueFinding finding{.code = diag::Code::kOverflow, .certainty = certainty};
    finding.first = TextOf(site, id);
    finding.at = RangeOf(site, id);
    finding.notes = Reasons(site, id, lookup);
    if (whole) finding.notes.push_back({{}, fmt::format("whole numbers go from {:.0f} to {:.0f}", least, most)});
    findings_.Add(id, 0, std::move(finding));
  }

  void Conversion(const Site& site, ExprId id, ir::Type type, const Interval& value, Lookup& /*lookup*/) override {
    if (!value.HasNumber()) return;
    const bool is_char = type == ir::Type::kChar;
    const double least = is_char ? 0 : static_cast<double>(input_.machine.int_min);
    const double most = is_char ? 255 : static_cast<double>(input_.machine.int_max);
    if (value.low > least - 0.5 && value.high < most + 0.5) return Fraction(site, id, value);
    const bool outside = value.high <= least - 0.5 || value.low >= most + 0.5;
    const bool likely = IsKnown(value);
    const Certainty certainty = outside ? Certainty::kCertain : likely ? Certainty::kLikely : Certainty::kPossible;
    if (!findings_.IsNews(diag::Code::kOutOfRange, id, 0, certainty)) return;
    ValueFinding finding{.code = diag::Code::kOutOfRange, .certainty = certainty};
    finding.first = check::TextOf(value);
    finding.second = fmt::format("the range {:.0f} to {:.0f} of its type", least, most);
    finding.at = AtOf(site, id);
    finding.control = ControlAlarm(ir::AlarmClass::kConversion);
    findings_.Add(id, 0, std::move(finding));
  }

 private:
  /// A value that is known and has a fraction. A half of unknown values is what rounding is for.
  void Fraction(const Site& site, ExprId id, const Interval& value) {
    if (!value.IsPoint() || value.low == std::trunc(value.low)) return;
    // What differs by binary noise only is meant to be whole.
    if (std::fabs(value.low - std::round(value.low)) < 1e-9 * std::fmax(1.0, std::fabs(value.low))) return;
    if (!findings_.IsNews(diag::Code::kLostFraction, id, 0, Certainty::kCertain)) return;
    ValueFinding finding{.code = diag::Code::kLostFraction, .certainty = Certainty::kCertain};
    finding.first = check::TextOf(value);
    finding.second = fmt::format("{:.0f}", std::round(value.low));
    finding.at = AtOf(site, id);
    findings_.Add(id, 0, std::move(finding));
  }

  /// The value of the word, where the conversion belongs to its place.
  [[nodiscard]] SourceRange AtOf(const Site& site, ExprId id) const {
    const ir::Word& word = input_.module.words[site.word];
    if (word.op == ir::WordOp::kAssign && word.Extra<ExprId>() == id && word.value.Valid())
      return RangeOf(site, word.value);
    return RangeOf(site, id);
  }
};

}  // namespace

std::unique_ptr<ValueRule> MakeNumberRange(const ValueRuleInput& input, ValueFindings& findings) {
  return std::make_unique<NumberRange>(input, findings);
}

}  // namespace ncport::check
