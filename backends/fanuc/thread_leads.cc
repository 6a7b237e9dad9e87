#include "backends/fanuc/thread_leads.h"

#include <map>

#include "ir/analysis/forward_flow.h"

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
  bool thread = false;  // its lead replaces the feed
  bool feed = false;    // names a feed
  bool relies = false;  // a feed move without a feed word
};

class Leads {
 public:
  // The data flow: is there a way here on which a thread took the feed?
  using State = bool;
  [[nodiscard]] State Entry(ProgramId) const { return false; }
  [[nodiscard]] State Unknown(ProgramId) const { return true; }
  bool Join(BlockId, State& into, State from) const {
    const bool before = into;
    into = into || from;
    return into != before;
  }
  void Transfer(ProgramId, BlockId block, State& lost) const {
    const Use& use = uses_.at(block);
    lost = use.thread || (lost && !use.feed);
  }

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

  const RaiseInput& input_;
  Module& module_;
  diag::Sink& sink_;
  ir::analysis::FlowGraphs graphs_;
  ir::analysis::CallGraph calls_;
  ir::analysis::ModalFlow flow_;
  std::map<BlockId, Use> uses_;
};

Use Leads::UseOf(ProgramId program, BlockId id) const {
  const ir::Block& block = module_.blocks[id];
  const ir::Motion motion = flow_.At(program, id).motion;
  Use use;
  bool lead = false, moves = false, elsewhere = false;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    lead = lead || word.op == WordOp::kCenter;
    use.feed = use.feed || word.op == WordOp::kFeed;
    moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius;
    elsewhere = elsewhere || word.op == WordOp::kFrame || word.op == WordOp::kReference ||
                word.op == WordOp::kPresetPosition || word.op == WordOp::kMachineCoords;
  }
  use.thread = motion == ir::Motion::kThread && lead;
  const bool cuts = motion != ir::Motion::kRapid && motion != ir::Motion::kThread;
  use.relies = moves && cuts && !elsewhere && !use.feed;
  return use;
}

bool Leads::Run() {
  bool any = false;
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId id : module_.programs[program].blocks) any = (uses_[id] = UseOf(program, id)).thread || any;
  }
  if (!any) return true;
  ir::analysis::ForwardFlow<Leads> flow({module_, *input_.source_machine, graphs_, calls_, &flow_}, *this);
  flow.Run();
  bool ok = true;
  for (const auto& [id, use] : uses_) {
    const ir::Block& block = module_.blocks[id];
    const bool* lost = flow.Before(id);
    if (use.relies && lost != nullptr && *lost) {
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
