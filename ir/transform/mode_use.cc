#include "ir/transform/mode_use.h"

#include <cstdint>
#include <vector>

#include "ir/transform/linear_form.h"

namespace ncport::ir::transform {

namespace {

enum class Use : std::uint8_t { kNone, kUses, kSets };

/// Words that mean the same under every motion, plane, distance and diameter mode.
bool IsIndifferent(WordOp op) {
  switch (op) {
    case WordOp::kMotion:
    case WordOp::kPlane:
    case WordOp::kDistance:
    case WordOp::kDiameter:
    case WordOp::kFeedMode:
    case WordOp::kPathMode:
    case WordOp::kWorkOffset:
    case WordOp::kFeed:
    case WordOp::kSpeed:
    case WordOp::kSpeedMode:
    case WordOp::kSpeedLimit:
    case WordOp::kSpindle:
    case WordOp::kTool:
    case WordOp::kToolChange:
    case WordOp::kEdge:
    case WordOp::kAux:
    case WordOp::kMessage:
    case WordOp::kStop:
    case WordOp::kOptionalStop:
    case WordOp::kAssign:
    case WordOp::kDefine:
    case WordOp::kExtern:
    case WordOp::kHeader:
    case WordOp::kJump:
    case WordOp::kIf:
    case WordOp::kElse:
    case WordOp::kEndIf:
    case WordOp::kWhile:
    case WordOp::kEndWhile:
    case WordOp::kLoop:
    case WordOp::kEndLoop:
    case WordOp::kRepeat:
    case WordOp::kUntil:
    case WordOp::kEndFor:
      return true;
    default:
      return false;
  }
}

bool ReadsSystem(const Module& module, ExprId value) {
  bool found = false;
  VisitReads(module, value, [&](ExprId id) { found = found || module.exprs[id].op == ExprOp::kSystem; });
  return found;
}

Use UseOf(const Module& module, const Program& program, BlockId id, WordOp group) {
  const Block& block = module.blocks[id];
  bool sets = false, conditional = block.skip_level != Block::kNoSkip;
  for (const WordId word_id : block.words) {
    const Word& word = module.words[word_id];
    // Modes of a block hold for all of it, wherever they stand.
    sets = sets || (word.op == group && !conditional);
    conditional = conditional || word.op == WordOp::kWhen || word.op == WordOp::kSkipRest;
  }
  if (sets) return Use::kSets;
  for (const WordId word_id : block.words) {
    const Word& word = module.words[word_id];
    const bool ends = word.op == WordOp::kProgramEnd && program.kind == ProgramKind::kMain;
    if (!ends && !IsIndifferent(word.op)) return Use::kUses;
    if (ReadsSystem(module, word.value)) return Use::kUses;
    if (word.op == WordOp::kAssign && ReadsSystem(module, word.Extra<ExprId>())) return Use::kUses;
  }
  return Use::kNone;
}

}  // namespace

bool ModeIsUsedBehind(const Module& module, const analysis::FlowGraphs& graphs, ProgramId program, BlockId block,
                      WordOp group) {
  const analysis::Cfg& cfg = graphs.Of(program);
  if (cfg.Opaque()) return true;
  const bool main = module.programs[program].kind == ProgramKind::kMain;
  const IdRange<BlockId> blocks = cfg.Blocks();
  std::vector<std::uint8_t> seen(blocks.count, 0);
  std::vector<BlockId> work{block};
  while (!work.empty()) {
    const BlockId from = work.back();
    work.pop_back();
    for (const analysis::Edge& edge : cfg.Successors(from)) {
      switch (edge.kind) {
        case analysis::EdgeKind::kEnd:
        case analysis::EdgeKind::kTextEnd:
          if (!main) return true;
          continue;
        case analysis::EdgeKind::kAlarm:
        case analysis::EdgeKind::kMissing:
          continue;
        default:
          break;
      }
      // Returns and computed jumps: what follows them does not stand here.
      if (!edge.to.Valid()) return true;
      std::uint8_t& known = seen[edge.to.value - blocks.begin];
      if (known != 0) continue;
      known = 1;
      const Use use = UseOf(module, module.programs[program], edge.to, group);
      if (use == Use::kUses) return true;
      if (use == Use::kNone) work.push_back(edge.to);
    }
  }
  return false;
}

}  // namespace ncport::ir::transform
