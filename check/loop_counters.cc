// FOR: what its end expression holds and where its counter is read afterwards. Two readings of the manual differ there.
#include <fmt/format.h>

#include <string>
#include <unordered_set>
#include <vector>

#include "check/rules.h"
#include "check/word_expressions.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

/// Variables without an index and cells with a number: places that can be told apart.
bool IsPlace(const Expr& expr) { return expr.op == ExprOp::kVariable || expr.op == ExprOp::kCell; }
bool SamePlace(const Expr& a, const Expr& b) {
  return IsPlace(a) && a.op == b.op && a.a == b.a && (a.op == ExprOp::kVariable || a.b == b.b);
}

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

  [[nodiscard]] std::string NameOf(const Expr& place) const {
    if (place.op == ExprOp::kVariable)
      return std::string(module_.View(module_.variables[ir::VariableId{std::size_t{place.a}}].name));
    return fmt::format("{}{}", module_.View(module_.spaces[ir::SpaceId{std::size_t{place.a}}].name), place.b);
  }

  void Places(ExprId id, std::vector<ExprId>& places) const {
    const Expr& expr = module_.exprs[id];
    if (IsPlace(expr)) places.push_back(id);
    ForOperands(module_, expr, [&](ExprId operand) { Places(operand, places); });
  }

  /// True if the word surely sets the place.
  [[nodiscard]] bool Sets(const ir::Word& word, const Expr& place) const {
    if (word.op == WordOp::kAssign) return SamePlace(module_.exprs[word.Extra<ExprId>()], place);
    if (word.op != WordOp::kFor) return false;
    const ExprId counter = module_.fors[word.Extra<ir::ForId>()].variable;
    return counter.Valid() && SamePlace(module_.exprs[counter], place);
  }

  /// True if the word may do with the place what is not known here.
  [[nodiscard]] bool MayTouch(const ir::Word& word, const Expr& place) const {
    switch (word.op) {
      case WordOp::kVerbatim:
        return true;
      case WordOp::kAssignList:
        return true;
      case WordOp::kAssign:
        return module_.exprs[word.Extra<ExprId>()].op == ExprOp::kCellAt && place.op == ExprOp::kCell;
      case WordOp::kCall:
      case WordOp::kModalCall: {
        if (place.op == ExprOp::kCell) return true;
        const auto scope = module_.variables[ir::VariableId{std::size_t{place.a}}].scope;
        if (scope != ir::Scope::kLocal && scope != ir::Scope::kParameter && scope != ir::Scope::kProgram) return true;
        bool argument = false;
        ForExpressions(module_, word, [&](ExprId id) { argument = argument || SamePlace(module_.exprs[id], place); });
        return argument;
      }
      default:
        return false;
    }
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
      if (Sets(mark, wanted)) continue;  // the counter itself
      for (std::uint32_t i = loop.value + 1; i < last.value; ++i) {
        const ir::Block& block = module_.blocks[BlockId{std::size_t{i}}];
        for (const ir::WordId word : block.words) {
          if (!Sets(module_.words[word], wanted)) continue;
          diag::Diagnostic& finding =
              sink_.Report(diag::Code::kLoopEndChanges, module_.RangeOf(module_.blocks[loop], place), NameOf(wanted));
          finding.notes.push_back({module_.RangeOf(block, module_.words[word]), "it changes here"});
          finding.help = "copy the end into a variable of its own, or write WHILE";
          return;
        }
      }
    }
  }

  /// The place of a read of `place` in the expression, or none.
  [[nodiscard]] ExprId ReadIn(ExprId id, const Expr& place) const {
    const Expr& expr = module_.exprs[id];
    if (SamePlace(expr, place)) return id;
    ExprId found;
    ForOperands(module_, expr, [&](ExprId operand) {
      if (!found.Valid()) found = ReadIn(operand, place);
    });
    return found;
  }
  [[nodiscard]] ExprId ReadIn(const ir::Word& word, const Expr& place) const {
    ExprId found;
    const auto look = [&](ExprId id) {
      if (!found.Valid() && id.Valid()) found = ReadIn(id, place);
    };
    ForExpressions(module_, word, look);
    if (word.op == WordOp::kFor) look(module_.fors[word.Extra<ir::ForId>()].end);
    if (word.op == WordOp::kAssign && !SamePlace(module_.exprs[word.Extra<ExprId>()], place))
      look(word.Extra<ExprId>());
    return found;
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
        if (MayTouch(word, place)) stop = true;
        if (stop) break;
        if (const ExprId read = ReadIn(word, place); read.Valid()) {
          diag::Diagnostic& finding =
              sink_.Report(diag::Code::kCounterBehindLoop, module_.RangeOf(block, read), NameOf(place));
          finding.notes.push_back({module_.RangeOf(module_.blocks[loop], mark), "the loop that counts it"});
          finding.help = "set it again, or keep what is needed in another variable inside the loop";
          return;
        }
        stop = Sets(word, place);
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
