#include "ir/transform/constant_values.h"

#include <cmath>
#include <utility>

#include "ir/never_alarms.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/convert.h"
#include "ir/ops/functions.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

constexpr bool IsWhole(Type type) { return type == Type::kInt || type == Type::kBool || type == Type::kChar; }

constexpr ConstantValue Truth(bool value) { return {Type::kBool, value ? 1.0 : 0.0}; }

}  // namespace

ConstantValues::ConstantValues(const Module& module, const Machine& machine, ProgramId program,
                               const analysis::Cfg& cfg, bool keeps_locals, SystemConstant system, ConstantState entry)
    : module_(module),
      machine_(machine),
      program_(program),
      blocks_(cfg.Blocks()),
      system_(std::move(system)),
      entry_(std::move(entry)) {
  // What is written only where no way leads does not change a value.
  do {
    in_.assign(blocks_.count, std::nullopt);
    Solve(cfg);
  } while (keeps_locals && FindKept());
}

std::set<std::uint32_t> ConstantValues::Written() const {
  std::set<std::uint32_t> written;
  for (const BlockId block : blocks_) {
    if (!Reached(block)) continue;
    for (const WordId id : module_.blocks[block].words) {
      VisitWordExprs(module_, module_.words[id], [&](ExprId root, bool place) {
        const Expr& expr = module_.exprs[root];
        if (place && (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement)) written.insert(expr.a);
      });
    }
  }
  return written;
}

/// True if something came to what later runs find as it was left.
bool ConstantValues::FindKept() {
  const std::size_t before = kept_.size();
  kept_.merge(Written());
  return kept_.size() != before;
}

std::optional<ConstantValue> ConstantValues::Evaluate(BlockId block, ExprId expr) const {
  const auto& state = in_[block.value - blocks_.begin];
  return state ? Value(block, *state, expr) : std::nullopt;
}

std::optional<ConstantValue> ConstantValues::EvaluateAt(BlockId block, std::uint32_t word, ExprId expr) const {
  if (!in_[block.value - blocks_.begin]) return std::nullopt;
  return Value(block, Through(block, word), expr);
}

std::optional<ConstantValue> ConstantValues::Finished(double value, const Expr& expr, bool whole) const {
  if (!std::isfinite(value)) return std::nullopt;
  if (whole) {
    if (value > static_cast<double>(machine_.int_max) || value < static_cast<double>(machine_.int_min))
      return std::nullopt;
    return ConstantValue{Type::kInt, value};
  }
  if ((expr.flags & Expr::kNumericModel) != 0) value = ops::ApplyModel(value, machine_.numeric_model);
  return ConstantValue{Type::kReal, value};
}

std::optional<ConstantValue> ConstantValues::Arithmetic(const Expr& expr, ConstantValue a, ConstantValue b) const {
  const bool whole = IsWhole(a.type) && IsWhole(b.type);
  const auto done = [&](ops::Number number, bool integer) {
    return number.Ok() ? Finished(number.value, expr, integer) : std::nullopt;
  };
  const double tolerance = (expr.flags & Expr::kTolerance) != 0 ? machine_.compare_tolerance : 0;
  switch (expr.op) {
    case ExprOp::kAdd:
      return done(ops::Add(a.number, b.number), whole);
    case ExprOp::kSubtract:
      return done(ops::Subtract(a.number, b.number), whole);
    case ExprOp::kMultiply:
      return done(ops::Multiply(a.number, b.number), whole);
    case ExprOp::kDivide:
      return done(ops::Divide(a.number, b.number), false);
    case ExprOp::kDivideInteger:
    case ExprOp::kModulo: {
      const bool rounds = (expr.flags & Expr::kOperandsToInt) != 0;
      const double x = rounds ? ops::Round(a.number) : a.number, y = rounds ? ops::Round(b.number) : b.number;
      return done(expr.op == ExprOp::kModulo ? ops::Modulo(x, y) : ops::DivideInteger(x, y), whole || rounds);
    }
    case ExprOp::kEqual:
      return Truth(ops::Equal(a.number, b.number, tolerance));
    case ExprOp::kNotEqual:
      return Truth(!ops::Equal(a.number, b.number, tolerance));
    case ExprOp::kLess:
      return Truth(ops::Less(a.number, b.number, tolerance));
    case ExprOp::kLessEqual:
      return Truth(!ops::Less(b.number, a.number, tolerance));
    case ExprOp::kGreater:
      return Truth(ops::Less(b.number, a.number, tolerance));
    case ExprOp::kGreaterEqual:
      return Truth(!ops::Less(a.number, b.number, tolerance));
    case ExprOp::kXor:
      return Truth((a.number != 0) != (b.number != 0));
    default:
      return std::nullopt;
  }
}

