#include "ir/transform/conditions.h"

#include "ir/builder.h"
#include "ir/comparison.h"

namespace ncport::ir::transform {

namespace {

/// Below brackets and conversions to BOOL, which change no truth.
ExprId Core(const Module& module, ExprId id) {
  while (true) {
    const Expr& expr = module.exprs[id];
    const bool to_bool = expr.op == ExprOp::kConvert && expr.type == Type::kBool;
    if (expr.op != ExprOp::kGroup && !to_bool) return id;
    id = ExprId{expr.a};
  }
}

/// True when a part of `id` is computed by statements on some target.
bool NeedsStatements(const Module& module, ExprId id) {
  const Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor:
    case ExprOp::kNot:
      return true;
    case ExprOp::kFunction:
      switch (static_cast<Function>(expr.a)) {
        case Function::kSin:
        case Function::kCos:
        case Function::kTan:
        case Function::kSqrt:
        case Function::kAbs:
        case Function::kTruncate:
        case Function::kRound:
          break;
        default:
          return true;
      }
      break;
    default:
      if (IsComparison(expr.op)) return true;
      break;
  }
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return false;
    case Operands::kUnary:
      return NeedsStatements(module, ExprId{expr.a});
    case Operands::kBinary:
      return NeedsStatements(module, ExprId{expr.a}) || NeedsStatements(module, ExprId{expr.b});
    case Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        if (NeedsStatements(module, module.Item(expr.b + i))) return true;
      }
      return false;
  }
  return false;
}

/// Builds a chain; labels are steps that are not known yet.
class Chain {
 public:
  explicit Chain(Module& module) : module_(module), make_(module) {}

  /// Jumps to `label` when `id` has the truth value `sense`, falls through otherwise.
  void Add(ExprId id, bool sense, std::int32_t label);
  std::vector<ConditionalJump> Take() {
    for (ConditionalJump& step : steps_) {
      if (step.to <= kFirstLabel) step.to = places_[static_cast<std::size_t>(kFirstLabel - step.to)];
    }
    return std::move(steps_);
  }

 private:
  static constexpr std::int32_t kFirstLabel = -2;  // labels count down from here

  std::int32_t NewLabel() {
    places_.push_back(0);
    return kFirstLabel - static_cast<std::int32_t>(places_.size() - 1);
  }
  void Bind(std::int32_t label) {
    places_[static_cast<std::size_t>(kFirstLabel - label)] = static_cast<std::int32_t>(steps_.size());
  }

  Module& module_;
  ExprBuilder make_;
  std::vector<ConditionalJump> steps_;
  std::vector<std::int32_t> places_;
};

void Chain::Add(ExprId id, bool sense, std::int32_t label) {
  id = Core(module_, id);
  const Expr expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kNot:
      return Add(ExprId{expr.a}, !sense, label);
    case ExprOp::kAnd:
    case ExprOp::kOr:
      if ((expr.op == ExprOp::kOr) == sense) {  // one side alone decides for the jump
        Add(ExprId{expr.a}, sense, label);
        return Add(ExprId{expr.b}, sense, label);
      } else {  // both sides must have the sense: the first that has not leads past them
        const std::int32_t behind = NewLabel();
        Add(ExprId{expr.a}, !sense, behind);
        Add(ExprId{expr.b}, sense, label);
        return Bind(behind);
      }
    case ExprOp::kLiteral:
      if ((expr.number != 0) == sense) steps_.push_back({{}, label});
      return;
    default:
      break;
  }
  if (IsComparison(expr.op)) {
    const ExprId condition = sense ? id : make_.Binary(Negated(expr.op), ExprId{expr.a}, ExprId{expr.b}, expr.flags);
    steps_.push_back({condition, label});
    return;
  }
  steps_.push_back({make_.Binary(sense ? ExprOp::kNotEqual : ExprOp::kEqual, id, make_.Literal(0)), label});
}

}  // namespace

bool IsTruth(const Module& module, ExprId expr) {
  const ExprOp op = module.exprs[Core(module, expr)].op;
  return IsComparison(op) || op == ExprOp::kAnd || op == ExprOp::kOr || op == ExprOp::kXor || op == ExprOp::kNot;
}

bool IsPlainComparison(const Module& module, ExprId condition) {
  const Expr& expr = module.exprs[Core(module, condition)];
  return IsComparison(expr.op) && !NeedsStatements(module, ExprId{expr.a}) && !NeedsStatements(module, ExprId{expr.b});
}

bool IsSimplePlace(const Module& module, ExprId expr) {
  const ExprOp op = module.exprs[expr].op;
  return op == ExprOp::kVariable || op == ExprOp::kCell || op == ExprOp::kLiteral;
}

std::vector<ConditionalJump> JumpsFor(Module& module, ExprId condition, bool sense) {
  Chain chain(module);
  chain.Add(condition, sense, ConditionalJump::kTarget);
  return chain.Take();
}

}  // namespace ncport::ir::transform
