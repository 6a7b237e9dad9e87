// Values that words cannot take: below 0 where they count up, a feed or a scale factor of 0, repetitions and turns
// beyond their limits. Constants that the language itself limits have their finding already; here they are values of
// variables, and signs in front of constants.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "check/expressions.h"
#include "check/value_rules.h"
#include "check/word_expressions.h"

namespace ncport::check {

using ir::WordOp;
using ir::analysis::Interval;

namespace {

struct Limit {
  double low = 0;
  double high = ir::analysis::kInfinity;
  std::string_view range = "0 and above";
  ir::AlarmClass alarm = ir::AlarmClass::kRange;
  bool above_low = false;  // `low` itself is outside
  bool not_zero = false;   // whatever else
  bool alarms = true;      // false: the card does not say what the control makes of it
};

constexpr Limit kFactor{
    .low = -ir::analysis::kInfinity, .range = "the scale factors, none of them 0", .not_zero = true};
constexpr double kLastOfTurn = 359.9999999;  // 360 is outside

constexpr double kNoise = 1e-9;

constexpr double kHalf = 0.5;  // numbers of functions and counts are rounded

/// Limits that the word has by itself.
std::optional<Limit> OwnLimit(const ir::Word& word, bool literal) {
  switch (word.op) {
    case WordOp::kFeed:
    case WordOp::kFeedOnce:
      // F0 in the text takes the feed away, and the move that needs one has the finding.
      if (literal) return Limit{.alarms = false};
      // The alarm comes with the next move by the feed, if there is one.
      return Limit{.range = "the feeds, all above 0", .above_low = true, .alarms = false};
    case WordOp::kSpeed:
    case WordOp::kSpeedLimit:
      return Limit{.alarms = false};
    case WordOp::kTool:
    case WordOp::kEdge:
    case WordOp::kToolOffset:
    case WordOp::kRadiusOffset:
    case WordOp::kLengthOffset:
    case WordOp::kAux:
    case WordOp::kAuxH:
    case WordOp::kAlarm:
    case WordOp::kComputedM:
    case WordOp::kComputedG:
      return Limit{.low = -kHalf, .high = 4294967295.0, .alarms = !literal};
    case WordOp::kDwellSeconds:
    case WordOp::kDwellRevolutions:
      return Limit{.alarms = !literal};
    case WordOp::kChamfer:
    case WordOp::kPolarRadius:
      return Limit{.alarm = ir::AlarmClass::kGeometry};
    case WordOp::kOpeningAngle:
      return Limit{.high = 360,
                   .range = "the opening angles, above 0 and up to 360",
                   .alarm = ir::AlarmClass::kCircle,
                   .above_low = true};
    case WordOp::kTurns:
      return Limit{.high = 999, .range = "0 to 999"};
    case WordOp::kFrameFactor:
      return kFactor;
    default:
      return std::nullopt;
  }
}

class WordValues final : public ValueRule {
 public:
  using ValueRule::ValueRule;

  void WordTurn(const Site& site, Lookup& lookup) override {
    const ir::Module& module = input_.module;
    if (module.programs[site.context->program].library) return;
    const ir::Word& word = module.words[site.word];
    const ir::ExprId value = word.op == WordOp::kCall ? PassesOf(word) : word.value;
    if (!value.Valid()) return;
    const std::optional<double> literal = LiteralValue(module, value);
    const std::optional<Limit> limit = LimitOf(site, word, literal.has_value());
    if (limit) Test(site, value, literal ? Interval::Point(*literal) : lookup.Evaluate(value), *limit, lookup);
  }

 private:
  [[nodiscard]] std::optional<Limit> LimitOf(const Site& site, const ir::Word& word, bool literal) const {
    const double most = static_cast<double>(input_.machine.passes_max) + kHalf;
    switch (word.op) {
      case WordOp::kCall:
        return Limit{.low = kHalf, .high = most, .range = "the passes of a call", .alarms = !literal};
      case WordOp::kRepeatPart:
        return Limit{.low = -kHalf, .high = most, .range = "the repetitions of a part", .alarms = !literal};
      case WordOp::kCycleValue:
        if (static_cast<ir::CycleField>(word.index) != ir::CycleField::kRepeats) return std::nullopt;
        return Limit{.low = -kHalf, .high = most, .range = "the repetitions of a cycle"};
      case WordOp::kAxis:
        if (Scales(site.block)) return kFactor;
        if (ir::IsRotary(word.index) &&
            (word.mode == ir::ValueMode::kPositive || word.mode == ir::ValueMode::kNegative))
          return Limit{.high = kLastOfTurn, .range = "0 to 359.999"};
        return std::nullopt;
      default:
        return OwnLimit(word, literal);
    }
  }

  [[nodiscard]] bool HoldsElement(ir::ExprId id) const {
    const ir::Expr& expr = input_.module.exprs[id];
    if (expr.op == ir::ExprOp::kElement || expr.op == ir::ExprOp::kCellAt) return true;
    bool holds = false;
    ForOperands(input_.module, expr, [&](ir::ExprId operand) { holds = holds || HoldsElement(operand); });
    return holds;
  }

  [[nodiscard]] bool Scales(ir::BlockId block) const {
    for (const ir::WordId id : input_.module.blocks[block].words) {
      const ir::Word& word = input_.module.words[id];
      const auto frame = static_cast<ir::FrameOp>(word.index);
      if (word.op == WordOp::kFrame && (frame == ir::FrameOp::kScale || frame == ir::FrameOp::kAddScale)) return true;
    }
    return false;
  }

  [[nodiscard]] ir::ExprId PassesOf(const ir::Word& word) const {
    const auto call = word.Extra<ir::CallId>();
    return input_.module.calls.Contains(call) ? input_.module.calls[call].passes : ir::ExprId{};
  }

  void Test(const Site& site, ir::ExprId expr, const Interval& value, const Limit& limit, Lookup& lookup) {
    if (!value.HasNumber()) return;
    const bool below = limit.above_low ? value.low <= limit.low : value.low < limit.low;
    const bool may_be_zero = limit.not_zero && value.HasZero();
    if (!below && value.high <= limit.high && !may_be_zero) return;
    const bool all_below = limit.above_low ? value.high <= limit.low : value.high < limit.low;
    const bool outside = all_below || value.low > limit.high || (limit.not_zero && value.IsZero());
    // An unknown value may be anything; a range around the limit says something only where the program makes it.
    // Elements of an array have one range together, and a bound at 0 may be rounded outward only.
    const bool noise = limit.above_low && value.low < 0 && value.low > -kNoise;
    const bool likely =
        limit.not_zero ? value.Has(Interval::kZeroSeen) : IsKnown(value) && !noise && !HoldsElement(expr);
    const Certainty certainty = outside && limit.alarms && !value.Has(Interval::kVacant) ? Certainty::kCertain
                                : outside || likely                                      ? Certainty::kLikely
                                                                                         : Certainty::kPossible;
    if (!findings_.IsNews(diag::Code::kOutOfRange, expr, 0, certainty)) return;
    ValueFinding finding{.code = diag::Code::kOutOfRange, .certainty = certainty};
    finding.first = check::TextOf(value);
    finding.second = limit.range;
    finding.at = RangeOf(site, expr);
    finding.notes = Reasons(site, expr, lookup);
    if (limit.alarms) finding.control = ControlAlarm(limit.alarm);
    findings_.Add(expr, 0, std::move(finding));
  }
};

}  // namespace

std::unique_ptr<ValueRule> MakeWordValues(const ValueRuleInput& input, ValueFindings& findings) {
  return std::make_unique<WordValues>(input, findings);
}

}  // namespace ncport::check
