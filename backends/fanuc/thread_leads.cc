#include "backends/fanuc/thread_leads.h"

#include <map>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/modal_state.h"

namespace ncport::backends::fanuc {

namespace {

using ir::BlockId;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

/// What a block means for the feed in force.
struct Use {
  bool thread = false;   // its lead replaces the feed
  bool feed = false;     // names a feed
  bool relies = false;   // a feed move without a feed word
  bool skipped = false;  // may be left out
  std::vector<ProgramId> callees;
};

class Leads {
 public:
  Leads(const RaiseInput& input, Module& module, diag::Sink& sink)
      : input_(input),
        module_(module),
        sink_(sink),
        graphs_(module),
        calls_(module),
        flow_(module, *input.source_machine, graphs_, calls_,
              {input.source_machine->start, input.config != nullptr ? input.config->entry : ir::ModalState{}}) {}

  bool Run();

 private:
  [[nodiscard]] Use UseOf(ProgramId program, BlockId block) const;
  void Follow();

  const RaiseInput& input_;
  Module& module_;
  diag::Sink& sink_;
  ir::analysis::FlowGraphs graphs_;
  ir::analysis::CallGraph calls_;
  ir::analysis::ModalFlow flow_;
  std::map<BlockId, Use> uses_;
  std::map<BlockId, bool> lost_;    // on some way here a thread took the feed
  std::vector<bool> entry_, exit_;  // the same, by program
};

Use Leads::UseOf(ProgramId program, BlockId id) const {
  const ir::Block& block = module_.blocks[id];
  const ir::Motion motion = flow_.At(program, id).motion;
  Use use;
  use.skipped = block.skip_level != ir::Block::kNoSkip;
  bool lead = false, moves = false, elsewhere = false;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    lead = lead || word.op == WordOp::kCenter;
    use.feed = use.feed || word.op == WordOp::kFeed;
    moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius;
    if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<ir::CallId>().Valid()) {
      const ProgramId callee = module_.calls[word.Extra<ir::CallId>()].program;
      if (callee.Valid()) use.callees.push_back(callee);
    }
    if (word.op == WordOp::kWhen) use.skipped = true;
    elsewhere = elsewhere || word.op == WordOp::kFrame || word.op == WordOp::kReference ||
                word.op == WordOp::kPresetPosition || word.op == WordOp::kMachineCoords;
  }
  use.thread = motion == ir::Motion::kThread && lead;
  const bool cuts = motion != ir::Motion::kRapid && motion != ir::Motion::kThread;
  use.relies = moves && cuts && !elsewhere && !use.feed;
  return use;
}

void Leads::Follow() {
  entry_.assign(module_.programs.Size(), false);
  exit_.assign(module_.programs.Size(), false);
  // Only more ways lose the feed from round to round, so this ends.
  for (bool changed = true; changed;) {
    changed = false;
    const auto lose = [&](auto&& place) {
      if (place) return;
      place = true;
      changed = true;
    };
    for (const ProgramId program : module_.programs.Ids()) {
      const IdRange<BlockId> blocks = module_.programs[program].blocks;
      if (blocks.Empty()) continue;
      if (entry_[program.value]) lose(lost_[blocks[0]]);
      const ir::analysis::Cfg& graph = graphs_.Of(program);
      for (const BlockId id : blocks) {
        const Use& use = uses_[id];
        const bool before = lost_[id];
        bool after = use.thread || (before && (!use.feed || use.skipped));
        for (const ProgramId callee : use.callees) {
          if (after) lose(entry_[callee.value]);
          after = after || exit_[callee.value];
        }
        if (!after) continue;
        for (const ir::analysis::Edge& edge : graph.Successors(id)) {
          if (edge.to.Valid()) {
            lose(lost_[edge.to]);
          } else if (edge.kind == ir::analysis::EdgeKind::kComputed) {
            for (const BlockId target : graph.ComputedTargets()) lose(lost_[target]);
          } else {
            lose(exit_[program.value]);
          }
        }
      }
    }
  }
}

bool Leads::Run() {
  bool any = false;
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId id : module_.programs[program].blocks) any = (uses_[id] = UseOf(program, id)).thread || any;
  }
  if (!any) return true;
  Follow();
  bool ok = true;
  for (const auto& [id, use] : uses_) {
    const ir::Block& block = module_.blocks[id];
    if (use.relies && lost_[id]) {
      ok = false;
      sink_
          .Report(diag::Code::kNotExpressible, module_.RangeOf(block), "a feed that was written before a thread",
                  input_.profile->name)
          .help = "the lead of a thread is its F there: write F again behind the thread";
    }
    if (!use.thread) continue;
    for (const WordId word_id : block.words) {
      Word& word = module_.words[word_id];
      if (word.op != WordOp::kCenter) continue;
      word.op = WordOp::kFeed;
      word.index = 0;
      word.mode = ir::ValueMode::kModal;
      word.phase = ir::DefaultPhaseOf(WordOp::kFeed);
    }
  }
  return ok;
}

}  // namespace

bool ThreadLeads(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  return Leads(input, out.module, sink).Run();
}

}  // namespace ncport::backends::fanuc
