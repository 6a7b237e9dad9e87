#include "backends/fanuc/array_bounds.h"

#include <fmt/format.h>

#include <cstdint>
#include <set>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/value_range.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/word_exprs.h"

namespace ncport::backends::fanuc {

namespace {

using ir::ExprId;
using ir::ExprOp;

/// Elements with an index that may lie outside, and those that were looked at.
class Bounds final : public ir::analysis::RangeObserver {
 public:
  void Index(const ir::analysis::RangeSite&, ExprId element, std::uint32_t dimension,
             const ir::analysis::Interval& index, std::uint32_t size, ir::analysis::RangeLookup&) override {
    if (dimension == kListEnd) return;
    seen.insert(element.value);
    if (!(index.low > -0.5 && index.high < size - 0.5)) open.insert(element.value);
  }
  std::set<std::uint32_t> seen, open;
};

}  // namespace

bool RefuseOpenIndices(const RaiseInput& input, const ir::Module& module, diag::Sink& sink) {
  bool arrays = false;
  for (const ir::Variable& variable : module.variables.All()) arrays = arrays || variable.dimension_count > 0;
  if (!arrays) return true;
  const ir::analysis::FlowGraphs graphs(module);
  const ir::analysis::CallGraph calls(module);
  Bounds bounds;
  const ir::analysis::RangeStatistics statistics =
      ir::analysis::FindValueRanges(module, *input.source_machine, graphs, calls, {}, bounds);
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module.words[word_id];
        if (word.op == ir::WordOp::kMessage || word.op == ir::WordOp::kDefine) continue;
        bool open = false;
        ir::transform::VisitWordExprs(module, word, [&](ExprId root, bool) {
          ir::transform::VisitReads(module, root, [&](ExprId node) {
            const ir::Expr& expr = module.exprs[node];
            if (expr.op != ExprOp::kElement) return;
            if (module.variables[ir::VariableId{std::size_t{expr.a}}].dimension_count == 0) return;  // of a text
            bool computed = false;
            for (std::uint32_t i = 0; i < expr.count; ++i)
              computed = computed || module.exprs[module.Item(expr.b + i)].op != ExprOp::kLiteral;
            const bool known = bounds.seen.contains(node.value) || statistics.given_up == 0;
            open = open || (computed && (!known || bounds.open.contains(node.value)));
          });
        });
        if (!open) continue;
        ok = false;
        sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word),
                    "an index that may lie outside its array, which is an alarm in the source", input.profile->name)
            .help = "bound the index before it is used, for example by IF blocks that jump over";
      }
    }
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
