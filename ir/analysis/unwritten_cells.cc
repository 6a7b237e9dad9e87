#include "ir/analysis/unwritten_cells.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace ncport::ir::analysis {

namespace {

using Key = std::uint64_t;  // space, cell
using Keys = std::set<Key>;

Key KeyOf(std::uint32_t space, std::uint32_t cell) { return static_cast<Key>(space) << 32U | cell; }

struct Place {
  BlockId block;
  WordId word;
};

/// What a program does to the cells of its caller.
struct Summary {
  std::map<Key, Place> reads;  // before it wrote them
  std::optional<Keys> writes;  // on every way to a return; none: no way is known yet
};

class Analysis {
 public:
  Analysis(const Module& module, const FlowGraphs& graphs) : module_(module), graphs_(graphs) {
    summaries_.resize(module.programs.Size());
  }

  /// True if the summary changed.
  bool Run(ProgramId program);
  [[nodiscard]] const Summary& Of(ProgramId program) const { return summaries_[program.value]; }

 private:
  void Read(ExprId id, BlockId block, WordId word, const Keys& written, Summary& out) const;
  void ReadWord(BlockId block, WordId word, const Keys& written, Summary& out) const;
  Keys Through(BlockId block, Keys written, Summary& out) const;

  const Module& module_;
  const FlowGraphs& graphs_;
  std::vector<Summary> summaries_;
};

void Analysis::Read(ExprId id, BlockId block, WordId word, const Keys& written, Summary& out) const {
  if (!id.Valid()) return;
  const Expr& expr = module_.exprs[id];
  const auto read = [&](Key key) {
    if (!written.contains(key)) out.reads.try_emplace(key, Place{block, word});
  };
  if (expr.op == ExprOp::kCell) return read(KeyOf(expr.a, expr.b));
  if (expr.op == ExprOp::kCellAt) {
    read(KeyOf(expr.b, UnwrittenRead::kComputed));
    return Read(ExprId{expr.a}, block, word, written, out);
  }
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return;
    case Operands::kUnary:
      return Read(ExprId{expr.a}, block, word, written, out);
    case Operands::kBinary:
      Read(ExprId{expr.a}, block, word, written, out);
      return Read(ExprId{expr.b}, block, word, written, out);
    case Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) Read(module_.Item(expr.b + i), block, word, written, out);
      return;
  }
}

/// All values of a word; the place of an assignment only as far as its number is computed.
void Analysis::ReadWord(BlockId block, WordId id, const Keys& written, Summary& out) const {
  const Word& word = module_.words[id];
  const auto read = [&](ExprId expr) { Read(expr, block, id, written, out); };
  read(word.value);
  switch (word.op) {
    case WordOp::kAssign: {
      const Expr& place = module_.exprs[word.Extra<ExprId>()];
      if (place.op == ExprOp::kCellAt) read(ExprId{place.a});
      if (place.op == ExprOp::kElement || place.op == ExprOp::kSystem) read(word.Extra<ExprId>());
      return;
    }
    case WordOp::kAlarm:
    case WordOp::kAxisComputed:
    case WordOp::kMessage:
      return read(word.Extra<ExprId>());
    case WordOp::kDefine:
      return read(module_.variables[word.Extra<VariableId>()].initial);
    case WordOp::kAssignList: {
      const AssignList& list = module_.assign_lists[word.Extra<AssignListId>()];
      read(list.count);
      for (const ExprItemId item : list.values) read(module_.Item(item.value));
      return;
    }
    case WordOp::kJump:
      return read(module_.jumps[word.Extra<JumpId>()].target.expr);
    case WordOp::kSwitch: {
      const Switch& cases = module_.switches[word.Extra<SwitchId>()];
      for (std::uint32_t i = 0; i < cases.arm_count; ++i) {
        const SwitchArm& arm = module_.switch_arms[cases.first_arm + i];
        read(arm.value);
        read(module_.jumps[arm.jump].target.expr);
      }
      return;
    }
    case WordOp::kCall:
    case WordOp::kModalCall:
    case WordOp::kWorkpiece: {
      if (!word.Extra<CallId>().Valid()) return;
      const Call& call = module_.calls[word.Extra<CallId>()];
      read(call.name_expr);
      read(call.passes);
      for (const ArgId arg : call.args) read(module_.args[arg].value);
      return;
    }
    case WordOp::kFor: {
      const For& loop = module_.fors[word.Extra<ForId>()];
      read(loop.end);
      return read(loop.step);
    }
    default:
      return;
  }
}

