// What FANUC programs say in ways of their own: steps under G91, and the flags that a reader of FANUC text gives to
// words and operations, so that the program as IR means what its text says.
#include "backends/fanuc/print_expr.h"
#include "tests/random/maker.h"
#include "tests/random/walk.h"

namespace ncport::tests::random {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

namespace {

constexpr std::uint8_t kArithmetic = Expr::kVacantAsZero | Expr::kNumericModel;

/// A number as a word holds it: the sign belongs to it.
bool IsLiteral(const ir::Module& module, ExprId id) {
  const Expr& expr = module.exprs[id];
  if (expr.op == ExprOp::kGroup || expr.op == ExprOp::kPlus) return IsLiteral(module, ExprId{expr.a});
  if (expr.op != ExprOp::kNegate) return expr.op == ExprOp::kLiteral;
  const Expr& inner = module.exprs[ExprId{expr.a}];
  return inner.op == ExprOp::kLiteral && inner.number >= 0;
}

void Finish(Expr& expr, const ir::Module& module) {
  switch (expr.op) {
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
      expr.flags = Expr::kVacantDiffers;
      break;
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
      expr.flags = Expr::kVacantAsZero;
      break;
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kMultiply:
    case ExprOp::kDivide:
    case ExprOp::kFunction:
      expr.type = ir::Type::kReal;
      expr.flags = kArithmetic;
      break;
    case ExprOp::kNegate:
      expr.type = ir::Type::kNumber;
      expr.flags = kArithmetic;
      break;
    case ExprOp::kGroup:
      expr.type = module.exprs[ExprId{expr.a}].type;
      break;
    default:
      break;
  }
}

}  // namespace

void Maker::FinishWords(ir::ProgramId program) {
  for (const ExprId id : ReachableExprs(module_)) Finish(module_.exprs[id], module_);
  for (const ir::BlockId block : module_.programs[program].blocks) {
    for (const ir::WordId id : module_.blocks[block].words) {
      ir::Word& word = module_.words[id];
      if (!word.value.Valid() || IsLiteral(module_, word.value)) continue;
      switch (word.op) {
        case WordOp::kFeed:
          word.flags |= ir::Word::kVanishesVacant;
          break;
        case WordOp::kAxis:
        case WordOp::kCenter:
        case WordOp::kRadius:
        case WordOp::kSpeed:
        case WordOp::kSpeedLimit:
        case WordOp::kDwellSeconds:
        case WordOp::kRadiusOffset:
        case WordOp::kCycleValue:
          word.flags |= ir::Word::kVanishesVacant | ir::Word::kRoundsValue;
          break;
        default:
          continue;
      }
      // `X-#1`: the sign is the word's (fanuc-3.2).
      Expr& value = module_.exprs[word.value];
      if (value.op != ExprOp::kNegate) continue;
      const ExprOp inner = module_.exprs[ExprId{value.a}].op;
      if (inner == ExprOp::kCell || inner == ExprOp::kCellAt) value.flags = 0;
    }
  }
}

// Five brackets in each other is what the control takes (fanuc-4.2); words, conditions and indices add some.
bool Maker::TooDeep(const Made& made) const {
  constexpr int kMost = 2;
  return !IsSinumerik() && backends::fanuc::BracketDepth(module_, made.id, false) > kMost;
}

// G91, a few steps from where the axes stand, G90.
void Maker::MakeSteps() {
  if (TransverseAxis() != 0xFF) return MakeLinear();
  std::vector<std::uint8_t> axes;
  for (const std::uint8_t axis : AllAxes()) {
    if (axis < 3 && IsPlaced(axis) && MayDrift(axis, 60 * UnitFactor())) axes.push_back(axis);
  }
  if (axes.empty()) return MakeLinear();
  Ready();
  ir::BlockBuilder on = NewBlock();
  SetDistance(on, ir::Distance::kIncremental);
  NeedUnits(on);
  Emit(on);
  const std::uint32_t moves = 1 + random_.Below(3);
  for (std::uint32_t i = 0; i < moves; ++i) {
    ir::BlockBuilder block = NewBlock();
    const bool rapid = random_.Percent(40);
    SetMotion(block, rapid ? ir::Motion::kRapid : ir::Motion::kLinear);
    const std::uint8_t first = random_.PickFrom(axes);
    const std::uint8_t second = random_.PickFrom(axes);
    AxisWord(block, first, false, 2);
    if (second != first) AxisWord(block, second, false, 1);
    if (!rapid) NeedFeed(block);
    Emit(block);
  }
  ir::BlockBuilder off = NewBlock();
  SetDistance(off, ir::Distance::kAbsolute);
  Emit(off);
}

}  // namespace ncport::tests::random
