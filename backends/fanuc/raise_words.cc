#include "backends/fanuc/raise_words.h"

#include <string>
#include <string_view>

#include "backends/fanuc/message_text.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/block_words.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

/// Takes words out of a block and gives it a comment instead.
class CommentMaker {
 public:
  CommentMaker(Module& module, ir::ProgramId program)
      : module_(module), editor_(module, program, "texts_to_comments") {}

  void Replace(BlockId id, const std::vector<Word>& kept, const std::string& text) {
    Block& block = module_.blocks[id];
    editor_.SetWords(block, kept);
    IdRange<ir::CommentId> comments{static_cast<std::uint32_t>(module_.comments.Size()), block.comments.count + 1};
    ir::Comment comment;
    comment.text = module_.strings.Intern(text);
    comment.place = kept.empty() ? ir::CommentPlace::kOwnLine : ir::CommentPlace::kEndOfBlock;
    module_.comments.Add(comment);
    for (const ir::CommentId old : block.comments) {
      const ir::Comment copy = module_.comments[old];
      module_.comments.Add(copy);
    }
    block.comments = comments;
  }
  void Remove(BlockId id) { editor_.Remove(id); }
  void Apply() { editor_.Apply(); }

 private:
  Module& module_;
  ProgramEditor editor_;
};

}  // namespace

void TextsToComments(const RaiseInput&, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  for (const ir::ProgramId program : module.programs.Ids()) {
    CommentMaker maker(module, program);
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::vector<Word> kept;
      std::string text;
      for (const WordId word_id : block.words) {
        const Word word = module.words[word_id];
        std::string made;
        switch (word.op) {
          case WordOp::kMessage:
          case WordOp::kPrint:
            if (!word.value.Valid()) {
              made = "MSG";
              break;
            }
            made = "MSG ";
            AppendMessage(module, word.value, made);
            break;
          case WordOp::kWorkpiece: {
            made = "WORKPIECE";
            for (const ir::ArgId arg : module.calls[word.Extra<ir::CallId>()].args) {
              made += arg.value == module.calls[word.Extra<ir::CallId>()].args.begin ? " " : ",";
              AppendMessage(module, module.args[arg].value, made);
            }
            break;
          }
          case WordOp::kPreprocessStop:
            made = "STOPRE";
            break;
          case WordOp::kHeader:
          case WordOp::kExtern:
          case WordOp::kFileMark:
            continue;
          default:
            kept.push_back(word);
            continue;
        }
        out.messages_lost = out.messages_lost || word.op == WordOp::kMessage || word.op == WordOp::kPrint;
        sink.Report(diag::Code::kListedLoss, module.RangeOf(block, word), made, "this target");
        out.losses.push_back({module.RangeOf(block, word), made});
        text += (text.empty() ? "" : " ") + made;
      }
      if (!text.empty()) {
        maker.Replace(id, kept, text);
      } else if (kept.size() != block.words.count) {
        if (kept.empty() && block.comments.Empty()) {
          maker.Remove(id);
        } else {
          ir::SetWords(module, module.blocks[id], kept);
        }
      }
    }
    maker.Apply();
  }
}

void NameMotions(const RaiseInput& input, Translation& out) {
  Module& module = out.module;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  for (const ir::ProgramId program : module.programs.Ids()) {
    ir::Motion running = ir::Motion::kUnknown;  // of the block before on the straight way down
    for (const BlockId id : module.programs[program].blocks) {
      Block& block = module.blocks[id];
      bool moves = false, named = false, leaves = false, shift = false;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius ||
                word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius;
        named = named || word.op == WordOp::kMotion;
        leaves = leaves || ir::DefaultPhaseOf(word.op) == ir::Phase::kFlow || word.op == WordOp::kInert;
        shift = shift || word.op == WordOp::kFrame || word.op == WordOp::kPole || word.op == WordOp::kReference;
      }
      if (shift) continue;  // its axis words are no move under the motion mode
      if (block.label.Valid() || block.number != Block::kNoNumber || leaves || block.skip_level != Block::kNoSkip)
        running = ir::Motion::kUnknown;
      const ir::Motion motion = flow.At(program, id).motion;
      if (moves && !named && motion != running && motion != ir::Motion::kUnknown) {
        std::vector<Word> words{ir::MakeWord(WordOp::kMotion, motion)};
        for (const WordId word_id : block.words) words.push_back(module.words[word_id]);
        ir::SetWords(module, block, words);
      }
      if (moves || named) running = motion;
      if (leaves || block.skip_level != Block::kNoSkip) running = ir::Motion::kUnknown;
    }
  }
}

}  // namespace ncport::backends::fanuc
