#include "ir/analysis/unwritten_cells.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "ir/analysis/forward_flow.h"
#include "ir/word_values.h"

namespace ncport::ir::analysis {

namespace {

using Key = std::uint64_t;      // space, cell
using Keys = std::vector<Key>;  // ascending

Key KeyOf(std::uint32_t space, std::uint32_t cell) { return static_cast<Key>(space) << 32U | cell; }

bool Contains(const Keys& keys, Key key) { return std::binary_search(keys.begin(), keys.end(), key); }

void Insert(Keys& keys, Key key) {
  const auto place = std::lower_bound(keys.begin(), keys.end(), key);
  if (place == keys.end() || *place != key) keys.insert(place, key);
}

struct Place {
  BlockId block;
  WordId word;
};

using Reads = std::map<Key, Place>;

/// Which cells a program has written since its start, on every way to a block.
struct Writes {
  using State = Keys;

  const Module& module;

  [[nodiscard]] State Entry(ProgramId) const { return {}; }
  [[nodiscard]] State Unknown(ProgramId) const { return {}; }
  bool Join(BlockId, State& into, const State& from) const {
    return std::erase_if(into, [&](Key key) { return !Contains(from, key); }) != 0;
  }
  void Transfer(ProgramId, BlockId block, State& written) const {
    for (const WordId id : module.blocks[block].words) Write(id, written);
  }
  void Write(WordId id, State& written) const {
    const Word& word = module.words[id];
    if (word.op != WordOp::kAssign && word.op != WordOp::kFor) return;
    const ExprId variable =
        word.op == WordOp::kAssign ? word.Extra<ExprId>() : module.fors[word.Extra<ForId>()].variable;
    const Expr& place = module.exprs[variable];
    if (place.op == ExprOp::kCell) Insert(written, KeyOf(place.a, place.b));
  }
  /// What the caller has written is no matter of the callee: it adds its own, wherever it is called.
  [[nodiscard]] std::optional<State> Into(const CallSite&, CallMoment, const State&) const { return std::nullopt; }
  [[nodiscard]] State Back(const CallSite&, const State& at, const State& exit) const {
    State all;
    std::set_union(at.begin(), at.end(), exit.begin(), exit.end(), std::back_inserter(all));
    return all;
  }
};

class Analysis {
 public:
  Analysis(const Module& module, const FlowGraphs& graphs, const CallGraph& calls)
      : module_(module),
        writes_{module},
        flow_({module, machine_, graphs, calls, nullptr}, writes_),
        reads_(module.programs.Size()) {
    flow_.Run();
  }

  /// Finds what a program reads before it wrote it; true if more than was known.
  bool Run(ProgramId program);
  [[nodiscard]] const Reads& Of(ProgramId program) const { return reads_[program.value]; }

 private:
  void Read(ExprId id, BlockId block, WordId word, const Keys& written, Reads& out) const;
  void ReadWord(BlockId block, WordId word, const Keys& written, Reads& out) const;

  const Module& module_;
  // An end word of a called program may return or not: both is the wider answer.
  const Machine machine_{.end_in_called_program_returns = true};
  Writes writes_;
  ForwardFlow<Writes> flow_;
  std::vector<Reads> reads_;  // per program
};

void Analysis::Read(ExprId id, BlockId block, WordId word, const Keys& written, Reads& out) const {
  if (!id.Valid()) return;
  const Expr& expr = module_.exprs[id];
  const auto read = [&](Key key) {
    if (!Contains(written, key)) out.try_emplace(key, Place{block, word});
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
void Analysis::ReadWord(BlockId block, WordId id, const Keys& written, Reads& out) const {
  VisitValues(module_, module_.words[id], [&](ExprId value) { Read(value, block, id, written, out); });
}

bool Analysis::Run(ProgramId program) {
  Reads& known = reads_[program.value];
  const std::size_t before = known.size();
  for (const BlockId id : module_.programs[program].blocks) {
    const Keys* arrival = flow_.Before(id);
    if (arrival == nullptr) continue;
    Keys written = *arrival;
    for (const WordId word_id : module_.blocks[id].words) {
      ReadWord(id, word_id, written, known);
      writes_.Write(word_id, written);
      const Word& word = module_.words[word_id];
      if ((word.op != WordOp::kCall && word.op != WordOp::kModalCall) || !word.Extra<CallId>().Valid()) continue;
      const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
      if (!callee.Valid()) continue;
      // A modal call runs later, when at least as much is written.
      if (callee != program) {
        for (const auto& [key, place] : reads_[callee.value]) {
          if (!Contains(written, key)) known.try_emplace(key, place);
        }
      }
      const Keys* exit = flow_.Exit(callee);
      if (word.op == WordOp::kCall && exit != nullptr) written = writes_.Back({}, written, *exit);
    }
  }
  return known.size() != before;
}

}  // namespace

std::vector<UnwrittenRead> UnwrittenCells(const Module& module, const FlowGraphs& graphs, const CallGraph& calls) {
  Analysis analysis(module, graphs, calls);
  // Callees first. Programs that call each other in a circle settle after a few rounds: reads only grow.
  for (bool changed = true; changed;) {
    changed = false;
    for (const ProgramId program : calls.BottomUp()) changed = analysis.Run(program) || changed;
  }
  std::set<std::uint32_t> called;  // groups of programs, from outside of them
  for (const CallSite& site : calls.AllSites()) {
    if (site.callee.Valid() && calls.GroupOf(site.callee) != calls.GroupOf(site.caller))
      called.insert(calls.GroupOf(site.callee));
  }
  std::map<Key, Place> reads;
  for (const ProgramId program : module.programs.Ids()) {
    if (called.contains(calls.GroupOf(program)) && module.programs[program].kind != ProgramKind::kMain) continue;
    reads.insert(analysis.Of(program).begin(), analysis.Of(program).end());
  }
  std::vector<UnwrittenRead> result;
  for (const auto& [key, place] : reads)
    result.push_back(
        {SpaceId{static_cast<std::uint32_t>(key >> 32U)}, static_cast<std::uint32_t>(key), place.block, place.word});
  return result;
}

}  // namespace ncport::ir::analysis
