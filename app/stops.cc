#include "app/stops.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::app {
namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordOp;

/// Rounds of raising: each one stops a block at least, and one refusal can bring the next to light.
constexpr int kMaxRounds = 200;

bool Flows(const Module& module, const Block& block) {
  if ((block.flags & Block::kRefused) != 0) return true;  // what it holds is not known: it may be a jump
  for (const ir::WordId id : block.words) {
    const WordOp op = module.words[id].op;
    if (ir::DefaultPhaseOf(op) == ir::Phase::kFlow || op == WordOp::kProgramEnd || op == WordOp::kReturn ||
        op == WordOp::kHeader || op == WordOp::kWhen) {
      return true;
    }
  }
  return false;
}

constexpr std::string_view kMark = "NOT TRANSLATED: ";

/// The original text stands in front of its alarm, as a comment of its own.
void CommentsInFront(Module& module) {
  for (const ir::ProgramId program : module.programs.Ids()) {
    ir::transform::ProgramEditor editor(module, program, "stops");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      if (block.comments.Empty() || block.words.Empty()) continue;
      if (!module.View(module.comments[block.comments[0]].text).starts_with(kMark)) continue;
      Block comment = editor.MakeBlock(id);
      comment.comments = block.comments;
      module.blocks[id].comments = {};
      editor.InsertBefore(id, comment);
    }
    if (editor.Changed()) editor.Apply();
  }
}

/// The block keeps its label, number and skip level: jumps to it lead to the stop.
void Stop(const Context& context, Module& module, BlockId id, const std::vector<Word>& words) {
  const SourceRange at = module.RangeOf(module.blocks[id]);
  Block& block = module.blocks[id];
  ir::SetWords(module, block, words);
  ir::Comment comment;
  comment.text = module.strings.Intern(fmt::format("{}{}", kMark, context.files.Line(at.file, at.line)));
  comment.place = ir::CommentPlace::kEndOfBlock;
  block.comments = {static_cast<std::uint32_t>(module.comments.Size()), 1};
  module.comments.Add(comment);
}

Word AlarmWord(Module& module) {
  const ir::ExprId alarm = ir::ExprBuilder(module).Literal(backends::kStopAlarm, ir::Type::kInt);
  return ir::MakeWord(WordOp::kAlarm, ir::AlarmKind::kStops, alarm);
}

}  // namespace

bool RaiseWithStops(Context& context, const backends::TranslateInput& input, backends::Translation& translation,
                    ir::Module& running) {
  running = *input.source;
  Module stopped = *input.source;
  std::vector<bool> done(stopped.blocks.Size(), false);
  backends::TranslateInput round = input;
  round.source = &stopped;
  for (int i = 0; i < kMaxRounds; ++i) {
    const std::size_t before = context.findings.All().size();
    translation = {};
    if (backends::Raise(round, translation, context.findings)) {
      CommentsInFront(translation.module);
      translation.stopped_blocks = static_cast<std::uint32_t>(std::count(done.begin(), done.end(), true));
      return true;
    }
    bool more = false;
    std::vector<SourceRange> refused;
    for (std::size_t k = before; k < context.findings.All().size(); ++k) {
      const diag::Diagnostic& finding = context.findings.All()[k];
      if (finding.severity == diag::Severity::kError) refused.push_back(finding.at);
    }
    // What a failed round says besides is said again by the next one.
    std::size_t index = 0;
    context.findings.Remove([&](const diag::Diagnostic& finding) {
      return index++ >= before && finding.severity != diag::Severity::kError;
    });
    for (const SourceRange& at : refused) {
      bool found = false;
      for (std::uint32_t k = 0; k < done.size(); ++k) {
        const BlockId id{k};
        const SourceRange place = stopped.RangeOf(stopped.blocks[id]);
        if (!at.file.Valid() || place.file != at.file || place.line != at.line) continue;
        found = true;
        if (done[k]) continue;
        if (Flows(*input.source, input.source->blocks[id])) {
          context.findings.Report(diag::Code::kRefusedWhole, place).help =
              "rewrite the block, or leave the program out of the set";
          return false;
        }
        done[k] = more = true;
        Stop(context, stopped, id, backends::StopWords(*input.to, stopped));
        Stop(context, running, id, {AlarmWord(running)});
      }
      if (!found) return false;  // a profile or ncport.toml must answer first
    }
    if (!more) return false;
  }
  return false;
}

}  // namespace ncport::app
