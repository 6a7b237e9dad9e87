#include "check/endings.h"

#include "ir/block_words.h"
#include "ir/never_alarms.h"
#include "ir/word_values.h"

namespace ncport::check {

namespace {

using ir::ExprId;
using ir::WordOp;

// Texts are only printed here; a loop that ends where a number leaves the range of its type was not meant to.
constexpr ir::ExprOp kAlso[] = {ir::ExprOp::kConvert, ir::ExprOp::kText, ir::ExprOp::kConcat};

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
  ir::VisitValues(module, word, [&](ExprId value) { may = may || !ir::NeverAlarms(module, value, kAlso); });
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

bool StopsInside(const ir::Module& module, ir::BlockId first, ir::BlockId last) {
  for (std::uint32_t i = first.value; i <= last.value; ++i) {
    const ir::Block& block = module.blocks[ir::BlockId{std::size_t{i}}];
    if (ir::HasWord(module, block, WordOp::kStop) || ir::HasWord(module, block, WordOp::kOptionalStop)) return true;
  }
  return false;
}

}  // namespace ncport::check
