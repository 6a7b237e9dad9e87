#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "check/expressions.h"
#include "check/rules.h"
#include "dialects/finding_alarms.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::WordOp;

constexpr double kInch = 25.4;
constexpr std::size_t kAxes = 3;  // X Y Z
constexpr double kSamePoint = 1e-6;

/// Words that leave the position of the axes as the program wrote it, and the coordinate system.
bool KeepsCoordinates(WordOp op) {
  switch (op) {
    case WordOp::kMotion:
    case WordOp::kPlane:
    case WordOp::kDistance:
    case WordOp::kFeedMode:
    case WordOp::kSpeedMode:
    case WordOp::kCutterComp:
    case WordOp::kPathMode:
    case WordOp::kExactOnce:
    case WordOp::kInert:
    case WordOp::kAxis:
    case WordOp::kCenter:
    case WordOp::kRadius:
    case WordOp::kFeed:
    case WordOp::kFeedOnce:
    case WordOp::kSpeed:
    case WordOp::kSpeedLimit:
    case WordOp::kSpindle:
    case WordOp::kAux:
    case WordOp::kAuxH:
    case WordOp::kStop:
    case WordOp::kOptionalStop:
    case WordOp::kMessage:
    case WordOp::kAssign:
    case WordOp::kFileMark:
    case WordOp::kDefine:
    case WordOp::kExtern:
    case WordOp::kHeader:
      return true;
    default:
      return false;
  }
}

/// Words that move the coordinate system, or what numbers count, before the axis words of their block act.
bool RenewsCoordinates(WordOp op) {
  switch (op) {
    case WordOp::kWorkOffset:
    case WordOp::kUnits:
    case WordOp::kDiameter:
    case WordOp::kTool:
    case WordOp::kToolChange:
    case WordOp::kToolOffset:
    case WordOp::kEdge:
    case WordOp::kLengthOffset:
    case WordOp::kRadiusOffset:
      return true;
    default:
      return false;
  }
}

/// Follows the positions that stand in the text through blocks that run one after the other.
class ArcCheck {
 public:
  ArcCheck(const Subject& subject, ir::ProgramId program, diag::Sink& sink)
      : subject_(subject), module_(subject.module), program_(program), sink_(sink) {}

  void Run() {
    const ir::analysis::Cfg& graph = subject_.graphs.Of(program_);
    bool computed = graph.Opaque();
    for (const BlockId id : graph.Blocks()) {
      for (const ir::analysis::Edge& edge : graph.Successors(id))
        computed = computed || edge.kind == ir::analysis::EdgeKind::kComputed;
    }
    BlockId before;
    for (const BlockId id : graph.Blocks()) {
      const auto ways = graph.Predecessors(id);
      const ir::Block& block = module_.blocks[id];
      const bool target = block.label.Valid() || block.number != ir::Block::kNoNumber;
      if (ways.size() != 1 || ways[0] != before || (computed && target)) Forget();
      Block(id);
      before = id;
    }
  }

 private:
  using Values = std::array<std::optional<double>, kAxes>;

  void Forget() { at_ = {}; }

  void Block(BlockId id) {
    const ir::Block& block = module_.blocks[id];
    if (block.words.Empty()) return;
    const ir::ModalState modes = subject_.modal.At(program_, id);
    const ir::ModalState before = subject_.modal.Before(program_, id);
    bool keeps = block.skip_level == ir::Block::kNoSkip;
    bool renews = modes.diameter != before.diameter;
    for (const ir::WordId word : block.words) {
      renews = renews || RenewsCoordinates(module_.words[word].op);
      keeps = keeps && (KeepsCoordinates(module_.words[word].op) || RenewsCoordinates(module_.words[word].op));
    }
    if (!keeps || renews) Forget();
    if (!keeps) return;
    const Values start = at_;
    Move(block, modes);
    const bool arc = modes.motion == ir::Motion::kArcCw || modes.motion == ir::Motion::kArcCcw;
    if (arc) Arc(id, start, modes);
  }

