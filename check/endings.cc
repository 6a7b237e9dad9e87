#include "check/endings.h"

#include "ir/word_values.h"

namespace ncport::check {

namespace {

using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

bool MayAlarm(const ir::Module& module, ExprId id) {
  const ir::Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
    case ExprOp::kText:
    case ExprOp::kVariable:
    case ExprOp::kCell:
    case ExprOp::kAxisName:
      return false;
    case ExprOp::kGroup:
    case ExprOp::kConvert:
    case ExprOp::kPlus:
    case ExprOp::kNegate:
    case ExprOp::kNot:
      return MayAlarm(module, ExprId{std::size_t{expr.a}});
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kMultiply:
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor:
    case ExprOp::kConcat:
      return MayAlarm(module, ExprId{std::size_t{expr.a}}) || MayAlarm(module, ExprId{std::size_t{expr.b}});
    default:
      return true;
  }
}

bool MayEnd(const ir::Module& module, const ir::Word& word) {
  switch (word.op) {
    case WordOp::kCall:
    case WordOp::kModalCall:
    case WordOp::kAlarm:
    case WordOp::kStop:
    case WordOp::kOptionalStop:
    case WordOp::kVerbatim:
      return true;
    default:
      break;
  }
  bool may = false;
  ir::VisitValues(module, word, [&](ExprId value) { may = may || MayAlarm(module, value); });
  return may;
}

}  // namespace

bool MayEndInside(const ir::Module& module, ir::BlockId first, ir::BlockId last) {
  for (std::uint32_t i = first.value; i <= last.value; ++i) {
    const ir::Block& block = module.blocks[ir::BlockId{std::size_t{i}}];
    if ((block.flags & ir::Block::kRefused) != 0) return true;
    for (const ir::WordId word : block.words) {
      if (MayEnd(module, module.words[word])) return true;
    }
  }
  return false;
}

}  // namespace ncport::check
