// WriteStartModes: what a main program takes from the state in which its control starts.
#include <vector>

#include "backends/sinumerik/raise_words.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

/// `start` without the groups that every program sets before a word hangs on them.
ir::ModalState ReliedOn(const RaiseInput& input, const Module& module) {
  const ir::ModalState& start = input.source_machine->start;
  const ir::analysis::FlowAnalyses analyses(module, *input.source_machine, {ir::ModalState{}, input.SubEntry()});
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  ir::ModalState relied;
  bool path_words = false;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const ir::ModalState at = flow.At(program, id);
      bool moves = false, in_plane = false, feed = false, speed = false, lengths = false;
      for (const WordId word_id : module.blocks[id].words) {
        switch (module.words[word_id].op) {
          case WordOp::kAxis:
          case WordOp::kAxisComputed:
          case WordOp::kPolarAngle:
          case WordOp::kPolarRadius:
            moves = true;
            break;
          case WordOp::kCenter:
          case WordOp::kRadius:
          case WordOp::kOpeningAngle:
          case WordOp::kChamfer:
          case WordOp::kContourAngle:
            moves = in_plane = true;
            break;
          case WordOp::kFrame:
          case WordOp::kCutterComp:
          case WordOp::kPole:
          case WordOp::kEdge:
            in_plane = lengths = true;
            break;
          case WordOp::kFeed:
          case WordOp::kFeedOnce:
            feed = lengths = true;
            break;
          case WordOp::kSpeed:
            speed = true;
            break;
          case WordOp::kPathMode:
            path_words = true;
            break;
          default:
            break;
        }
      }
      const auto take = [](bool needed, auto now, auto& group, auto promised) {
        using Mode = decltype(now);
        if (needed && now == Mode::kUnknown) group = promised;
      };
      const bool cuts = moves && at.motion != ir::Motion::kRapid;
      take(moves, at.motion, relied.motion, start.motion);
      take(moves, at.distance, relied.distance, start.distance);
      take(moves || lengths, at.units, relied.units, start.units);
      take(moves || in_plane, at.plane, relied.plane, start.plane);
      take(cuts || feed, at.feed_mode, relied.feed_mode, start.feed_mode);
      take(speed, at.speed_mode, relied.speed_mode, start.speed_mode);
      take(cuts, at.comp, relied.comp, start.comp);
      if (input.source_machine->lathe) take(moves || in_plane, at.diameter, relied.diameter, start.diameter);
      if (at.path == ir::PathMode::kUnknown && moves) relied.path = start.path;
    }
  }
  if (!path_words) relied.path = ir::PathMode::kUnknown;
  return relied;
}

/// The first block behind the definitions, which must come first (sinumerik-1.2); none: there are only definitions.
BlockId FirstStatement(const Module& module, IdRange<BlockId> blocks) {
  BlockId first = blocks[0];
  for (const BlockId id : blocks) {
    for (const WordId word : module.blocks[id].words) {
      const WordOp op = module.words[word].op;
      const bool definition = op == WordOp::kDefine || op == WordOp::kExtern || op == WordOp::kHeader ||
                              op == WordOp::kFileMark || op == WordOp::kVerbatim;
      if (!definition) return first;
      first = BlockId{std::size_t{id.value} + 1};
    }
    if (module.blocks[id].words.Empty() && first == id) first = BlockId{std::size_t{id.value} + 1};
  }
  return {};
}

}  // namespace

void WriteStartModes(const RaiseInput& input, Translation& out, bool only_relied_on) {
  Module& module = out.module;
  const ir::ModalState start = only_relied_on ? ReliedOn(input, module) : input.source_machine->start;
  // G97 and G94 are of one group (15): the feed comes last, and leaves the speed constant.
  std::vector<Word> speed, modes;
  if (start.speed_mode != ir::SpeedMode::kUnknown) speed.push_back(ir::MakeWord(WordOp::kSpeedMode, start.speed_mode));
  if (start.motion != ir::Motion::kUnknown) modes.push_back(ir::MakeWord(WordOp::kMotion, start.motion));
  if (start.plane != ir::Plane::kUnknown) modes.push_back(ir::MakeWord(WordOp::kPlane, start.plane));
  if (start.distance != ir::Distance::kUnknown) modes.push_back(ir::MakeWord(WordOp::kDistance, start.distance));
  if (start.feed_mode != ir::FeedMode::kUnknown) modes.push_back(ir::MakeWord(WordOp::kFeedMode, start.feed_mode));
  if (start.comp != ir::CutterComp::kUnknown) modes.push_back(ir::MakeWord(WordOp::kCutterComp, start.comp));
  if (start.units != ir::Units::kUnknown) modes.push_back(ir::MakeWord(WordOp::kUnits, start.units));
  if (start.path != ir::PathMode::kUnknown) modes.push_back(ir::MakeWord(WordOp::kPathMode, start.path));
  if (start.work_offset.known) modes.push_back(ir::MakeWord(WordOp::kWorkOffset, 0, {}, start.work_offset.number));
  if (start.diameter != ir::Diameter::kUnknown) modes.push_back(ir::MakeWord(WordOp::kDiameter, start.diameter));
  bool any = false;
  for (const ir::ProgramId program : module.programs.Ids()) {
    const IdRange<BlockId> blocks = module.programs[program].blocks;
    if (module.programs[program].kind != ir::ProgramKind::kMain || blocks.Empty()) continue;
    ProgramEditor editor(module, program, "start_modes");
    const BlockId first = only_relied_on ? FirstStatement(module, blocks) : blocks[0];
    if (!first.Valid()) continue;  // nothing here relies on a mode
    for (const std::vector<Word>* words : {&speed, &modes}) {
      if (words->empty()) continue;
      Block made = editor.MakeBlock(first);
      made.flags = Block::kAdded;
      made.indent = 0;
      editor.SetWords(made, *words);
      ir::Comment comment;
      comment.text = module.strings.Intern("added: start of the source control");
      comment.place = ir::CommentPlace::kEndOfBlock;
      comment.gap = 1;
      made.comments = {module.comments.Add(comment).value, 1};
      editor.InsertBefore(first, made);
      any = true;
    }
    editor.Apply();
  }
  if (any) out.added.emplace_back("head of the main program: the modes in which the source control starts");
}

}  // namespace ncport::backends::sinumerik
