#include "check/rules.h"
#include "check/targets.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Search;

/// The next block behind `from` that carries the target, in the same direction of the search; none: it is the only one.
BlockId Another(const ir::analysis::LabelTable& labels, const ir::Target& target, BlockId from, BlockId found) {
  const BlockId other = labels.Find(target, found, Search::kForwardThenFromStart);
  if (!other.Valid() || other == found) return {};
  // Forward from the jump only what lies ahead was meant, and backward only what lies behind.
  if ((other > from) != (found > from)) return {};
  return other;
}

}  // namespace

// Labels may stand twice: tails of programs are copied, and the search takes the nearest. It matters where two of them
// lie on the same side of a jump.
void CheckDoubleLabels(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const ir::analysis::LabelTable& labels = subject.graphs.LabelsOf(program);
  for (const BlockId block : module.programs[program].blocks) {
    ForEachTarget(module, module.blocks[block], [&](const TargetUse& use) {
      if (!IsWritten(use.target)) return;
      const BlockId found = labels.Find(use.target, block, use.search);
      if (!found.Valid()) return;
      const BlockId other = Another(labels, use.target, block, found);
      if (!other.Valid()) return;
      diag::Diagnostic& finding =
          sink.Report(diag::Code::kDoubleLabel, subject.PlaceOf(block, use.word), TargetText(module, use.target));
      finding.notes.push_back({module.RangeOf(module.blocks[found]), "the jump goes here"});
      finding.notes.push_back({module.RangeOf(module.blocks[other]), "and it stands here too"});
      finding.help = "give one of them another name";
    });
  }
}

}  // namespace ncport::check
