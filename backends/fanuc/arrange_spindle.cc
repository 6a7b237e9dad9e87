#include "backends/fanuc/arrange_spindle.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "backends/fanuc/text_word.h"
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

}  // namespace

bool ArrangeSpindle(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "arrange_spindle");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::vector<Word> limit, spindle, rest;
      bool has_mode = false, has_speed = false, has_feed_mode = false, surface = false;
      for (const WordId word_id : block.words) {
        const Word word = module.words[word_id];
        switch (word.op) {
          case WordOp::kSpeedLimit:
            limit.push_back(word);
            break;
          case WordOp::kSpeedMode:
            has_mode = true;
            surface = word.index == static_cast<std::uint8_t>(ir::SpeedMode::kConstantSurface);
            spindle.insert(spindle.begin(), word);
            break;
          case WordOp::kSpeed:
          case WordOp::kSpindle:
            if (word.index != 0 && word.index != 1) {
              sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), "a second spindle", profile.name);
              ok = false;
            }
            has_speed = has_speed || word.op == WordOp::kSpeed;
            spindle.push_back(word);
            break;
          case WordOp::kFeedMode:
            has_feed_mode = true;
            rest.push_back(word);
            break;
          default:
            rest.push_back(word);
        }
      }
      if (limit.empty() && spindle.empty()) continue;
      const ir::ModalState state = flow.At(program, id);
      if (profile.IsLathe() && has_speed && !has_mode) {
        // On a lathe S means 1/min or m/min by the mode in force: it is named with each S (mazak-lathe-5.2).
        if (state.speed_mode == ir::SpeedMode::kUnknown) {
          sink.Report(diag::Code::kUnknownModalState, module.RangeOf(block), "the speed mode (1/min or surface speed)",
                      "the programs that lead here leave it open");
          ok = false;
        } else {
          spindle.insert(spindle.begin(), ir::MakeWord(WordOp::kSpeedMode, state.speed_mode));
        }
      }
      if (surface && input.source_machine->surface_speed_per_revolution && !has_feed_mode) {
        rest.insert(rest.begin(), ir::MakeWord(WordOp::kFeedMode, ir::FeedMode::kPerRevolution));
      }
      const std::string r_word = profile.spindle.r_word.Or("");
      const bool r_everywhere = profile.machine_class.Is(dialects::MachineClass::kQuickTurn);
      if (!r_word.empty() && r_everywhere && has_speed) spindle.push_back(TextWord(module, r_word));
      // The limit first: without it the spindle would run up as the tool nears the axis (hazards#5).
      if (!limit.empty()) editor.PutInFront(id, limit);
      // Words before the motion stand in front of it, M5 behind (sinumerik-8.10), and with it all that comes after the
      // motion, in its order: M5 behind M30 would never run.
      const auto acts_behind = [](const Word& word) { return word.phase >= ir::Phase::kAfter; };
      std::vector<Word> behind;
      if (std::any_of(spindle.begin(), spindle.end(), acts_behind)) {
        for (const WordId word_id : block.words) {
          if (acts_behind(module.words[word_id])) behind.push_back(module.words[word_id]);
        }
        std::erase_if(spindle, acts_behind);
        std::erase_if(rest, acts_behind);
      }
      if (rest.empty()) {  // what is left stands in one block
        spindle.insert(spindle.end(), behind.begin(), behind.end());
        rest = std::exchange(spindle, {});
        behind.clear();
      }
      editor.SetWords(id, rest);
      if (rest.empty()) editor.Remove(id);
      if (!spindle.empty()) editor.PutInFront(id, spindle);
      if (!behind.empty()) editor.PutBehind(id, behind);
    }
    editor.Apply();
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
