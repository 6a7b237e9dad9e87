// Divisors that are or can be 0.
#include <fmt/format.h>

#include "check/value_rules.h"

namespace ncport::check {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

namespace {

class DivisionByZero final : public ValueRule {
 public:
  using ValueRule::ValueRule;

  void Operation(const Site& site, ExprId id, const Interval* operands, std::size_t count, Lookup& lookup) override {
    const Expr& expr = input_.module.exprs[id];
    const bool divides = expr.op == ExprOp::kDivide || expr.op == ExprOp::kDivideInteger || expr.op == ExprOp::kModulo;
    if (!divides || count != 2) return;
    Interval divisor = operands[1];
    if ((expr.flags & Expr::kOperandsToInt) != 0 && expr.op != ExprOp::kDivide)
      divisor = ir::analysis::Rounded(divisor);
    if (!divisor.HasZero()) return;
    const Certainty certainty = CertaintyOf(divisor);
    if (!findings_.IsNews(diag::Code::kDivisionByZero, id, 0, certainty)) return;

    const ExprId bare = Bare(ExprId{std::size_t{expr.b}});
    const std::string name = TextOf(site, bare);
    const bool literal = input_.module.exprs[bare].op == ExprOp::kLiteral;
    ValueFinding finding{.code = diag::Code::kDivisionByZero, .certainty = certainty};
    finding.first = literal                            ? "the divisor is 0"
                    : certainty == Certainty::kCertain ? fmt::format("{} is 0 here", name)
                                                       : fmt::format("{} can be 0 here", name);
    finding.at = Marked(site, id, expr);
    finding.notes = Reasons(site, bare, lookup);
    if (!literal && !input_.options.test_example.empty())
      finding.help = fmt::format(fmt::runtime(input_.options.test_example), name,
                                 divisor.low < 0 && divisor.IsBounded() ? "==" : "<=");
    finding.control = ControlAlarm(ir::AlarmClass::kArithmetic);
    findings_.Add(id, 0, std::move(finding));
  }

 private:
  /// Inputs that nothing is known of may be 0 and need not be; a warning needs a sign that they are: an argument that
  /// is used as it came, a way that brings 0, a test that lets it through. What the program computes itself needs none.
  static Certainty CertaintyOf(const Interval& divisor) {
    if (divisor.IsZero()) return Certainty::kCertain;
    // Where no bound is left at all (X=(X+A/X)/2 in a loop) the 0 is as made up as the rest.
    constexpr double kLargest = 1073741824.0;
    const bool lost = divisor.low <= -kLargest && divisor.high >= kLargest && !divisor.Has(Interval::kZeroSeen);
    if (!divisor.Has(Interval::kInput)) return lost ? Certainty::kPossible : Certainty::kLikely;
    const bool at_bound = divisor.low == 0 || divisor.high == 0;
    const bool sign = divisor.Has(Interval::kEntry) || divisor.Has(Interval::kZeroSeen) ||
                      (divisor.Has(Interval::kTested) && at_bound);
    return sign ? Certainty::kLikely : Certainty::kPossible;
  }

  /// From the operator to the end of the divisor.
  [[nodiscard]] SourceRange Marked(const Site& site, ExprId id, const Expr& expr) const {
    SourceRange whole = RangeOf(site, id);
    const SourceRange left = RangeOf(site, ExprId{std::size_t{expr.a}});
    const SourceRange right = RangeOf(site, ExprId{std::size_t{expr.b}});
    if (input_.options.files == nullptr || left.end <= left.begin || right.begin < left.end) return whole;
    const std::string_view line = input_.options.files->Line(whole.file, whole.line);
    std::uint32_t begin = left.end;
    // A closing bracket of the left side is not part of its place.
    while (begin < right.begin && begin < line.size() &&
           (line[begin] == ' ' || line[begin] == '\t' || line[begin] == ')' || line[begin] == ']'))
      ++begin;
    whole.begin = begin < right.begin ? begin : right.begin;
    whole.end = whole.end > right.end ? whole.end : right.end;
    return whole;
  }
};

}  // namespace

std::unique_ptr<ValueRule> MakeDivisionByZero(const ValueRuleInput& input, ValueFindings& findings) {
  return std::make_unique<DivisionByZero>(input, findings);
}

}  // namespace ncport::check