std::optional<ConstantValue> ConstantValues::Value(BlockId block, const ConstantState& state, ExprId id) const {
  if (!id.Valid()) return std::nullopt;
  const Expr& expr = module_.exprs[id];
  const auto operand = [&](std::uint32_t child) { return Value(block, state, ExprId{child}); };
  switch (expr.op) {
    case ExprOp::kLiteral:
      return ConstantValue{expr.type, expr.number};
    case ExprOp::kAxisName:
      return ConstantValue{Type::kAxis, static_cast<double>(expr.a)};
    case ExprOp::kVariable: {
      const auto known = state.find(expr.a);
      return known == state.end() ? std::nullopt : std::optional(known->second);
    }
    case ExprOp::kSystem: {
      double index = 0;
      if (expr.count > 0) {
        const auto first = Value(block, state, module_.Item(expr.b));
        if (!first) return std::nullopt;
        index = ops::Round(first->number);
      }
      return system_(block, module_.systems[SystemId{expr.a}], index);
    }
    case ExprOp::kGroup:
      return operand(expr.a);
    case ExprOp::kAnd:
    case ExprOp::kOr: {
      // Both sides are evaluated: one of them decides only where the other cannot end in an alarm.
      const auto a = operand(expr.a), b = operand(expr.b);
      const bool either = expr.op == ExprOp::kOr;
      for (const bool left : {true, false}) {
        const auto& side = left ? a : b;
        const std::uint32_t other = left ? expr.b : expr.a;
        const bool decides = side && side->type != Type::kAxis && (side->number != 0) == either;
        if (decides && ((a && b) || NeverAlarms(module_, ExprId{other}))) return Truth(either);
      }
      return a && b ? std::optional(Truth(!either)) : std::nullopt;
    }
    case ExprOp::kFunction: {
      const auto function = static_cast<Function>(expr.a);
      constexpr std::size_t kMost = 3;
      if (!ops::IsNumeric(function) || expr.count > kMost) return std::nullopt;
      if (function == Function::kRoundToIncrement) return std::nullopt;  // that of its address, which the unit decides
      double args[kMost] = {};
      bool whole = true;
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        const auto value = Value(block, state, module_.Item(expr.b + i));
        if (!value || value->type == Type::kAxis) return std::nullopt;
        args[i] = value->number;
        whole = whole && IsWhole(value->type);
      }
      const bool keeps = function == Function::kAbs || function == Function::kMinimum ||
                         function == Function::kMaximum || function == Function::kBound;
      const ops::Number number = ops::Apply(function, args, expr.count, machine_);
      if (!number.Ok()) return std::nullopt;
      return Finished(number.value, expr, (keeps && whole) || expr.type == Type::kInt);
    }
    default:
      break;
  }
  if (OperandsOf(expr.op) == Operands::kUnary && expr.op != ExprOp::kCellAt) {
    const auto value = operand(expr.a);
    if (!value || value->type == Type::kAxis) return std::nullopt;
    switch (expr.op) {
      case ExprOp::kConvert: {
        const bool cuts = expr.type == Type::kInt && (expr.flags & Expr::kRoundCut) != 0;
        if (expr.type == Type::kReal) return ConstantValue{Type::kReal, value->number};
        if (!IsWhole(expr.type)) return std::nullopt;
        const ops::Number number =
            cuts ? ops::ToIntCut(value->number, machine_) : ops::Convert(value->number, expr.type, machine_);
        return number.Ok() ? std::optional(ConstantValue{expr.type, number.value}) : std::nullopt;
      }
      case ExprOp::kPlus:
        return ConstantValue{IsWhole(value->type) ? Type::kInt : Type::kReal, value->number};
      case ExprOp::kNegate:
        return Finished(0.0 - value->number, expr, IsWhole(value->type));
      case ExprOp::kNot:
        return Truth(value->number == 0);
      default:
        return std::nullopt;
    }
  }
  if (OperandsOf(expr.op) != Operands::kBinary) return std::nullopt;
  const auto a = operand(expr.a), b = operand(expr.b);
  if (!a || !b) return std::nullopt;
  if (a->type == Type::kAxis || b->type == Type::kAxis) return std::nullopt;
  return Arithmetic(expr, *a, *b);
}

void ConstantValues::Write(ConstantState& state, ExprId place, std::optional<ConstantValue> value, bool sure) const {
  const Expr& target = module_.exprs[place];
  if (target.op != ExprOp::kVariable && target.op != ExprOp::kElement) return;
  const Variable& variable = module_.variables[VariableId{target.a}];
  const bool followed = target.op == ExprOp::kVariable && variable.owner == program_ && !variable.by_reference &&
                        variable.dimension_count == 0 && !variable.lower_limit.Valid() && !variable.upper_limit.Valid();
  state.erase(target.a);
  if (!followed || !sure || !value) return;
  if ((value->type == Type::kAxis) != (variable.type == Type::kAxis)) return;
  if (variable.type == Type::kAxis || variable.type == Type::kReal) {
    state[target.a] = {variable.type, value->number};
  } else if (IsWhole(variable.type)) {
    const ops::Number number = ops::Convert(value->number, variable.type, machine_);
    if (number.Ok()) state[target.a] = {variable.type, number.value};
  }
}

