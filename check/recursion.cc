#include <vector>

#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ProgramId;
using ir::analysis::EdgeKind;

/// Whether a run of the program can end without a call that leads back into its circle of calls. Calls of other
/// programs are taken to return.
class Escapes {
 public:
  explicit Escapes(const Subject& subject) : subject_(subject) {}

  [[nodiscard]] bool Can(ProgramId program) const {
    const ir::analysis::Cfg& graph = subject_.graphs.Of(program);
    if (graph.Blocks().Empty() || graph.Opaque()) return true;
    std::vector<std::uint8_t> seen(graph.Blocks().count, 0);
    std::vector<BlockId> open{graph.Blocks()[0]};
    seen[0] = 1;
    while (!open.empty()) {
      const BlockId at = open.back();
      open.pop_back();
      const ir::Block& block = subject_.module.blocks[at];
      if ((block.flags & ir::Block::kRefused) != 0) return true;
      // A call behind a condition may not run.
      if (block.skip_level == ir::Block::kNoSkip && !Conditional(block) && CallsBack(program, at)) continue;
      for (const ir::analysis::Edge& edge : graph.Successors(at)) {
        switch (edge.kind) {
          case EdgeKind::kEnd:
          case EdgeKind::kReturn:
          case EdgeKind::kReturnToTarget:
          case EdgeKind::kAlarm:
          case EdgeKind::kTextEnd:
          case EdgeKind::kMissing:
          case EdgeKind::kComputed:
            return true;
          default:
            break;
        }
        std::uint8_t& mark = seen[edge.to.value - graph.Blocks().begin];
        if (mark == 0) open.push_back(edge.to);
        mark = 1;
      }
    }
    return false;
  }

  [[nodiscard]] bool CallsBack(ProgramId program, BlockId block) const {
    for (const ir::analysis::CallSite& site : subject_.calls.SitesOf(program)) {
      if (site.block == block && !site.modal && IsBack(program, site)) return true;
    }
    return false;
  }
  [[nodiscard]] bool IsBack(ProgramId program, const ir::analysis::CallSite& site) const {
    return site.callee.Valid() && subject_.module.calls[site.call].form != ir::CallForm::kBlockRange &&
           !subject_.module.calls[site.call].from_block &&
           subject_.calls.GroupOf(site.callee) == subject_.calls.GroupOf(program);
  }

 private:
  [[nodiscard]] bool Conditional(const ir::Block& block) const {
    for (const ir::WordId id : block.words) {
      const ir::WordOp op = subject_.module.words[id].op;
      if (op == ir::WordOp::kWhen || op == ir::WordOp::kSkipRest) return true;
    }
    return false;
  }

  const Subject& subject_;
};

}  // namespace

void CheckRecursion(const Subject& subject, diag::Sink& sink) {
  const Escapes escapes(subject);
  for (const ProgramId program : subject.module.programs.Ids()) {
    if (subject.module.programs[program].library || !subject.calls.Recursive(program) || escapes.Can(program)) continue;
    for (const ir::analysis::CallSite& site : subject.calls.SitesOf(program)) {
      if (site.modal || !escapes.IsBack(program, site)) continue;
      sink.Report(diag::Code::kRecursiveCall, subject.PlaceOf(site.block, subject.module.words[site.word]),
                  subject.module.View(subject.module.programs[program].name))
          .help = "put the call behind a condition, or leave the program before it";
      break;
    }
  }
}

}  // namespace ncport::check
