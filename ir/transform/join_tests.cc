#include "ir/transform/join_tests.h"

#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

const Word* OnlyWord(const Module& module, const Block& block, WordOp op) {
  if (block.words.count != 1 || block.skip_level != Block::kNoSkip || (block.flags & Block::kRefused) != 0)
    return nullptr;
  const Word& word = module.words[block.words[0]];
  return word.op == op ? &word : nullptr;
}

bool IsTarget(const Block& block) { return block.label.Valid() || block.number != Block::kNoNumber; }

}  // namespace

void JoinTests(Module& module, ProgramId program) {
  const IdRange<BlockId> blocks = module.programs[program].blocks;
  ProgramEditor editor(module, program, "join_tests");
  for (std::uint32_t i = 0; i + 2 < blocks.count; ++i) {
    const BlockId open = blocks[i], jump = blocks[i + 1], close = blocks[i + 2];
    const Word* test = OnlyWord(module, module.blocks[open], WordOp::kIf);
    const Word* leave = OnlyWord(module, module.blocks[jump], WordOp::kJump);
    if (test == nullptr || leave == nullptr || leave->value.Valid()) continue;
    if (OnlyWord(module, module.blocks[close], WordOp::kEndIf) == nullptr) continue;
    if (IsTarget(module.blocks[jump]) || IsTarget(module.blocks[close])) continue;
    Word joined = *leave;
    joined.value = test->value;
    editor.SetWords(jump, {joined});
    module.blocks[jump].indent = module.blocks[open].indent;
    editor.Remove(open);
    editor.Remove(close);
  }
  editor.Apply();
}

}  // namespace ncport::ir::transform