void ConstantValues::ThroughWord(BlockId block, const Word& word, bool sure, ConstantState& state) const {
  switch (word.op) {
    case WordOp::kAssign:
      return Write(state, word.Extra<ExprId>(), Value(block, state, word.value), sure);
    case WordOp::kFor: {
      const Expr& counter = module_.exprs[module_.fors[word.Extra<ForId>()].variable];
      state.erase(counter.a);
      return;
    }
    case WordOp::kDefine: {
      const VariableId id = word.Extra<VariableId>();
      const Variable& variable = module_.variables[id];
      state.erase(id.value);
      if (kept_.contains(id.value)) return;
      if (variable.initial_list.Valid() || variable.dimension_count > 0 || variable.owner != program_ || !sure) return;
      if (variable.type != Type::kReal && !IsWhole(variable.type)) return;
      if (variable.lower_limit.Valid() || variable.upper_limit.Valid()) return;
      const auto value = variable.initial.Valid() ? Value(block, state, variable.initial)
                                                  : std::optional(ConstantValue{variable.type, 0});
      if (!value || value->type == Type::kAxis) return;
      const ops::Number number = ops::Convert(value->number, variable.type, machine_);
      if (number.Ok()) state[id.value] = {variable.type, number.value};
      return;
    }
    default: {
      // Lists, and arguments that may be written by reference.
      if (word.op == WordOp::kAssignList || word.op == WordOp::kCall || word.op == WordOp::kModalCall) {
        VisitWordExprs(module_, word, [&](ExprId root, bool) {
          VisitReads(module_, root, [&](ExprId id) {
            const Expr& expr = module_.exprs[id];
            if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) state.erase(expr.a);
          });
        });
      }
    }
  }
}

ConstantState ConstantValues::Through(BlockId id, std::uint32_t words) const {
  ConstantState state = *in_[id.value - blocks_.begin];
  const Block& block = module_.blocks[id];
  bool sure = block.skip_level == Block::kNoSkip;
  for (std::uint32_t i = 0; i < words && i < block.words.count; ++i) {
    const Word& word = module_.words[block.words[i]];
    sure = sure && word.op != WordOp::kWhen && word.op != WordOp::kSkipRest;
    ThroughWord(id, word, sure, state);
  }
  return state;
}

void ConstantValues::Solve(const analysis::Cfg& cfg) {
  if (blocks_.Empty()) return;
  std::set<std::uint32_t> work{0};
  in_[0] = entry_;
  const auto arrive = [&](BlockId to, const ConstantState& state) {
    auto& known = in_[to.value - blocks_.begin];
    bool changed = !known;
    if (!known) {
      known = state;
    } else {
      changed = std::erase_if(*known, [&](const auto& entry_value) {
                  const auto other = state.find(entry_value.first);
                  return other == state.end() || other->second != entry_value.second;
                }) > 0;
    }
    if (changed) work.insert(to.value - blocks_.begin);
  };
  while (!work.empty()) {
    const BlockId id = blocks_[*work.begin()];
    work.erase(work.begin());
    const Block& block = module_.blocks[id];
    const ConstantState after = Through(id, block.words.count);
    // A lone test that is decided leaves one way.
    std::optional<bool> holds;
    WordOp op = WordOp::kInert;
    if (block.words.count == 1 && block.skip_level == Block::kNoSkip) {
      const Word& word = module_.words[block.words[0]];
      op = word.op;
      const bool tests = op == WordOp::kIf || op == WordOp::kWhile || op == WordOp::kUntil || op == WordOp::kJump;
      if (tests && word.value.Valid()) {
        const auto value = Value(id, *in_[id.value - blocks_.begin], word.value);
        if (value && value->type != Type::kAxis) holds = value->number != 0;
      }
    }
    for (const analysis::Edge& edge : cfg.Successors(id)) {
      if (holds && op == WordOp::kJump && (edge.kind == analysis::EdgeKind::kNext) == *holds) continue;
      if (holds && op != WordOp::kJump && (edge.kind == analysis::EdgeKind::kFalse) == *holds) continue;
      if (edge.to.Valid()) arrive(edge.to, after);
      if (edge.kind != analysis::EdgeKind::kComputed) continue;
      for (const BlockId target : cfg.ComputedTargets()) arrive(target, after);
    }
  }
}

}  // namespace ncport::ir::transform
