#include "ir/transform/conditional_blocks.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "base/letter_case.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

class Pass {
 public:
  Pass(Module& module, ProgramId program, std::string_view prefix)
      : module_(module), program_(program), prefix_(prefix), make_(module), editor_(module, program, "conditions") {}

  void Run() {
    for (const BlockId id : module_.programs[program_].blocks) {
      const Block& block = module_.blocks[id];
      if (block.label.Valid()) labels_.insert(UpperOf(module_.View(block.label)));
    }
    for (const BlockId id : module_.programs[program_].blocks) {
      const Block block = module_.blocks[id];
      if ((block.flags & Block::kRefused) != 0) continue;  // never runs
      std::vector<Word> before, rest;
      ExprId condition;
      for (const WordId word_id : block.words) {
        const Word word = module_.words[word_id];
        if (word.op == WordOp::kWhen && !condition.Valid()) {
          condition = word.value;
        } else {
          (condition.Valid() ? rest : before).push_back(word);
        }
      }
      if (condition.Valid()) Split(id, block, before, condition, rest);
    }
    editor_.Apply();
  }

 private:
  void Split(BlockId id, const Block& block, const std::vector<Word>& before, ExprId condition,
             std::vector<Word> rest) {
    const auto put = [&](const std::vector<Word>& words) { editor_.PutInFront(id, words, {.comments = true}); };
    if (!before.empty()) put(before);
    if (rest.size() == 1 && rest[0].op == WordOp::kJump && !rest[0].value.Valid()) {
      rest[0].value = condition;
      put(rest);
    } else if (block.skip_level != Block::kNoSkip) {
      const StringId label = NewLabel();
      Jump jump;
      jump.target.label = label;
      put({MakeWord(WordOp::kJump, 0, make_.Unary(ExprOp::kNot, make_.Unary(ExprOp::kGroup, condition)),
                    module_.jumps.Add(jump).value)});
      put(rest);
      Block place = editor_.MakeBlock(id);
      place.label = label;
      editor_.InsertBefore(id, place);
    } else {
      // A structure mark carries neither a label nor a number that jumps look for.
      const Block& head = module_.blocks[id];
      if (head.label.Valid() || head.number != Block::kNoNumber) editor_.PutInFront(id, {});
      put({MakeWord(WordOp::kIf, 0, condition)});
      put(rest);
      put({MakeWord(WordOp::kEndIf)});
    }
    editor_.Remove(id);
  }

  /// Labels compare without regard to case in some languages: new ones differ in every one.
  StringId NewLabel() {
    std::string label;
    do label = fmt::format("{}{}", prefix_, next_++);
    while (!labels_.insert(UpperOf(label)).second);
    return module_.strings.Intern(label);
  }

  Module& module_;
  ProgramId program_;
  std::string_view prefix_;
  ExprBuilder make_;
  ProgramEditor editor_;
  std::set<std::string, std::less<>> labels_;
  int next_ = 1;
};

}  // namespace

void ConditionalBlocks(Module& module, ProgramId program, std::string_view label_prefix) {
  Pass(module, program, label_prefix).Run();
}

}  // namespace ncport::ir::transform