Keys Analysis::Through(BlockId id, Keys written, Summary& out) const {
  const Block& block = module_.blocks[id];
  const Keys before = written;
  bool conditional = block.skip_level != Block::kNoSkip;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    ReadWord(id, word_id, written, out);
    switch (word.op) {
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        conditional = true;
        break;
      case WordOp::kAssign: {
        const Expr& place = module_.exprs[word.Extra<ExprId>()];
        if (place.op == ExprOp::kCell) written.insert(KeyOf(place.a, place.b));
        break;
      }
      case WordOp::kFor: {
        const Expr& place = module_.exprs[module_.fors[word.Extra<ForId>()].variable];
        if (place.op == ExprOp::kCell) written.insert(KeyOf(place.a, place.b));
        break;
      }
      case WordOp::kCall:
      case WordOp::kModalCall: {
        if (!word.Extra<CallId>().Valid()) break;
        const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
        if (!callee.Valid()) break;
        const Summary& below = summaries_[callee.value];
        for (const auto& [key, place] : below.reads) {
          if (!written.contains(key)) out.reads.try_emplace(key, place);
        }
        // A modal call may never run.
        if (word.op == WordOp::kCall && below.writes) written.insert(below.writes->begin(), below.writes->end());
        break;
      }
      default:
        break;
    }
  }
  return conditional ? before : written;
}

bool Analysis::Run(ProgramId program) {
  const Cfg& graph = graphs_.Of(program);
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  Summary now;
  if (blocks.Empty()) now.writes.emplace();
  std::vector<std::optional<Keys>> in(blocks.count);
  if (!blocks.Empty()) in[0].emplace();
  std::set<std::uint32_t> work;
  if (!blocks.Empty()) work.insert(0);
  const auto meet = [](std::optional<Keys>& at, const Keys& from) {
    if (!at) {
      at = from;
      return true;
    }
    const std::size_t size = at->size();
    std::erase_if(*at, [&](Key key) { return !from.contains(key); });
    return at->size() != size;
  };
  while (!work.empty()) {
    const std::uint32_t index = *work.begin();
    work.erase(work.begin());
    Summary unused;
    const Keys after = Through(blocks[index], *in[index], unused);
    const auto go = [&](BlockId to) {
      const std::uint32_t next = to.value - blocks.begin;
      if (meet(in[next], after)) work.insert(next);
    };
    for (const Edge& edge : graph.Successors(blocks[index])) {
      if (edge.to.Valid()) {
        go(edge.to);
      } else if (edge.kind == EdgeKind::kComputed) {
        for (const BlockId target : graph.ComputedTargets()) go(target);
      } else if (edge.kind != EdgeKind::kAlarm && edge.kind != EdgeKind::kMissing) {
        meet(now.writes, after);
      }
    }
  }
  // Reads are collected once the sets stand.
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    if (in[i]) Through(blocks[i], *in[i], now);
  }
  Summary& known = summaries_[program.value];
  const auto same_reads = [&] {
    return known.reads.size() == now.reads.size() &&
           std::equal(known.reads.begin(), known.reads.end(), now.reads.begin(),
                      [](const auto& a, const auto& b) { return a.first == b.first; });
  };
  if (same_reads() && known.writes == now.writes) return false;
  known = std::move(now);
  return true;
}

}  // namespace

std::vector<UnwrittenRead> UnwrittenCells(const Module& module, const FlowGraphs& graphs, const CallGraph& calls) {
  Analysis analysis(module, graphs);
  // Callees first. Programs that call each other in a circle settle after a few rounds: reads only grow, and once all
  // of them are known writes only shrink.
  for (bool changed = true; changed;) {
    changed = false;
    for (const ProgramId program : calls.BottomUp()) changed = analysis.Run(program) || changed;
  }
  std::set<std::uint32_t> called;
  for (const CallSite& site : calls.AllSites()) {
    if (site.callee.Valid()) called.insert(site.callee.value);
  }
  std::map<Key, Place> reads;
  for (const ProgramId program : module.programs.Ids()) {
    if (called.contains(program.value) && module.programs[program].kind != ProgramKind::kMain) continue;
    reads.insert(analysis.Of(program).reads.begin(), analysis.Of(program).reads.end());
  }
  std::vector<UnwrittenRead> result;
  for (const auto& [key, place] : reads)
    result.push_back(
        {SpaceId{static_cast<std::uint32_t>(key >> 32U)}, static_cast<std::uint32_t>(key), place.block, place.word});
  return result;
}

}  // namespace ncport::ir::analysis
