#include <algorithm>
#include <set>
#include <string>

#include "check/rules.h"
#include "check/targets.h"

namespace ncport::check {
namespace {

/// Labels that this set of programs names: jumps, repeated parts, ranges of blocks of calls. Null targets do not count.
class NamedLabels {
 public:
  NamedLabels(const Subject& subject, ir::ProgramId program) : subject_(subject) {
    const ir::Module& module = subject.module;
    for (const ir::BlockId block : module.programs[program].blocks) {
      ForEachTarget(module, module.blocks[block], [&](const TargetUse& use) { Add(use.target); });
      for (const ir::WordId id : module.blocks[block].words) {
        const ir::Word& word = module.words[id];
        // The end label of a repeated part needs no name in the block that repeats.
        if (word.op == ir::WordOp::kRepeatPart) Add(module.parts[word.Extra<ir::PartId>()].last);
      }
    }
    // A range of blocks may lie in another program.
    for (const ir::Call& call : module.calls.All()) {
      Add(call.from);
      Add(call.to);
    }
  }

  [[nodiscard]] bool Computed() const { return computed_; }
  [[nodiscard]] bool Has(std::string_view label) const { return names_.contains(subject_.KeyOf(label)); }

 private:
  void Add(const ir::Target& target) {
    if (target.kind == ir::TargetKind::kExpression && target.expr.Valid()) computed_ = true;
    if (target.kind == ir::TargetKind::kLabel && target.label.Valid())
      names_.insert(subject_.KeyOf(subject_.module.View(target.label)));
  }

  const Subject& subject_;
  std::set<std::string> names_;
  bool computed_ = false;
};

}  // namespace

void CheckUnusedLabels(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const NamedLabels named(subject, program);
  if (named.Computed()) return;
  // A program that returns to a label of its caller names it where this one does not see it.
  for (const ir::ProgramId other : module.programs.Ids()) {
    if (subject.graphs.ReturnsToTarget(other)) return;
  }
  // A jump that finds nothing, or a block that was not understood, may be meant for one of them.
  bool missing = false;
  for (const ir::BlockId block : module.programs[program].blocks) {
    missing = missing || (module.blocks[block].flags & ir::Block::kRefused) != 0;
    ForEachTarget(module, module.blocks[block], [&](const TargetUse& use) {
      missing = missing || (IsWritten(use.target) &&
                            !subject.graphs.LabelsOf(program).Find(use.target, block, use.search).Valid());
    });
  }
  if (missing) return;
  for (const ir::analysis::CallSite& site : subject.calls.SitesOf(program)) {
    if (!site.callee.Valid()) return;
  }
  for (const ir::BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    if (!block.label.Valid()) continue;
    const std::string_view label = module.View(block.label);
    if (named.Has(label) || subject.InRefusedBlock(program, label)) continue;
    sink.Report(diag::Code::kUnusedName, subject.PlaceOfLabel(id), "label", label).help = "no jump goes there";
  }
}

}  // namespace ncport::check
