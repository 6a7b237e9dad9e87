#include <string_view>

#include "check/expressions.h"
#include "check/rules.h"
#include "check/word_expressions.h"
#include "ir/ops/text.h"

namespace ncport::check {
namespace {

using ir::ExprId;

void CheckText(const Subject& subject, ir::BlockId block, const ir::Word& word, ExprId id, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const ir::Expr& expr = module.exprs[id];
  ForOperands(module, expr, [&](ExprId operand) { CheckText(subject, block, word, operand, sink); });
  if (expr.op != ir::ExprOp::kFunction || static_cast<ir::Function>(expr.a) != ir::Function::kParseNumber) return;
  if (expr.count != 1) return;
  const ir::Expr& text = module.exprs[Plain(module, module.Item(expr.b))];
  if (text.op != ir::ExprOp::kText) return;
  const std::string_view written = module.View(StringId{std::size_t{text.a}});
  if (ir::ops::ParseNumber(written).Ok()) return;
  diag::Diagnostic& finding =
      sink.Report(diag::Code::kTypeMismatch, subject.PlaceOf(block, word), written, "the text of a number");
  finding.help = "a number is digits, with a sign, a decimal point or an exponent";
}

}  // namespace

void CheckConstantTexts(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  for (const ir::BlockId block : subject.module.programs[program].blocks) {
    if ((subject.module.blocks[block].flags & ir::Block::kRefused) != 0) continue;
    for (const ir::WordId id : subject.module.blocks[block].words) {
      const ir::Word& word = subject.module.words[id];
      ForExpressions(subject.module, word, [&](ExprId value) { CheckText(subject, block, word, value, sink); });
    }
  }
}

}  // namespace ncport::check
