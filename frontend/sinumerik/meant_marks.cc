#include "frontend/sinumerik/meant_marks.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "frontend/common/chars.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

using ir::WordOp;

namespace {

constexpr WordOp kMarks[] = {WordOp::kIf,       WordOp::kElse,   WordOp::kEndIf,  WordOp::kWhile,
                             WordOp::kEndWhile, WordOp::kFor,    WordOp::kEndFor, WordOp::kLoop,
                             WordOp::kEndLoop,  WordOp::kRepeat, WordOp::kUntil};

/// The mark that ends what `mark` opens; kMotion: it opens nothing.
WordOp EndOf(WordOp mark) {
  switch (mark) {
    case WordOp::kIf:
      return WordOp::kEndIf;
    case WordOp::kWhile:
      return WordOp::kEndWhile;
    case WordOp::kFor:
      return WordOp::kEndFor;
    case WordOp::kLoop:
      return WordOp::kEndLoop;
    case WordOp::kRepeat:
      return WordOp::kUntil;
    default:
      return WordOp::kMotion;
  }
}

struct Opener {
  WordOp end;
  ir::BlockId meant;  // block that may have been meant as the end
};

}  // namespace

std::string_view MarkName(WordOp mark) {
  switch (mark) {
    case WordOp::kIf:
      return "IF";
    case WordOp::kElse:
      return "ELSE";
    case WordOp::kEndIf:
      return "ENDIF";
    case WordOp::kWhile:
      return "WHILE";
    case WordOp::kEndWhile:
      return "ENDWHILE";
    case WordOp::kFor:
      return "FOR";
    case WordOp::kEndFor:
      return "ENDFOR";
    case WordOp::kLoop:
      return "LOOP";
    case WordOp::kEndLoop:
      return "ENDLOOP";
    case WordOp::kRepeat:
      return "REPEAT";
    case WordOp::kUntil:
      return "UNTIL";
    default:
      return NameOf(mark);
  }
}

WordOp MeantMark(std::string_view word) {
  const ForeignWord* foreign = FindForeignWord(word);
  std::string_view meant = foreign != nullptr ? foreign->instead : NearStatementWord(word);
  for (const Behind behind : {Behind::kAnything, Behind::kComparison, Behind::kTo}) {
    const std::string split = AsRunTogether(word, behind);
    if (!split.empty()) meant = word.substr(0, split.find(' '));
  }
  for (const WordOp mark : kMarks) {
    if (IsWord(meant, MarkName(mark))) return mark;
  }
  return WordOp::kMotion;
}

void TakeMeantEnds(const SourceFiles& files, ir::Module& module, ir::ProgramId program, BlockSink& blocks,
                   diag::Sink& sink) {
  std::vector<Opener> open;
  std::array<std::uint32_t, 256> waiting{};  // open structures by the mark that ends them
  const auto close = [&] {
    const Opener opener = open.back();
    open.pop_back();
    --waiting[static_cast<std::size_t>(opener.end)];
    if (!opener.meant.Valid()) return;
    ir::Block& block = module.blocks[opener.meant];
    const SourceRange at = module.RangeOf(block, module.words[block.words[0]]);
    const std::string_view line = files.Line(at.file, at.line);
    const std::string_view text = line.substr(at.begin, at.end - at.begin);
    const ForeignWord* foreign = FindForeignWord(text);
    sink.Report(diag::Code::kUnknownWord, at, text).help =
        foreign != nullptr ? std::string(foreign->help) : "did you mean " + std::string(MarkName(opener.end)) + "?";
    blocks.KeepRefused(line, at.begin, at.end, opener.end, block);
  };
  for (const ir::BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    if (block.words.count != 1) continue;
    const ir::Word& word = module.words[block.words[0]];
    const WordOp op = word.op == WordOp::kVerbatim ? static_cast<WordOp>(word.index) : word.op;
    if (EndOf(op) != WordOp::kMotion) {
      open.push_back({EndOf(op), {}});
      ++waiting[static_cast<std::size_t>(EndOf(op))];
    } else if (open.empty()) {
      continue;
    } else if (op == WordOp::kCall && !open.back().meant.Valid()) {
      const ir::Call& call = module.calls[word.Extra<ir::CallId>()];
      if (call.name.Valid() && !call.has_brackets && MeantMark(module.View(call.name)) == open.back().end)
        open.back().meant = id;
    } else if (waiting[static_cast<std::size_t>(op)] != 0) {
      while (open.back().end != op) close();
      --waiting[static_cast<std::size_t>(op)];
      open.pop_back();
    }
  }
  while (!open.empty()) close();
}

}  // namespace ncport::frontend::sinumerik
