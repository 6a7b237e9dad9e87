#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/near_name.h"
#include "check/rules.h"
#include "check/targets.h"
#include "dialects/finding_alarms.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Search;
using ir::TargetKind;

/// A label of the program that is spelled nearly so, or nothing.
std::string NearTarget(const ir::Module& module, const ir::analysis::LabelTable& labels, const ir::Target& target,
                       BlockId from) {
  std::vector<std::string> names;
  for (const BlockId id : labels.Targets()) {
    const ir::Block& block = module.blocks[id];
    if (id != from && block.label.Valid()) names.emplace_back(module.View(block.label));
  }
  // Another number is no slip, and of a short name every other is near.
  const std::string name = TargetText(module, target);
  if (target.kind != TargetKind::kLabel || name.size() < 3) return {};
  const std::vector<std::string_view> views(names.begin(), names.end());
  return std::string(NearName(name, views));
}

bool CallsUnknown(const Subject& subject, ir::ProgramId program, std::string_view name) {
  const ir::Module& module = subject.module;
  for (const ir::analysis::CallSite& site : subject.calls.SitesOf(program)) {
    if (site.callee.Valid()) continue;
    for (const ir::WordId id : module.blocks[site.block].words) {
      const ir::Word& word = module.words[id];
      if (word.op != ir::WordOp::kCall) continue;
      const auto call = word.Extra<ir::CallId>();
      if (!module.calls.Contains(call) || !module.calls[call].name.Valid() || !module.calls[call].args.Empty())
        continue;
      if (subject.KeyOf(module.View(module.calls[call].name)) == subject.KeyOf(name)) return true;
    }
  }
  return false;
}

}  // namespace

std::string TargetText(const ir::Module& module, const ir::Target& target) {
  if (target.kind == TargetKind::kLabel) return std::string(module.View(target.label));
  return fmt::format("{}{}", target.kind == TargetKind::kMainNumber ? ":" : "N", target.number);
}

void CheckLabels(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const ir::analysis::LabelTable& labels = subject.graphs.LabelsOf(program);
  for (const BlockId block : module.programs[program].blocks) {
    ForEachTarget(module, module.blocks[block], [&](const TargetUse& use) {
      if (use.quiet || !IsWritten(use.target) || labels.Find(use.target, block, use.search).Valid()) return;
      const std::string name = TargetText(module, use.target);
      // A block that was not understood has its finding; the jump to it needs none.
      if (subject.InRefusedBlock(program, name)) return;
      // A block that is only this name is a label without its sign: as a call of no program it has its finding.
      if (CallsUnknown(subject, program, name)) return;
      diag::Diagnostic& finding = sink.Report(diag::Code::kUnknownLabel, subject.PlaceOf(block, use.word), name);
      finding.control = dialects::AlarmFor(subject.profile, finding.code);
      const BlockId elsewhere = labels.Find(use.target, block, Search::kForwardThenFromStart);
      if (elsewhere.Valid()) {
        finding.notes.push_back({module.RangeOf(module.blocks[elsewhere]), "it stands here"});
        finding.help = use.search == Search::kForward ? "this jump looks towards the end of the program only"
                                                      : "this jump looks towards the start of the program only";
      } else if (const std::string near = NearTarget(module, labels, use.target, block); !near.empty()) {
        finding.help = fmt::format("did you mean {}?", near);
      }
    });
  }
}

}  // namespace ncport::check
