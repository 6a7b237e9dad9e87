// FOR: what its end expression holds and where its counter is read afterwards. Two readings of the manual differ there.
#include <string>
#include <unordered_set>
#include <vector>

#include "check/places.h"
#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::WordOp;

class LoopCounters {
 public:
  LoopCounters(const Subject& subject, ir::ProgramId program, diag::Sink& sink)
      : module_(subject.module), graph_(subject.graphs.Of(program)), program_(program), sink_(sink) {}

  void Run() {
    if (graph_.Opaque()) return;
    for (const BlockId id : module_.programs[program_].blocks) {
      const ir::Block& block = module_.blocks[id];
      if (!block.link.Valid() || (block.flags & ir::Block::kRefused) != 0 || block.link < id) continue;
      for (const ir::WordId word : block.words) {
        if (module_.words[word].op != WordOp::kFor) continue;
        EndChanges(id, module_.words[word]);
        CounterBehind(id, module_.words[word]);
      }
    }
  }

 private:
  static constexpr std::uint64_t kMostLooked = 5'000'000;  // blocks, all loops of the program together

  void Places(ExprId id, std::vector<ExprId>& places) const {
    const Expr& expr = module_.exprs[id];
    if (IsPlace(expr)) places.push_back(id);
    ForOperands(module_, expr, [&](ExprId operand) { Places(operand, places); });
  }

  void EndChanges(BlockId loop, const ir::Word& mark) {
    const ExprId end = module_.fors[mark.Extra<ir::ForId>()].end;
    if (!end.Valid()) return;
    std::vector<ExprId> places;
    Places(end, places);
    if (places.empty()) return;
    const BlockId last = module_.blocks[loop].link;
    looked_ += last.value - loop.value;
    if (looked_ > kMostLooked) return;
    for (const ExprId place : places) {
      const Expr& wanted = module_.exprs[place];
      if (SetsPlace(module_, mark, wanted)) continue;  // the counter itself
      for (std::uint32_t i = loop.value + 1; i < last.value; ++i) {
        const ir::Block& block = module_.blocks[BlockId{std::size_t{i}}];
        for (const ir::WordId word : block.words) {
          if (!SetsPlace(module_, module_.words[word], wanted)) continue;
          diag::Diagnostic& finding = sink_.Report(
              diag::Code::kLoopEndChanges, module_.RangeOf(module_.blocks[loop], place), NameOfPlace(module_, wanted));
          finding.notes.push_back({module_.RangeOf(block, module_.words[word]), "it changes here"});
          finding.help = "copy the end into a variable of its own, or write WHILE";
          return;
        }
      }
    }
  }

  void CounterBehind(BlockId loop, const ir::Word& mark) {
    const ExprId counter = module_.fors[mark.Extra<ir::ForId>()].variable;
    if (!counter.Valid() || !IsPlace(module_.exprs[counter])) return;
    const Expr& place = module_.exprs[counter];
    std::unordered_set<std::uint32_t> seen;
    std::vector<BlockId> open;
    const auto go = [&](BlockId to) {
      if (to.Valid() && seen.insert(to.value).second) open.push_back(to);
    };
    for (const ir::analysis::Edge& edge : graph_.Successors(loop)) {
      if (edge.kind == ir::analysis::EdgeKind::kFalse) go(edge.to);
    }
    while (!open.empty() && ++looked_ < kMostLooked) {
      const BlockId id = open.back();
      open.pop_back();
      const ir::Block& block = module_.blocks[id];
      if (id == loop || (block.flags & ir::Block::kRefused) != 0) continue;
      bool stop = false;
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module_.words[word_id];
        if (MayTouchPlace(module_, word, place)) stop = true;
        if (stop) break;
        if (const ExprId read = ReadOfPlace(module_, word, place); read.Valid()) {
          diag::Diagnostic& finding =
              sink_.Report(diag::Code::kCounterBehindLoop, module_.RangeOf(block, read), NameOfPlace(module_, place));
          finding.notes.push_back({module_.RangeOf(module_.blocks[loop], mark), "the loop that counts it"});
          finding.help = "set it again, or keep what is needed in another variable inside the loop";
          return;
        }
        stop = SetsPlace(module_, word, place);
        if (stop) break;
      }
      if (stop) continue;
      for (const ir::analysis::Edge& edge : graph_.Successors(id)) go(edge.to);
    }
  }

  const ir::Module& module_;
  const ir::analysis::Cfg& graph_;
  ir::ProgramId program_;
  diag::Sink& sink_;
  std::uint64_t looked_ = 0;
};

}  // namespace

void CheckLoopCounters(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  LoopCounters{subject, program, sink}.Run();
}

}  // namespace ncport::check
