// Arguments for which a function has no value.
#include <fmt/format.h>

#include <cmath>

#include "check/value_rules.h"
#include "ir/ops/functions.h"

namespace ncport::check {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Function;
using ir::analysis::kInfinity;

namespace {

bool HasPhase(double low, double high, double phase, double period) {
  if (!(high - low < 1e15)) return true;
  return phase + std::ceil((low - phase) / period) * period <= high;
}

class FunctionDomain final : public ValueRule {
 public:
  using ValueRule::ValueRule;

  void Operation(const Site& site, ExprId id, const Interval* args, std::size_t count, Lookup& lookup) override {
    const Expr& expr = input_.module.exprs[id];
    if (expr.op != ExprOp::kFunction || count == 0) return;
    const auto function = static_cast<Function>(expr.a);
    for (std::size_t i = 0; i < count; ++i) {
      if (!args[i].HasNumber()) return;
    }
    if (!MayFail(function, args) || MissesByRounding(function, expr, args[0], lookup)) return;
    const bool too_large = function == Function::kExp || function == Function::kSquare;
    const diag::Code code = too_large ? diag::Code::kOverflow : diag::Code::kOutOfDomain;
    const Certainty certainty = CertaintyOf(function, args, count);
    if (!findings_.IsNews(code, id, 0, certainty)) return;
    const ExprId argument = input_.module.Item(expr.b);
    ValueFinding finding{.code = code, .certainty = certainty};
    finding.first = too_large ? TextOf(site, id) : NameOf(site, id);
    const bool whole_domain_missed = certainty == Certainty::kCertain;
    finding.second = whole_domain_missed
                         ? check::TextOf(args[0])
                         : fmt::format("{}, which can be {},", TextOf(site, argument), Bad(function, args[0]));
    if (function == Function::kBound) finding.second = "limits that are swapped";
    finding.at = RangeOf(site, id);
    finding.notes = Reasons(site, argument, lookup);
    finding.help = too_large ? "" : "test the value first";
    if (!too_large) finding.control = input_.options.domain_alarm;
    findings_.Add(id, 0, std::move(finding));
  }

 private:
  static bool MayFail(Function function, const Interval* args) {
    const Interval& a = args[0];
    switch (function) {
      case Function::kSqrt:
        return a.low < 0;
      case Function::kLn:
        return a.low < 0 || a.HasZero();
      case Function::kAsin:
      case Function::kAsinPositive:
      case Function::kAcos:
        return a.low < -1 || a.high > 1;
      case Function::kTan:
        return HasPhase(a.low, a.high, 90, 180);
      case Function::kPower:
        return (a.low < 0 && !args[1].Has(Interval::kWhole)) || (a.HasZero() && args[1].low < 0) || !a.IsBounded() ||
               !args[1].IsBounded() ||
               std::isinf(std::pow(std::fmax(std::fabs(a.low), std::fabs(a.high)), args[1].high));
      case Function::kBound:
        return a.high > args[1].low;
      case Function::kFactorial:
        return a.low <= -0.5 || a.high >= 170.5;
      case Function::kFromBcd:
        return !(a.IsPoint() && a.low >= 0 && a.low < 10);
      case Function::kToBcd:
        return a.low <= -0.5 || a.high >= 99999999.5;
      case Function::kExp:
        return a.high > 709;
      case Function::kSquare:
        return a.low < -1e154 || a.high > 1e154;
      default:
        return false;
    }
  }

  /// The bounds of an interval are rounded outward: SQRT(R*R-Z*Z) at Z = R reaches a little below 0, and X/R a little
  /// beyond 1, where the values of the program do not. A value that is known is what the control computes.
  [[nodiscard]] bool MissesByRounding(Function function, const Expr& expr, const Interval& a, Lookup& lookup) const {
    constexpr double kRoundings = 1e-14;  // some dozens of them, relative to what is added
    if (a.IsPoint()) return false;
    if (function == Function::kAsin || function == Function::kAsinPositive || function == Function::kAcos)
      return a.low >= -1 - kRoundings && a.high <= 1 + kRoundings;
    return function == Function::kSqrt && a.high >= 0 &&
           a.low >= -kRoundings * SizeOf(input_.module.Item(expr.b), lookup);
  }

  /// The largest value among those that are added.
  [[nodiscard]] double SizeOf(ExprId id, Lookup& lookup) const {
    const Expr& expr = input_.module.exprs[id];
    switch (expr.op) {
      case ExprOp::kGroup:
      case ExprOp::kConvert:
        return SizeOf(ExprId{std::size_t{expr.a}}, lookup);
      case ExprOp::kAdd:
      case ExprOp::kSubtract:
        return std::fmax(SizeOf(ExprId{std::size_t{expr.a}}, lookup), SizeOf(ExprId{std::size_t{expr.b}}, lookup));
      default: {
        const Interval value = lookup.Evaluate(id);
        const double size = std::fmax(std::fabs(value.low), std::fabs(value.high));
        return std::isfinite(size) ? size : 0;
      }
    }
  }

  [[nodiscard]] Certainty CertaintyOf(Function function, const Interval* args, std::size_t count) const {
    if (ir::analysis::Apply(function, args, count, input_.machine).IsNone()) return Certainty::kCertain;
    const Interval& a = args[0];
    // Growth that no test stops is no sign, and neither is an input of the operator.
    if (a.Has(Interval::kEntry) && (function == Function::kSqrt || function == Function::kLn))
      return Certainty::kLikely;
    const bool known = IsKnown(a) && (count < 2 || IsKnown(args[1]));
    const bool usual = function == Function::kSqrt || function == Function::kLn || function == Function::kAsin ||
                       function == Function::kAcos || function == Function::kBound;
    return known && usual ? Certainty::kLikely : Certainty::kPossible;
  }

  static std::string Bad(Function function, const Interval& a) {
    if (function == Function::kSqrt || function == Function::kLn)
      return a.low < 0 ? (a.low == -kInfinity ? "negative" : fmt::format("{:.6g}", a.low)) : "0";
    if (function == Function::kTan) return "90 degrees";
    return check::TextOf(a);
  }

  /// The name of the function as the source has it.
  [[nodiscard]] std::string NameOf(const Site& site, ExprId id) const {
    const std::string text = TextOf(site, id);
    const std::size_t bracket = text.find_first_of("([");
    if (bracket != std::string::npos && bracket > 0) return text.substr(0, text.find_last_not_of(' ', bracket - 1) + 1);
    return std::string(ir::NameOf(static_cast<Function>(input_.module.exprs[id].a)));
  }
};

}  // namespace

std::unique_ptr<ValueRule> MakeFunctionDomain(const ValueRuleInput& input, ValueFindings& findings) {
  return std::make_unique<FunctionDomain>(input, findings);
}

}  // namespace ncport::check
