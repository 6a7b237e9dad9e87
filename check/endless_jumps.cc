// Loops of jumps that nothing leaves.
#include <vector>

#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::WordOp;
using ir::analysis::Edge;
using ir::analysis::EdgeKind;

/// An operator stands at the machine and decides how often: the loop is meant.
bool Stops(const ir::Module& module, const ir::Block& block) {
  for (const ir::WordId id : block.words) {
    const WordOp op = module.words[id].op;
    if (op == WordOp::kStop || op == WordOp::kOptionalStop || op == WordOp::kVerbatim) return true;
  }
  return (block.flags & ir::Block::kRefused) != 0 || block.skip_level != ir::Block::kNoSkip;
}

}  // namespace

// Marks the blocks from which a way leads out, backwards from all ways out.
void CheckEndlessJumps(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const ir::analysis::Cfg& graph = subject.graphs.Of(program);
  const auto blocks = graph.Blocks();
  if (graph.Opaque() || blocks.Empty()) return;
  std::vector<std::uint8_t> leaves(blocks.count, 0);
  std::vector<BlockId> open;
  const auto leave = [&](BlockId id) {
    std::uint8_t& mark = leaves[id.value - blocks.begin];
    if (mark == 0) open.push_back(id);
    mark = 1;
  };
  for (const BlockId id : blocks) {
    bool out = Stops(module, module.blocks[id]);
    for (const Edge& edge : graph.Successors(id)) out = out || !edge.to.Valid() || edge.kind == EdgeKind::kRestart;
    if (out) leave(id);
  }
  while (!open.empty()) {
    const BlockId id = open.back();
    open.pop_back();
    for (const BlockId before : graph.Predecessors(id)) leave(before);
  }
  for (const BlockId id : blocks) {
    if (leaves[id.value - blocks.begin] != 0 || !graph.Reachable(id)) continue;
    for (const ir::WordId word_id : module.blocks[id].words) {
      const ir::Word& word = module.words[word_id];
      if (word.op != WordOp::kJump) continue;
      const BlockId to = subject.graphs.LabelsOf(program).Find(module.jumps[word.Extra<ir::JumpId>()].target, id,
                                                               module.jumps[word.Extra<ir::JumpId>()].search);
      if (!to.Valid() || to > id) continue;
      diag::Diagnostic& finding = sink.Report(diag::Code::kEndlessLoop, subject.PlaceOf(id, word));
      finding.notes.push_back({module.RangeOf(module.blocks[to]), "it goes back here, and no way leads out"});
      return;
    }
  }
}

}  // namespace ncport::check
