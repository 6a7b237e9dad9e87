#include "backends/fanuc/references.h"

#include <vector>

#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

Word DistanceWord(ir::Distance distance) {
  Word word = ir::MakeWord(WordOp::kDistance, distance);
  word.flags = Word::kAdded;
  return word;
}

}  // namespace

bool HasIncrementLetter(const dialects::Profile& profile, std::uint8_t axis) {
  constexpr std::uint8_t kC = 5;
  if (axis > 2 && axis != kC) return false;
  return (axis == kC ? 3U : axis) < profile.words.incremental_axes.Or("").size();
}

void ReferencesToSteps(const RaiseInput& input, Translation& out) {
  if (input.source_machine->reference_via_point) return;
  ir::Module& module = out.module;
  const ir::ExprId nothing = ir::ExprBuilder(module).Literal(0, ir::Type::kReal);
  for (const ir::ProgramId program : module.programs.Ids()) {
    ir::transform::ProgramEditor editor(module, program, "references_to_steps");
    for (const BlockId id : module.programs[program].blocks) {
      Block& block = module.blocks[id];
      bool reference = false, letters = true;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        reference = reference || (word.op == WordOp::kReference &&
                                  word.index == static_cast<std::uint8_t>(ir::ReferenceKind::kReference));
        letters = letters && (word.op != WordOp::kAxis || HasIncrementLetter(*input.profile, word.index));
      }
      if (!reference) continue;
      // Lathes without the letters have no word for the distance mode either: the steps are refused by name.
      letters = letters || input.profile->words.absolute.Or("").empty();
      std::vector<Word> words;
      if (!letters) words.push_back(DistanceWord(ir::Distance::kIncremental));
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        if (word.op == WordOp::kAxis) {
          word.value = nothing;
          word.mode = letters ? ir::ValueMode::kIncremental : ir::ValueMode::kModal;
        }
        words.push_back(word);
      }
      editor.SetWords(id, words);
      if (!letters) editor.PutBehind(id, {DistanceWord(ir::Distance::kAbsolute)});
    }
    editor.Apply();
  }
}

}  // namespace ncport::backends::fanuc