  void Move(const ir::Block& block, const ir::ModalState& modes) {
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      if (word.op != WordOp::kAxis || word.index >= kAxes) continue;
      std::optional<double>& at = at_[word.index];
      const std::optional<double> value = LiteralValue(module_, word.value);
      const bool modal = word.mode == ir::ValueMode::kModal;
      const bool absolute =
          word.mode == ir::ValueMode::kAbsolute || (modal && modes.distance == ir::Distance::kAbsolute);
      const bool incremental =
          word.mode == ir::ValueMode::kIncremental || (modal && modes.distance == ir::Distance::kIncremental);
      const std::optional<double> factor = FactorOf(word.index, absolute, modes);
      if (!value || !factor || (word.flags & ir::Word::kIncrements) != 0 || (!absolute && !incremental)) {
        at.reset();
      } else if (absolute) {
        at = *value * *factor;
      } else if (at) {
        at = *at + *value * *factor;
      }
    }
  }

  /// What a number of the axis counts in lengths; nothing where the mode is not known.
  [[nodiscard]] std::optional<double> FactorOf(std::uint8_t axis, bool absolute, const ir::ModalState& modes) const {
    if (axis != subject_.machine.transverse_axis) return 1;
    switch (modes.diameter) {
      case ir::Diameter::kRadius:
        return 1;
      case ir::Diameter::kDiameter:
        return 0.5;
      case ir::Diameter::kDiameterAbsolute:
        return absolute ? 0.5 : 1;
      default:
        return std::nullopt;
    }
  }

  void Arc(BlockId id, const Values& start, const ir::ModalState& modes) {
    std::array<std::size_t, 2> plane{};
    switch (modes.plane) {
      case ir::Plane::kXY:
        plane = {0, 1};
        break;
      case ir::Plane::kZX:
        plane = {2, 0};
        break;
      case ir::Plane::kYZ:
        plane = {1, 2};
        break;
      default:
        return;
    }
    if (modes.units == ir::Units::kUnknown) return;
    std::array<double, kAxes> center{};
    bool has_center = false;
    const ir::Word* radius = nullptr;
    const ir::Word* first = nullptr;
    const ir::Word* last = nullptr;
    for (const ir::WordId word_id : module_.blocks[id].words) {
      const ir::Word& word = module_.words[word_id];
      if (word.op == WordOp::kRadius) radius = &word;
      if (word.op == WordOp::kAxis || word.op == WordOp::kCenter) {
        if (first == nullptr) first = &word;
        last = &word;
      }
      if (word.op != WordOp::kCenter) continue;
      const std::optional<double> value = LiteralValue(module_, word.value);
      const bool from_start = word.mode == ir::ValueMode::kStep || word.mode == ir::ValueMode::kIncremental;
      if (!value || !from_start || word.index >= kAxes || (word.flags & ir::Word::kIncrements) != 0) return;
      // A centre letter that is not of the plane is the cause, and CheckArcWords tells it.
      if (word.index != plane[0] && word.index != plane[1]) return;
      center[word.index] = *value;
      has_center = true;
    }
    if (!has_center && radius == nullptr) return;
    for (const std::size_t axis : plane) {
      if (!start[axis] || !at_[axis]) return;
    }
    const bool inch = modes.units == ir::Units::kInch || modes.units == ir::Units::kInchGeometry;
    if (radius != nullptr) {
      if (has_center || first == nullptr) return;
      const double way = std::hypot(*at_[plane[0]] - *start[plane[0]], *at_[plane[1]] - *start[plane[1]]);
      if (way > kSamePoint) {
        Radius(id, *radius, way / 2, inch);
      } else {
        SourceRange place = subject_.PlaceOf(id, *first);
        place.end = last->begin + last->length;
        sink_
            .ReportAs(diag::Severity::kWarning, diag::Code::kWordConflict, place,
                      "an end point that is the start point", "a radius")
            .help = "a full circle needs its centre, and other arcs another end point";
      }
      return;
    }
    const double u = center[plane[0]];
    const double v = center[plane[1]];
    const double at_start = std::hypot(u, v);
    const double at_end = std::hypot(*start[plane[0]] + u - *at_[plane[0]], *start[plane[1]] + v - *at_[plane[1]]);
    const double tolerance = Tolerance(at_start, inch);
    if (std::fabs(at_start - at_end) <= tolerance * (1 + 1e-9)) return;
    SourceRange place = subject_.PlaceOf(id, *first);
    place.end = last->begin + last->length;
    diag::Diagnostic& finding =
        sink_.Report(diag::Code::kArcRadius, place, fmt::format("{:.6g}", at_start), fmt::format("{:.6g}", at_end));
    finding.control = dialects::AlarmFor(subject_.profile, finding.code);
    finding.notes.push_back({{}, fmt::format("the control takes a difference of {:.4g}", tolerance)});
    finding.help = "one of the end point and the centre is wrong; the centre counts from the start point";
  }

  /// An arc by its radius: half of the way from the start to the end is the least one.
  void Radius(BlockId id, const ir::Word& word, double least, bool inch) {
    const std::optional<double> value = LiteralValue(module_, word.value);
    if (!value || (word.flags & ir::Word::kIncrements) != 0) return;
    const double radius = std::fabs(*value);
    if (least - radius <= Tolerance(radius, inch) * (1 + 1e-9)) return;
    sink_
        .Report(diag::Code::kOutOfRange, subject_.PlaceOf(id, word), fmt::format("{:.6g}", radius),
                fmt::format("the radii that reach the end point, {:.6g} and more", least))
        .help = "one of the radius and the end point is wrong";
  }

  /// Difference of radii that the control takes.
  [[nodiscard]] double Tolerance(double radius, bool inch) const {
    return std::fmax(subject_.machine.circle_tolerance / (inch ? kInch : 1),
                     subject_.machine.circle_tolerance_factor * radius);
  }

  const Subject& subject_;
  const ir::Module& module_;
  ir::ProgramId program_;
  diag::Sink& sink_;
  Values at_;  // lengths as programmed, the transverse axis as radius
};

}  // namespace

void CheckArcs(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  ArcCheck{subject, program, sink}.Run();
}

}  // namespace ncport::check
