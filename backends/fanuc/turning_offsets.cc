#include "backends/fanuc/turning_offsets.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "backends/fanuc/text_word.h"
#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

constexpr std::uint8_t kZ = 2;

/// Whether the offset of the tool is named on arrival at a block: one answer for every way, or kMixed.
enum class Offset : std::uint8_t { kOpen, kNamed, kMixed };

class Pass {
 public:
  // The data flow.
  using State = Offset;
  /// A program without a tool call works with the offset that is in force: it has nothing to name.
  [[nodiscard]] State Entry(ProgramId) const { return Offset::kNamed; }
  [[nodiscard]] State Unknown(ProgramId) const { return Offset::kMixed; }
  bool Join(BlockId, State& into, State from) const {
    const State before = into;
    if (into != from) into = Offset::kMixed;
    return into != before;
  }
  void Transfer(ProgramId, BlockId block, State& state) const {
    const Words words = Look(module_.blocks[block]);
    if (words.tool) state = Offset::kOpen;
    if (words.moves_z) state = Offset::kNamed;
  }

  Pass(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input),
        out_(out),
        sink_(sink),
        module_(out.module),
        analyses_(input.Analyse(out.module)),
        flow_(analyses_.Modal()),
        offsets_(analyses_.Sources(), *this),
        has_y_(std::find(input.profile->axes.begin(), input.profile->axes.end(), "Y") != input.profile->axes.end()) {}

  bool Run() {
    offsets_.Run();
    for (const ProgramId program : module_.programs.Ids()) Rewrite(program);
    return ok_;
  }

 private:
  struct Words {
    bool tool = false, moves = false, moves_z = false, conditional = false;
  };
  [[nodiscard]] Words Look(const Block& block) const;
  void Rewrite(ProgramId program);
  void Refuse(const Block& block, std::string_view what, std::string_view help) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, input_.profile->name).help = help;
  }

  const RaiseInput& input_;
  Translation& out_;
  diag::Sink& sink_;
  Module& module_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  ir::analysis::ForwardFlow<Pass> offsets_;
  bool has_y_ = false;
  bool ok_ = true;
};

Pass::Words Pass::Look(const Block& block) const {
  Words words;
  words.conditional = block.skip_level != Block::kNoSkip;
  bool elsewhere = false;
  for (const WordId id : block.words) {
    const Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kInert:
        words.tool = words.tool || IsToolCall(module_, word);
        break;
      case WordOp::kAxis:
        words.moves = true;
        words.moves_z = words.moves_z || word.index == kZ;
        break;
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        words.conditional = true;
        break;
      case WordOp::kFrame:
      case WordOp::kReference:
      case WordOp::kPresetPosition:
      case WordOp::kMachineCoords:
        elsewhere = true;
        break;
      default:
        break;
    }
  }
  if (elsewhere) words.moves = words.moves_z = false;
  return words;
}

void Pass::Rewrite(ProgramId program) {
  ProgramEditor editor(module_, program, "turning_offsets");
  for (const BlockId id : module_.programs[program].blocks) {
    const Block block = module_.blocks[id];
    const Words words = Look(block);
    const Offset* arrival = offsets_.Before(id);  // none: no way leads here
    if (!words.moves || arrival == nullptr || *arrival == Offset::kNamed) continue;
    const bool rapid = flow_.At(program, id).motion == ir::Motion::kRapid;
    if (*arrival == Offset::kMixed) {
      if (words.moves_z)
        Refuse(block, "a move of Z that a tool change may lie before, or not: its offset would be named on every way",
               "move Z at rapid behind each tool change before the ways meet");
      continue;
    }
    if (!rapid) {
      Refuse(block, "a move under feed before the tool offset is named",
             "the first move of X and Z behind a tool change must be a rapid");
      continue;
    }
    if (!words.moves_z) continue;
    if (words.conditional) {
      Refuse(block, "a first move behind a tool change in a block that may be skipped", "");
      continue;
    }
    std::vector<Word> first, second;
    bool other_axis = false;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      const bool z = word.op == WordOp::kAxis && word.index == kZ;
      other_axis = other_axis || (word.op == WordOp::kAxis && !z);
      (z ? second : first).push_back(word);
    }
    if (other_axis && flow_.ModalCallPossible(program, id)) {
      Refuse(block, "a first move behind a tool change under a modal call, which would run behind each of its parts",
             "move to the work in front of the modal call");
      continue;
    }
    second.insert(second.begin(), TextWord(module_, "G43 P1"));
    second.push_back(TextWord(module_, "H#3020"));
    if (!other_axis) {
      // Z alone: Y is named with it, for its offset comes in here too.
      if (has_y_) second.insert(second.begin() + 1, TextWord(module_, "Y0."));
      first.insert(first.end(), second.begin(), second.end());
    } else if (has_y_) {
      first.push_back(TextWord(module_, "Y0."));
    }
    editor.SetWords(id, first);
    if (!other_axis) continue;
    editor.PutBehind(id, second);
    const ir::Origin& origin = module_.origins[block.origin];
    out_.split_rapids.push_back({origin.file, origin.line});
  }
  editor.Apply();
}

}  // namespace

bool NameTurningOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const auto& word = input.profile->fanuc.length_word;
  if (!input.profile->IsLathe() || !word.Is(dialects::FanucSettings::LengthWord::kG43P1)) return true;
  const std::size_t before = out.split_rapids.size();
  const bool ok = Pass(input, out, sink).Run();
  if (out.split_rapids.size() != before)
    out.added.emplace_back(
        "first rapid behind a tool change: X, then Z with the tool offset (G43 P1): come from outside only");
  return ok;
}

}  // namespace ncport::backends::fanuc
