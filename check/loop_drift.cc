#include "check/loop_drift.h"

#include <fmt/format.h>

#include "check/expressions.h"
#include "ir/comparison.h"

namespace ncport::check {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;
using ir::analysis::Interval;

void SumOperands::Add(const ir::Module& module, ExprId expr, const Interval* operands, std::size_t count) {
  const ExprOp op = module.exprs[expr].op;
  if (count != 2 || (op != ExprOp::kAdd && op != ExprOp::kSubtract)) return;
  Both& known = sums_[expr.value];
  for (std::size_t i = 0; i < 2; ++i) known.values[i] = ir::analysis::Join(known.values[i], operands[i]);
}

const Interval* SumOperands::Find(ExprId expr, std::size_t operand) const {
  const auto found = sums_.find(expr.value);
  return found == sums_.end() ? nullptr : &found->second.values[operand];
}

LoopDrift::Way LoopDrift::Turned(Way way) { return way == Way::kUp ? Way::kDown : way == Way::kDown ? Way::kUp : way; }

/// Of the sum of two values, or of two steps that come one behind the other.
LoopDrift::Way LoopDrift::Together(Way a, Way b) {
  if (a == Way::kStill) return b;
  return b == Way::kStill || a == b ? a : Way::kUnknown;
}

// Sums, products with a number and roundings keep the order of values also where the arithmetic rounds.
LoopDrift::Way LoopDrift::WayOf(ExprId id) {
  if (changes_.Unchanged(loop_.program, id, loop_.first, loop_.last)) return Way::kStill;
  const Expr& expr = module_.exprs[id];
  const ExprId left{std::size_t{expr.a}};
  const ExprId right{std::size_t{expr.b}};
  switch (expr.op) {
    case ExprOp::kVariable:
    case ExprOp::kCell:
      return WayOfPlace(id);
    case ExprOp::kGroup:
    case ExprOp::kPlus:
      return WayOf(left);
    case ExprOp::kConvert:
      return expr.type == ir::Type::kReal || expr.type == ir::Type::kInt ? WayOf(left) : Way::kUnknown;
    case ExprOp::kNegate:
      return Turned(WayOf(left));
    case ExprOp::kAdd:
      return Together(WayOf(left), WayOf(right));
    case ExprOp::kSubtract:
      return Together(WayOf(left), Turned(WayOf(right)));
    case ExprOp::kMultiply:
    case ExprOp::kDivide: {
      const std::optional<double> factor = LiteralValue(module_, right);
      if (!factor || *factor == 0) return Way::kUnknown;
      return *factor > 0 ? WayOf(left) : Turned(WayOf(left));
    }
    default:
      return Way::kUnknown;
  }
}

LoopDrift::Way LoopDrift::WayOfPlace(ExprId id) {
  const Expr& place = module_.exprs[id];
  const PlacesRead read = changes_.ReadsOf(loop_.program, id);
  if (!read.known) return Way::kUnknown;
  if (place.op == ExprOp::kVariable) {
    // Other types do not keep the order of what they hold.
    const ir::Type type = module_.variables[ir::VariableId{std::size_t{place.a}}].type;
    if (type != ir::Type::kReal && type != ir::Type::kInt) return Way::kUnknown;
  }
  Way all = Way::kStill;
  for (std::uint32_t i = loop_.first.value; i <= loop_.last.value; ++i) {
    const BlockId block{std::size_t{i}};
    for (const ir::WordId id_of_word : module_.blocks[block].words) {
      const ir::Word& word = module_.words[id_of_word];
      if (!changes_.Changes(word, read)) continue;
      if (word.op != WordOp::kAssign || !SamePlace(module_.exprs[word.Extra<ExprId>()], place)) return Way::kUnknown;
      const Way step = StepOf(word, place);
      all = Together(all, step);
      if (all == Way::kUnknown) return all;
      if (step != Way::kStill) steps_.push_back({block, id_of_word, step});
    }
  }
  return all;
}

/// `place = place + step`, also with minus, whose step has one sign whenever it runs.
LoopDrift::Way LoopDrift::StepOf(const ir::Word& word, const Expr& place) const {
  const ExprId id = Plain(module_, word.value);
  const Expr& sum = module_.exprs[id];
  if (sum.op != ExprOp::kAdd && sum.op != ExprOp::kSubtract) return Way::kUnknown;
  const bool first = SamePlace(module_.exprs[Plain(module_, ExprId{std::size_t{sum.a}})], place);
  if (!first &&
      (sum.op == ExprOp::kSubtract || !SamePlace(module_.exprs[Plain(module_, ExprId{std::size_t{sum.b}})], place)))
    return Way::kUnknown;
  const Interval* step = sums_.Find(id, first ? 1 : 0);
  if (step == nullptr || step->IsNone() || step->Has(Interval::kVacant)) return Way::kUnknown;
  const bool plus = sum.op == ExprOp::kAdd;
  if (step->low > 0) return plus ? Way::kUp : Way::kDown;
  if (step->high < 0) return plus ? Way::kDown : Way::kUp;
  return step->IsZero() ? Way::kStill : Way::kUnknown;
}

Course LoopDrift::Of(ExprId condition, bool truth) {
  if (changes_.Unchanged(loop_.program, condition, loop_.first, loop_.last)) return Course::kStill;
  const ExprId id = Plain(module_, condition);
  const Expr& expr = module_.exprs[id];
  const ExprId left{std::size_t{expr.a}};
  const ExprId right{std::size_t{expr.b}};
  switch (expr.op) {
    case ExprOp::kNot:
      return Of(left, !truth);
    case ExprOp::kAnd:
    case ExprOp::kOr: {
      // Whichever side holds now does so in the next pass.
      const Course a = Of(left, truth);
      const Course b = a == Course::kOpen ? a : Of(right, truth);
      if (b == Course::kOpen) return b;
      return a == Course::kDrifts ? a : b;
    }
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual: {
      const bool above = (expr.op == ExprOp::kGreater || expr.op == ExprOp::kGreaterEqual) == truth;
      const Way way = Together(WayOf(left), Turned(WayOf(right)));
      if (way == Way::kStill) return Course::kStill;
      return way == (above ? Way::kUp : Way::kDown) ? Course::kDrifts : Course::kOpen;
    }
    default:
      return Course::kOpen;
  }
}

void LoopDrift::Explain(diag::Diagnostic& finding, bool truth, bool never) const {
  if (!steps_.empty()) {
    const Step& step = steps_.front();
    const ir::Word& word = module_.words[step.word];
    const std::string name = NameOfPlace(module_, module_.exprs[word.Extra<ExprId>()]);
    const char* way = step.way == Way::kUp ? "up" : "down";
    const char* value = truth ? "true" : "false";
    finding.notes.push_back(
        {module_.RangeOf(module_.blocks[step.block], word),
         never ? fmt::format("{} goes {} here until the condition would be {}, but the loop goes on with {} alone",
                             name, way, value, value)
               : fmt::format("{} only goes {} here, so the condition stays {}", name, way, value)});
  }
  finding.help = "count the other way, or turn the comparison round";
}

}  // namespace ncport::check
