#include "backends/sinumerik/print.h"

#include "backends/sinumerik/printer.h"
#include "base/number_text.h"

namespace ncport::backends::sinumerik {

void Printer::PutNumber(std::uint32_t number, std::uint8_t digits) { AppendNumber(out_, number, digits, 0, false); }

void Printer::Block(const ir::Block& block) {
  for (std::uint16_t i = 0; i < block.indent; ++i) out_.Append(' ');
  std::size_t begin = out_.size();
  const auto separate = [&] {
    if (out_.size() != begin) out_.Append(' ');
  };
  if (block.skip_level != ir::Block::kNoSkip) {
    out_.Append('/');
    // Without a digit it is the first level of the control.
    const bool first = profile_.skip.Or(0) == block.skip_level;
    if ((block.flags & ir::Block::kSkipDigit) != 0 || !first) {
      AppendInteger(out_, block.skip_level);
      out_.Append(' ');
    }
    begin = out_.size();
  }
  if (block.number != ir::Block::kNoNumber) {
    separate();
    out_.Append((block.flags & ir::Block::kMainBlock) != 0 ? ':' : 'N');
    PutNumber(block.number, block.number_digits);
  }
  if (block.label.Valid()) {
    separate();
    out_.Append(module_.View(block.label));
    out_.Append(':');
  }
  const ir::Word* before = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == ir::WordOp::kDefine) {
      // The names of one DEF are words of their own.
      const bool first = before == nullptr || before->op != ir::WordOp::kDefine;
      if (first) separate();
      Define(word, first);
    } else {
      separate();
      Word(word);
    }
    before = &word;
  }
  for (const ir::CommentId id : block.comments) {
    const ir::Comment& comment = module_.comments[id];
    std::uint16_t gap = comment.place == ir::CommentPlace::kOwnLine ? 0 : comment.gap;
    if (gap == 0 && out_.size() != begin && comment.place != ir::CommentPlace::kEndOfBlock) gap = 1;
    for (; gap != 0; --gap) out_.Append(' ');
    out_.Append(';');
    out_.Append(module_.View(comment.text));
  }
  out_.Append('\n');
}

void PrintFile(const ir::Module& module, FileId file, const dialects::Profile& profile, TextBuffer& out) {
  Printer printer(module, profile, out);
  for (const ir::Program& program : module.programs.All()) {
    if (program.file != file) continue;
    for (const ir::BlockId block : program.blocks) printer.Block(module.blocks[block]);
  }
}

void PrintExpr(const ir::Module& module, ir::ExprId expr, const dialects::Profile& profile, TextBuffer& out) {
  Printer(module, profile, out).Expr(expr);
}

}  // namespace ncport::backends::sinumerik
