#include <fmt/format.h>

#include "check/expressions.h"
#include "check/motion_words.h"
#include "check/rules.h"
#include "dialects/finding_alarms.h"
#include "ir/block_words.h"
#include "ir/motions.h"
#include "ir/plane_axes.h"

namespace ncport::check {
namespace {

using ir::WordOp;

constexpr std::string_view kAxisLetters = "XYZ";
constexpr std::string_view kCenterLetters = "IJK";

bool IsThread(ir::Motion motion) { return motion >= ir::Motion::kThread && motion <= ir::Motion::kTapOut; }

/// The lead of a thread stands under I, J or K, where it is not F.
void CheckLead(const Subject& subject, ir::BlockId id, const ir::Word& moving, diag::Sink& sink) {
  if (subject.machine.thread_lead_from_feed) return;
  const ir::Word* lead = nullptr;
  for (const ir::WordId word_id : subject.module.blocks[id].words) {
    const ir::Word& word = subject.module.words[word_id];
    if (word.op == WordOp::kCenter) lead = &word;
  }
  if (lead != nullptr && LiteralValue(subject.module, lead->value) != 0.0) return;
  // Without the word the run takes 0; a control may know the lead of the block before.
  const diag::Severity severity = lead != nullptr ? diag::Severity::kError : diag::Severity::kWarning;
  sink.ReportAs(severity, diag::Code::kOutOfRange, subject.PlaceOf(id, lead != nullptr ? *lead : moving), "0",
                "the leads of a thread, none of them 0")
      .help = "I, J or K is the lead, under the letter of the axis with the longer way";
}

/// What describes the path in one block.
struct PathWords {
  const ir::Word* axis_in_plane = nullptr;
  const ir::Word* center_outside = nullptr;  // along the axis that stands on the plane
  const ir::Word* radius = nullptr;
  const ir::Word* polar = nullptr;
  bool describes_arc = false;  // a centre, radius, angle or point that says which arc
  bool via = false;            // a coordinate of the point that the arc goes through
  bool other = false;          // a word that this does not judge
};

PathWords WordsOf(const ir::Module& module, const ir::Block& block, std::uint8_t normal) {
  PathWords words;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module.words[id];
    switch (word.op) {
      case WordOp::kAxis:
        if (word.index < 3 && word.index != normal && words.axis_in_plane == nullptr) words.axis_in_plane = &word;
        break;
      case WordOp::kCenter:
        if (word.index == normal && words.center_outside == nullptr) words.center_outside = &word;
        words.describes_arc = true;
        break;
      case WordOp::kRadius:
        words.radius = &word;
        words.describes_arc = true;
        break;
      case WordOp::kPolarAngle:
      case WordOp::kPolarRadius:
        words.polar = &word;
        words.describes_arc = true;
        break;
      case WordOp::kOpeningAngle:
        words.describes_arc = true;
        break;
      case WordOp::kVia:
        words.via = true;
        words.describes_arc = true;
        break;
      case WordOp::kAxisComputed:
      case WordOp::kContourAngle:
      case WordOp::kVerbatim:
      case WordOp::kComputedG:
        words.other = true;
        break;
      default:
        break;
    }
  }
  return words;
}

}  // namespace

void CheckArcWords(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  constexpr std::string_view kPlanes[] = {"YZ: J and K", "ZX: K and I", "XY: I and J"};  // by normal
  const ir::Module& module = subject.module;
  for (const ir::BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    if (block.words.Empty() || (block.flags & ir::Block::kRefused) != 0) continue;
    const ir::Word* moving = MovingWord(module, block);
    if (moving == nullptr) continue;
    const ir::ModalState modes = subject.modal.At(program, id);
    if (modes.plane == ir::Plane::kUnknown) continue;
    // Without a motion word the block may be a place of a cycle, which knows no arcs, and whose R is a level or a taper
    // (fanuc-8.7, 8.8).
    if (subject.has_cycles && !ir::HasWord(module, block, WordOp::kMotion)) continue;
    const std::uint8_t normal = ir::AxesOf(modes.plane).normal;
    const PathWords words = WordsOf(module, block, normal);
    if (words.other) continue;
    if (words.polar != nullptr && words.axis_in_plane != nullptr) {
      sink.Report(diag::Code::kWordConflict, subject.PlaceOf(id, *words.axis_in_plane), "the polar words",
                  kAxisLetters.substr(words.axis_in_plane->index, 1))
          .help = "radius and angle alone describe the point in the plane; only the third axis may stand beside them";
      continue;
    }
    if (IsThread(modes.motion)) {
      CheckLead(subject, id, *moving, sink);
    } else if (modes.motion == ir::Motion::kArcVia) {
      if (words.via) continue;
      sink.Report(diag::Code::kArcIncomplete, subject.PlaceOf(id, *moving)).help =
          "write the point that the arc goes through: without one it is the start point";
    } else if (!ir::IsPlaneArc(modes.motion)) {
      const bool straight = modes.motion == ir::Motion::kLinear || modes.motion == ir::Motion::kRapid;
      if (!straight || words.radius == nullptr) continue;
      sink.ReportAs(diag::Severity::kWarning, diag::Code::kUnexpectedText, subject.PlaceOf(id, *words.radius),
                    "radius of an arc")
          .help = "the block moves on a straight line: is the arc word missing?";
    } else if (words.center_outside != nullptr) {
      sink.Report(diag::Code::kUnexpectedText, subject.PlaceOf(id, *words.center_outside),
                  kCenterLetters.substr(words.center_outside->index, 1))
          .help = fmt::format("the centre of an arc lies in the active plane, {}", kPlanes[normal]);
    } else if (!words.describes_arc) {
      diag::Diagnostic& finding = sink.Report(diag::Code::kArcIncomplete, subject.PlaceOf(id, *moving));
      finding.help = "write the centre or the radius; a straight line needs its own motion word";
      finding.control = dialects::AlarmFor(subject.profile, finding.code);
    }
  }
}

}  // namespace ncport::check
