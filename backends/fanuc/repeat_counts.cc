#include "backends/fanuc/repeat_counts.h"

#include <set>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"

namespace ncport::backends::fanuc {

namespace {

using ir::BlockId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;

/// The word of a repeated part whose count is not written as a number, or none.
const Word* ComputedRepeat(const Module& module, const ir::Block& block) {
  for (const WordId id : block.words) {
    const Word& word = module.words[id];
    if (word.op == WordOp::kRepeatPart && word.value.Valid() && module.exprs[word.value].op != ExprOp::kLiteral)
      return &word;
  }
  return nullptr;
}

/// Blocks that were reached, and those of them whose count may lie outside.
class Counts final : public ir::analysis::RangeObserver {
 public:
  Counts(const Module& module, double most) : module_(module), most_(most) {}

  void Block(const ir::analysis::RangeSite& site, ir::analysis::RangeLookup& values) override {
    const ir::Block& block = module_.blocks[site.block];
    const Word* word = ComputedRepeat(module_, block);
    if (word == nullptr) return;
    seen.insert(site.block.value);
    const ir::analysis::Interval count = values.Evaluate(word->value);
    // Values are those in front of the block: another word of it may change them.
    const bool alone = block.words.count == 1;
    if (!alone || !(count.low > -0.5 && count.high < most_ + 0.5)) open.insert(site.block.value);
  }
  std::set<std::uint32_t> seen, open;

 private:
  const Module& module_;
  double most_;
};

}  // namespace

bool RefuseOpenRepeats(const RaiseInput& input, const Module& module,
                       const std::vector<ir::analysis::DeclaredRange>& declared, diag::Sink& sink) {
  bool any = false;
  for (const ir::Block& block : module.blocks.All()) any = any || ComputedRepeat(module, block) != nullptr;
  if (!any) return true;
  const ir::analysis::FlowGraphs graphs(module);
  const ir::analysis::CallGraph calls(module);
  Counts counts(module, input.source_machine->passes_max);
  ir::analysis::RangeOptions options;
  options.declared = declared;
  const ir::analysis::RangeStatistics statistics =
      ir::analysis::FindValueRanges(module, *input.source_machine, graphs, calls, options, counts);
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const Word* word = ComputedRepeat(module, block);
      if (word == nullptr) continue;
      const bool known = counts.seen.contains(id.value) || statistics.given_up == 0;
      if (known && !counts.open.contains(id.value)) continue;
      ok = false;
      sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, *word),
                  "a number of repetitions that may be negative or very large, which is an alarm in the source",
                  input.profile->name)
          .help = "bound the number before it is used, for example by IF blocks that jump over";
    }
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
