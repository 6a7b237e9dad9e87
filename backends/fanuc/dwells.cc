#include "backends/fanuc/dwells.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "ir/analysis/flow_analyses.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::FeedMode;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;
using Counts = dialects::FanucSettings::Dwell;

Word FeedModeWord(FeedMode mode) {
  Word word = ir::MakeWord(WordOp::kFeedMode, mode);
  word.flags = Word::kAdded;
  return word;
}

/// The first call by which the source comes to a program that ncport brings along, or nothing.
SourceRange CallOf(const Module& module, ProgramId library) {
  std::vector<ProgramId> wanted{library};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    for (const ProgramId caller : module.programs.Ids()) {
      for (const BlockId id : module.programs[caller].blocks) {
        const Block& block = module.blocks[id];
        for (const WordId word_id : block.words) {
          const Word& word = module.words[word_id];
          const bool call = word.op == WordOp::kCall || word.op == WordOp::kModalCall;
          if (!call || !word.Extra<ir::CallId>().Valid()) continue;
          if (module.calls[word.Extra<ir::CallId>()].program != wanted[i]) continue;
          if (!module.programs[caller].library) return module.RangeOf(block, word);
          if (std::find(wanted.begin(), wanted.end(), caller) == wanted.end()) wanted.push_back(caller);
        }
      }
    }
  }
  return {};
}

}  // namespace

bool MapDwells(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  const Counts* const counts = profile.fanuc.dwell.Known() ? &*profile.fanuc.dwell : nullptr;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  bool ok = true;
  for (const ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "map_dwells");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::vector<Word> words;
      bool seconds = false, turns = false, names_mode = false;
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        seconds = seconds || word.op == WordOp::kDwellSeconds;
        turns = turns || word.op == WordOp::kDwellRevolutions;
        names_mode = names_mode || word.op == WordOp::kFeedMode;
        if (word.op == WordOp::kDwellRevolutions) word.op = WordOp::kDwellSeconds;  // one word, the mode says which
        // The word that makes a dwell of its block in the source: in the target it is a part of the dwell's form.
        if (word.op == WordOp::kInert && word.phase == ir::Phase::kMotion) continue;
        words.push_back(word);
      }
      if (!seconds && !turns) continue;
      const auto refuse = [&](std::string_view what, std::string_view help) {
        ok = false;
        const SourceRange place = module.RangeOf(block);
        // In a cycle of ncport's own there is nothing to mend: the finding stands at the call.
        const SourceRange call = module.programs[program].library ? CallOf(module, program) : SourceRange{};
        diag::Diagnostic& finding =
            sink.Report(diag::Code::kNotExpressible, call.Valid() ? call : place, what, profile.name);
        finding.help = help;
        if (call.Valid()) finding.notes.push_back({place, "the cycle dwells here"});
      };
      editor.SetWords(id, words);
      if (turns && (counts == nullptr || *counts != Counts::kRevolutions)) {
        refuse(
            "a dwell in turns of the spindle",
            "write the seconds that they take; where the control counts turns, say so: fanuc.dwell = \"revolutions\"");
        continue;
      }
      if (seconds && counts != nullptr && *counts == Counts::kTime) continue;
      const FeedMode needed = turns ? FeedMode::kPerRevolution : FeedMode::kPerMinute;
      const FeedMode mode = flow.At(program, id).feed_mode;
      if (mode == needed || !flow.Reached(program, id)) continue;
      if (mode != FeedMode::kPerMinute && mode != FeedMode::kPerRevolution) {
        refuse("a dwell while the feed mode is not known, which says whether it counts seconds or turns",
               "write the feed mode (G94, G95) on every way that leads here");
        continue;
      }
      if (names_mode) {
        refuse("a feed mode beside a dwell", "write the feed mode in a block of its own");
        continue;
      }
      editor.PutInFront(id, {FeedModeWord(needed)});
      editor.PutBehind(id, {FeedModeWord(mode)});
    }
    editor.Apply();
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
