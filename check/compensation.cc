// Where cutter compensation begins, ends and is forgotten.
#include <algorithm>
#include <cstdint>
#include <set>

#include "check/comp_flow.h"
#include "check/comp_tool.h"
#include "check/motion_words.h"
#include "check/rules.h"
#include "dialects/finding_alarms.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::CutterComp;
using ir::ProgramId;
using ir::WordOp;

bool IsOn(CutterComp comp) { return comp == CutterComp::kLeft || comp == CutterComp::kRight; }

/// The way from the programmed path to the compensated one and back is a straight move of the plane.
class ArcRule {
 public:
  ArcRule(const Subject& subject, const CompFlow& flow, diag::Sink& sink)
      : subject_(subject), flow_(flow), sink_(sink) {}

  void Check(ProgramId program, BlockId id, const CompState& before) {
    const ir::Block& block = subject_.module.blocks[id];
    const ir::Word* arc = ArcWord(subject_.module, block, subject_.modal.At(program, id).motion);
    if (arc == nullptr) return;
    const ir::Word* comp = flow_.Switch(id);
    if (comp != nullptr && EndsCompensation(*comp)) {
      if (before.ways == CompState::kBegun)
        Report(id, *comp, "off").help = "switch it off with a straight move in the plane, behind the arc";
      return;
    }
    const CompState at = flow_.At(id, before);
    if (at.ways != CompState::kSwitchedOn || !told_.insert(at.switched.value).second) return;
    diag::Diagnostic& finding = Report(id, at.switched == id ? *comp : *arc, "on");
    if (at.switched != id)
      finding.notes.push_back({subject_.PlaceOf(at.switched, *flow_.Switch(at.switched)),
                               "it is switched on here, and this arc is the first move"});
    finding.help = "switch it on with a straight move in the plane, in front of the arc";
  }

 private:
  diag::Diagnostic& Report(BlockId id, const ir::Word& word, const char* how) {
    diag::Diagnostic& finding = sink_.Report(diag::Code::kCompensationInArc, subject_.PlaceOf(id, word), how);
    finding.control = dialects::AlarmFor(subject_.profile, finding.code);
    return finding;
  }

  const Subject& subject_;
  const CompFlow& flow_;
  diag::Sink& sink_;
  std::set<std::uint32_t> told_;  // blocks that switch it on
};

/// Compensation that is forgotten: the next block would move by it with another tool or in another plane.
class StillOnRule {
 public:
  StillOnRule(const Subject& subject, const CompFlow& flow, diag::Sink& sink)
      : subject_(subject), module_(subject.module), flow_(flow), sink_(sink) {}

  void Check(ProgramId program, BlockId id, const CompState& before) {
    if (before.ways != CompState::kBegun || flow_.At(id, before).ways != CompState::kBegun) return;
    for (const ir::WordId word_id : module_.blocks[id].words) {
      const ir::Word& word = module_.words[word_id];
      const char* where = Where(program, id, word);
      if (where == nullptr) continue;
      if (before.switched.Valid() && !told_.insert(before.switched.value).second) return;
      diag::Diagnostic& finding =
          word.op == WordOp::kPlane ? sink_.ReportAs(diag::Severity::kError, diag::Code::kCompensationStillOn,
                                                     subject_.PlaceOf(id, word), where)
                                    : sink_.Report(diag::Code::kCompensationStillOn, subject_.PlaceOf(id, word), where);
      if (before.switched.Valid())
        finding.notes.push_back(
            {subject_.PlaceOf(before.switched, *flow_.Switch(before.switched)), "it is switched on here"});
      finding.help = "switch it off in front of it, on the way from the contour";
      return;
    }
  }

 private:
  [[nodiscard]] const char* Where(ProgramId program, BlockId id, const ir::Word& word) const {
    switch (word.op) {
      case WordOp::kToolChange:
        return "where the tool changes";
      case WordOp::kTool: {
        const bool changes = subject_.machine.tool_word_changes && (word.flags & ir::Word::kKeepsTool) == 0;
        return changes ? "where the tool changes" : nullptr;
      }
      case WordOp::kProgramEnd:
        return subject_.IsMain(program) ? "at the end of the program" : nullptr;
      case WordOp::kPlane: {
        const ir::Plane plane = subject_.modal.Before(program, id).plane;
        const bool known = plane != ir::Plane::kUnknown;
        return known && plane != static_cast<ir::Plane>(word.index) ? "where the plane changes" : nullptr;
      }
      default:
        return nullptr;
    }
  }

  const Subject& subject_;
  const ir::Module& module_;
  const CompFlow& flow_;
  diag::Sink& sink_;
  std::set<std::uint32_t> told_;  // blocks that switch it on
};

}  // namespace

void CheckCompensation(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const bool any = std::ranges::any_of(module.words.All(), [](const ir::Word& word) {
    return word.op == WordOp::kCutterComp && IsOn(static_cast<CutterComp>(word.index));
  });
  if (!any) return;
  const CompFlow flow(subject);
  ArcRule arcs(subject, flow, sink);
  StillOnRule still_on(subject, flow, sink);
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    for (const BlockId id : module.programs[program].blocks) {
      const CompState* before = flow.Before(id);
      if (before == nullptr || (module.blocks[id].flags & ir::Block::kRefused) != 0) continue;
      arcs.Check(program, id, *before);
      still_on.Check(program, id, *before);
    }
  }
  CheckCompTool(subject, flow, sink);
}

}  // namespace ncport::check
