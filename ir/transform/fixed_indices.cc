#include "ir/transform/fixed_indices.h"

#include <map>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/value_range.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

/// Words that write before other values of their block are taken, or between two of their own.
bool Writes(WordOp op) { return op == WordOp::kAssign || op == WordOp::kDefine; }
bool WritesBetween(WordOp op) { return op == WordOp::kAssignList || op == WordOp::kFor; }

/// What the index of each indexed cell can be, over all ways to it.
class Indices final : public analysis::RangeObserver {
 public:
  explicit Indices(const Module& module) : module_(module) {}

  void Block(const analysis::RangeSite& site, analysis::RangeLookup& lookup) override {
    const ir::Block& block = module_.blocks[site.block];
    // Values are those on arrival at the block.
    bool open = false;
    for (const WordId id : block.words) {
      const WordOp op = module_.words[id].op;
      open = open || WritesBetween(op) || (Writes(op) && block.words.count != 1);
    }
    for (const WordId id : block.words) {
      VisitWordExprs(module_, module_.words[id], [&](ExprId root, bool) {
        VisitReads(module_, root, [&](ExprId node) {
          const Expr& expr = module_.exprs[node];
          if (expr.op != ExprOp::kCellAt) return;
          const analysis::Interval value =
              open ? analysis::Interval::Unknown() : analysis::Rounded(lookup.Evaluate(ExprId{std::size_t{expr.a}}));
          const auto [known, first] = found.emplace(node.value, value);
          if (!first) known->second = analysis::Join(known->second, value);
        });
      });
    }
  }
  std::map<std::uint32_t, analysis::Interval> found;

 private:
  const Module& module_;
};

}  // namespace

void FixIndices(Module& module, const Machine& source) {
  bool any = false;
  for (const Expr& expr : module.exprs.All()) any = any || expr.op == ExprOp::kCellAt;
  if (!any) return;
  const analysis::FlowGraphs graphs(module);
  const analysis::CallGraph calls(module);
  Indices indices(module);
  if (analysis::FindValueRanges(module, source, graphs, calls, {}, indices).given_up != 0) return;
  for (const auto& [node, index] : indices.found) {
    if (!index.IsPoint()) continue;
    Expr& expr = module.exprs[ExprId{std::size_t{node}}];
    const Space& space = module.spaces[SpaceId{std::size_t{expr.b}}];
    if (index.low < space.first || index.low > space.last) continue;
    const std::uint32_t cells = expr.b;
    expr.op = ExprOp::kCell;
    expr.a = cells;
    expr.b = static_cast<std::uint32_t>(index.low);
  }
}

}  // namespace ncport::ir::transform
