// Arcs whose start, end, centre and radius are known numbers, in the text or as values of variables here: end points
// and centre that do not lie on one circle, a radius that does not reach, or one where the start is the end. The
// geometry is that of a run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "check/expressions.h"
#include "check/value_rules.h"
#include "exec/arc_geometry.h"
#include "ir/length_units.h"
#include "ir/motions.h"
#include "ir/plane_axes.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::WordOp;

constexpr std::size_t kAxes = 3;     // X Y Z
constexpr double kSamePoint = 1e-9;  // mm, as in a run

/// Words that leave the position of the axes as the program wrote it, and the coordinate system.
bool KeepsCoordinates(WordOp op) {
  switch (op) {
    case WordOp::kMotion:
    case WordOp::kPlane:
    case WordOp::kDistance:
    case WordOp::kFeedMode:
    case WordOp::kSpeedMode:
    case WordOp::kCutterComp:
    case WordOp::kReturnLevel:
    case WordOp::kPathMode:
    case WordOp::kExactOnce:
    case WordOp::kInert:
    case WordOp::kAxis:
    case WordOp::kCenter:
    case WordOp::kRadius:
    case WordOp::kOpeningAngle:
    case WordOp::kTurns:
    case WordOp::kChamfer:  // cuts the corner off the path, the points stay
    case WordOp::kDwellSeconds:
    case WordOp::kDwellRevolutions:
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
    case WordOp::kReturn:
    case WordOp::kProgramEnd:
    // What follows on one way only; where ways meet nothing is kept.
    case WordOp::kIf:
    case WordOp::kJump:
      return true;
    default:
      return false;
  }
}

/// Words that a tool or its offset comes with. The points of the program stay where they are written, but how far the
/// offset reaches in the plane is data of the tool.
bool ChangesTool(WordOp op) {
  switch (op) {
    case WordOp::kTool:
    case WordOp::kToolChange:
    case WordOp::kToolOffset:
    case WordOp::kEdge:
      return true;
    default:
      return false;
  }
}

/// Other words that act before the axis words of their block: what was known of the position may be another number now.
bool RenewsCoordinates(WordOp op) { return op == WordOp::kWorkOffset; }

/// Words that change how numbers are read, and the length along the tool.
bool KeepsPlane(WordOp op) {
  switch (op) {
    case WordOp::kUnits:
    case WordOp::kDiameter:
    case WordOp::kLengthOffset:
    case WordOp::kRadiusOffset:
      return true;
    default:
      return false;
  }
}

/// Follows the positions that are known through blocks that run one after the other, for each way into a program.
class Arcs final : public ValueRule {
 public:
  Arcs(const ValueRuleInput& input, ValueFindings& findings, const ir::analysis::FlowGraphs& graphs,
       const ir::analysis::ModalFlow& modal)
      : ValueRule(input, findings), graphs_(graphs), modal_(modal) {}

  void Block(const Site& site, Lookup& lookup) override {
    const ir::ProgramId program = site.context->program;
    if (input_.module.programs[program].library) return;
    if (site.context != context_) {
      context_ = site.context;
      before_ = {};
      in_cycle_ = false;
      computed_ = HasComputedJumps(program);
    }
    const ir::Block& block = input_.module.blocks[site.block];
    const auto ways = graphs_.Of(program).Predecessors(site.block);
    const bool target = block.label.Valid() || block.number != ir::Block::kNoNumber;
    const bool goes_on = before_.Valid() && ways.size() == 1 && ways[0] == before_;
    if (!goes_on || (computed_ && target)) Forget();
    const bool first = site.block == graphs_.Of(program).Blocks()[0];
    if (first && ways.empty() && !(computed_ && target)) TakeFromCaller();
    before_ = site.block;
    Follow(site, block, lookup);
  }

  void StartDone() override {
    context_ = nullptr;
    at_calls_.clear();
  }

 private:
  using Values = std::array<std::optional<double>, kAxes>;  // mm
  using CallPlace = std::pair<const ir::analysis::CallContext*, std::uint32_t>;

  [[nodiscard]] bool HasComputedJumps(ir::ProgramId program) const {
    const ir::analysis::Cfg& graph = graphs_.Of(program);
    if (graph.Opaque()) return true;
    for (const BlockId id : graph.Blocks()) {
      for (const ir::analysis::Edge& edge : graph.Successors(id)) {
        if (edge.kind == ir::analysis::EdgeKind::kComputed) return true;
      }
    }
    return false;
  }

  void Forget() {
    at_ = {};
    doubtful_ = {};
  }

  /// The position at the one call that leads here, if the caller was handed out before.
  void TakeFromCaller() {
    if (context_->caller == nullptr || context_->open || context_->modal) return;
    const ir::Call& call = input_.module.calls[context_->call];
    if (call.passes.Valid() || call.from_block || call.form == ir::CallForm::kBlockRange) return;
    const auto place = at_calls_.find({context_->caller, context_->block.value});
    if (place != at_calls_.end()) at_ = place->second;
  }

  void Follow(const Site& site, const ir::Block& block, Lookup& lookup) {
    if (block.words.Empty()) return;
    const ir::ModalState modes = modal_.At(site.context->program, site.block);
    bool keeps = block.skip_level == ir::Block::kNoSkip && (block.flags & ir::Block::kRefused) == 0;
    bool renews = false;
    bool tool = false;
    bool length = false;
    std::size_t calls = 0;
    assigns_ = false;
    for (const ir::WordId word : block.words) {
      const WordOp op = input_.module.words[word].op;
      renews = renews || RenewsCoordinates(op);
      tool = tool || ChangesTool(op);
      // Where a canned cycle leaves the axes is not what its words say.
      if (op == WordOp::kCycle) in_cycle_ = true;
      if (op == WordOp::kMotion) in_cycle_ = false;
      length = length || op == WordOp::kLengthOffset;
      calls += op == WordOp::kCall ? 1 : 0;
      keeps = keeps && (KeepsCoordinates(op) || RenewsCoordinates(op) || ChangesTool(op) || KeepsPlane(op) ||
                        op == WordOp::kCall);
      assigns_ = assigns_ || op == WordOp::kAssign;
    }
    if (!keeps || renews || in_cycle_) Forget();
    if (!keeps || in_cycle_) return;
    if (tool || length) at_[kAxes - 1].reset();
    if (tool || length) at_[modes.plane == ir::Plane::kUnknown ? 0 : ir::AxesOf(modes.plane).normal].reset();
    if (tool) doubtful_.fill(true);
    const Values start = at_;
    const std::array<bool, kAxes> doubtful = doubtful_;
    Move(block, modes, lookup);
    const bool arc = ir::IsPlaneArc(modes.motion);
    if (arc) Arc(site, start, doubtful, modes, lookup);
    // A probe stands where it triggers, and a modal call moves on.
    const bool elsewhere =
        modes.motion == ir::Motion::kProbe || modal_.ModalCallPossible(site.context->program, site.block);
    if (elsewhere) Forget();
    if (calls == 0) return;
    if (calls == 1 && !IsDoubtful()) at_calls_[{site.context, site.block.value}] = at_;
    Forget();
  }

  [[nodiscard]] bool IsDoubtful() const {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      if (at_[axis] && doubtful_[axis]) return true;
    }
    return false;
  }

  /// The number that the expression has here whatever happens. A block that also assigns is taken by its literals.
  [[nodiscard]] std::optional<double> Known(ir::ExprId expr, Lookup& lookup) const {
    if (const std::optional<double> literal = LiteralValue(input_.module, expr)) return literal;
    if (assigns_ || !expr.Valid()) return std::nullopt;
    const Interval value = lookup.Evaluate(expr);
    if (!value.IsPoint() || value.Has(Interval::kInput)) return std::nullopt;
    return value.low;
  }

  /// Millimetres of a word's number, but for diameters.
  [[nodiscard]] double UnitOf(const ir::Word& word, const ir::ModalState& modes) const {
    const double length = ir::MmPerLengthUnit(modes.units);
    if ((word.flags & ir::Word::kIncrements) == 0) return length;
    return length == 1 ? input_.machine.increment : input_.machine.increment / 10 * length;
  }

  void Move(const ir::Block& block, const ir::ModalState& modes, Lookup& lookup) {
    for (const ir::WordId id : block.words) {
      const ir::Word& word = input_.module.words[id];
      if (word.op != WordOp::kAxis || word.index >= kAxes) continue;
      std::optional<double>& at = at_[word.index];
      const std::optional<double> value = Known(word.value, lookup);
      const bool modal = word.mode == ir::ValueMode::kModal;
      const bool absolute =
          word.mode == ir::ValueMode::kAbsolute || (modal && modes.distance == ir::Distance::kAbsolute);
      const bool incremental =
          word.mode == ir::ValueMode::kIncremental || (modal && modes.distance == ir::Distance::kIncremental);
      const std::optional<double> factor = FactorOf(word.index, absolute, modes);
      if (!value || !factor || modes.units == ir::Units::kUnknown || (!absolute && !incremental)) {
        at.reset();
      } else if (absolute) {
        at = *value * UnitOf(word, modes) * *factor;
        doubtful_[word.index] = false;
      } else if (at) {
        at = *at + *value * UnitOf(word, modes) * *factor;
      }
    }
  }

  /// What a number of the axis counts in lengths; nothing where the mode is not known.
  [[nodiscard]] std::optional<double> FactorOf(std::uint8_t axis, bool absolute, const ir::ModalState& modes) const {
    if (axis != input_.machine.transverse_axis) return 1;
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

  /// The words that describe an arc.
  struct Description {
    const ir::Word* first = nullptr;  // of the end point and the centre
    const ir::Word* last = nullptr;
    const ir::Word* radius = nullptr;
    const ir::Word* opening = nullptr;
    exec::Point start, end, center;
    bool has_center = false;
    bool has_end = false;
    bool doubtful = false;  // the start is older than the tool
    double unit = 1;        // mm
  };

  /// A centre as a run takes it: increments count from the start and are no diameters.
  [[nodiscard]] std::optional<double> CenterOf(const ir::Word& word, double start, const ir::ModalState& modes,
                                               Lookup& lookup) const {
    std::optional<double> value = Known(word.value, lookup);
    if (!value) return std::nullopt;
    *value *= UnitOf(word, modes);
    if (word.mode == ir::ValueMode::kStep || word.mode == ir::ValueMode::kIncremental) return start + *value;
    if (word.mode != ir::ValueMode::kAbsolute) return std::nullopt;
    if (word.index != input_.machine.transverse_axis) return value;
    if (!input_.machine.centers_are_diameter_when_absolute) return value;
    const std::optional<double> factor = FactorOf(word.index, true, modes);
    return factor ? std::optional(*value * *factor) : std::nullopt;
  }

  /// False if something of it is not known, or wrong in a way that another rule tells.
  [[nodiscard]] bool Describe(const Site& site, const Values& start, const ir::ModalState& modes, Lookup& lookup,
                              Description& arc) const {
    const ir::PlaneAxes plane = ir::AxesOf(modes.plane);
    if (!start[plane.first] || !at_[plane.first] || !start[plane.second] || !at_[plane.second]) return false;
    arc.unit = ir::MmPerLengthUnit(modes.units);
    arc.start = {*start[plane.first], *start[plane.second]};
    arc.end = {*at_[plane.first], *at_[plane.second]};
    arc.center = arc.start;  // a missing letter is no way from the start
    for (const ir::WordId id : input_.module.blocks[site.block].words) {
      const ir::Word& word = input_.module.words[id];
      if (word.op == WordOp::kRadius) arc.radius = &word;
      if (word.op == WordOp::kOpeningAngle) arc.opening = &word;
      if (word.op == WordOp::kAxis || word.op == WordOp::kCenter) {
        if (arc.first == nullptr) arc.first = &word;
        arc.last = &word;
      }
      if (word.op == WordOp::kAxis) arc.has_end |= word.index == plane.first || word.index == plane.second;
      if (word.op != WordOp::kCenter) continue;
      // A centre letter that is not of the plane is the cause, and CheckArcWords tells it.
      if (word.index != plane.first && word.index != plane.second) return false;
      double& place = word.index == plane.first ? arc.center.u : arc.center.v;
      const std::optional<double> value = CenterOf(word, place, modes, lookup);
      if (!value) return false;
      place = *value;
      arc.has_center = true;
    }
    return arc.first != nullptr;
  }

  void Arc(const Site& site, const Values& start, const std::array<bool, kAxes>& doubtful, const ir::ModalState& modes,
           Lookup& lookup) {
    if (modes.plane == ir::Plane::kUnknown || modes.units == ir::Units::kUnknown) return;
    const ir::PlaneAxes plane = ir::AxesOf(modes.plane);
    Description arc;
    if (!Describe(site, start, modes, lookup, arc)) return SkipEnd(site, plane);
    arc.doubtful = doubtful[plane.first] || doubtful[plane.second];
    if (arc.radius != nullptr) {
      if (arc.has_center || arc.opening != nullptr) return;
      return Radius(site, arc, modes, lookup);
    }
    if (arc.opening != nullptr) return Opening(site, arc, plane, lookup);
    if (!arc.has_center) return;
    const bool full = !arc.has_end || (std::fabs(arc.end.u - arc.start.u) <= kSamePoint &&
                                       std::fabs(arc.end.v - arc.start.v) <= kSamePoint);
    Judge(site, exec::ArcByCenter(arc.start, full ? arc.start : arc.end, arc.center, false, Tolerance()), arc, lookup);
  }

  /// The end of an arc by its angle is not among its words.
  void SkipEnd(const Site& site, const ir::PlaneAxes& plane) {
    for (const ir::WordId id : input_.module.blocks[site.block].words) {
      if (input_.module.words[id].op != WordOp::kOpeningAngle) continue;
      at_[plane.first].reset();
      at_[plane.second].reset();
    }
  }

  void Opening(const Site& site, const Description& arc, const ir::PlaneAxes& plane, Lookup& lookup) {
    const std::optional<double> angle = Known(arc.opening->value, lookup);
    if (!angle || (arc.has_center && arc.has_end)) return SkipEnd(site, plane);
    if (!arc.has_center) return Judge(site, exec::ArcByAngle(arc.start, arc.end, *angle, false), arc, lookup);
    Judge(site, exec::ArcByCenterAndAngle(arc.start, arc.center, *angle, false), arc, lookup);
    SkipEnd(site, plane);  // clockwise or not, whichever is turned back
  }

  [[nodiscard]] Certainty CertaintyOf(const Description& arc) const {
    return arc.doubtful ? Certainty::kLikely : Certainty::kCertain;
  }

  void Judge(const Site& site, const exec::Arc& found, const Description& arc, Lookup& lookup) {
    switch (found.fault) {
      case exec::ArcFault::kRadiiDiffer:
      case exec::ArcFault::kCenterOnPoint:
        return Circle(site, found, arc, lookup);
      case exec::ArcFault::kNoEnd:
        return SamePoint(site, arc, arc.opening != nullptr ? "an opening angle" : "a radius", lookup);
      default:
        return;  // an angle that is none is told where its value is
    }
  }

  void Circle(const Site& site, const exec::Arc& found, const Description& arc, Lookup& lookup) {
    const exec::ArcTolerance tolerance = Tolerance();
    ValueFinding finding{.code = diag::Code::kArcRadius,
                         .certainty = CertaintyOf(arc),
                         .first = fmt::format("{:.6g}", found.start_radius / arc.unit),
                         .second = fmt::format("{:.6g}", found.end_radius / arc.unit),
                         .control = ControlAlarm(ir::AlarmClass::kCircle)};
    if (found.fault == exec::ArcFault::kCenterOnPoint) {
      finding.help = "the centre lies on the start or the end point";
    } else {
      const double most = std::fmax(tolerance.length, tolerance.factor * found.start_radius) / arc.unit;
      finding.notes = {{{}, fmt::format("the control takes a difference of {:.4g}", most)}};
      finding.help = "one of the end point and the centre is wrong; the centre counts from the start point";
    }
    Add(site, arc, lookup, std::move(finding));
  }

  /// Where the control stays where it is, nothing alarms, and nothing is cut.
  void SamePoint(const Site& site, const Description& arc, std::string_view other, Lookup& lookup) {
    const bool stays = arc.radius != nullptr && input_.machine.arc_radius_without_end_stays;
    ValueFinding finding{.code = diag::Code::kWordConflict,
                         .certainty = stays ? Certainty::kLikely : CertaintyOf(arc),
                         .first = "an end point that is the start point",
                         .second = std::string(other),
                         .help = "a full circle needs its centre, and other arcs another end point"};
    if (!stays) finding.control = ControlAlarm(ir::AlarmClass::kCircle);
    Add(site, arc, lookup, std::move(finding));
  }

  /// At all words of the arc, with the values that they have here.
  void Add(const Site& site, const Description& arc, Lookup& lookup, ValueFinding finding) {
    if (!findings_.IsNews(finding.code, arc.first->value, 0, finding.certainty)) return;
    finding.at = PlaceOf(site, *arc.first);
    finding.at.end = arc.last->begin + arc.last->length;
    const std::size_t own = finding.notes.size();
    for (const ir::WordId id : input_.module.blocks[site.block].words) {
      const ir::Word& word = input_.module.words[id];
      const bool described = word.op == WordOp::kAxis || word.op == WordOp::kCenter;
      if (described && !LiteralValue(input_.module, word.value)) AddReasons(site, word.value, lookup, finding);
    }
    if (finding.notes.size() == own) AddReasons(site, arc.first->value, lookup, finding);
    findings_.Add(arc.first->value, 0, std::move(finding));
  }

  void AddReasons(const Site& site, ir::ExprId value, Lookup& lookup, ValueFinding& finding) const {
    for (diag::Note& note : Reasons(site, value, lookup)) {
      const auto same = [&](const diag::Note& known) { return known.text == note.text; };
      if (std::ranges::none_of(finding.notes, same)) finding.notes.push_back(std::move(note));
    }
  }

  /// An arc by its radius: half of the way from the start to the end is the least one.
  void Radius(const Site& site, const Description& arc, const ir::ModalState& modes, Lookup& lookup) {
    const ir::Word& word = *arc.radius;
    const std::optional<double> value = Known(word.value, lookup);
    const double least = std::hypot(arc.end.u - arc.start.u, arc.end.v - arc.start.v) / 2;
    if (least <= kSamePoint) return SamePoint(site, arc, "a radius", lookup);
    if (!value) return;
    const exec::Arc found = exec::ArcByRadius(arc.start, arc.end, *value * UnitOf(word, modes), false, Tolerance());
    if (found.fault != exec::ArcFault::kRadiusTooSmall) return;
    if (!findings_.IsNews(diag::Code::kOutOfRange, word.value, 0, CertaintyOf(arc))) return;
    findings_.Add(word.value, 0,
                  {.code = diag::Code::kOutOfRange,
                   .certainty = CertaintyOf(arc),
                   .first = fmt::format("{:.6g}", std::fabs(*value * UnitOf(word, modes)) / arc.unit),
                   .second = fmt::format("the radii that reach the end point, {:.6g} and more", least / arc.unit),
                   .at = PlaceOf(site, word),
                   .notes = Reasons(site, word.value, lookup),
                   .help = "one of the radius and the end point is wrong"});
  }

  [[nodiscard]] SourceRange PlaceOf(const Site& site, const ir::Word& word) const {
    return input_.module.RangeOf(input_.module.blocks[site.block], word);
  }

  [[nodiscard]] exec::ArcTolerance Tolerance() const {
    const ir::Machine& machine = input_.machine;
    return {machine.circle_tolerance, machine.circle_tolerance_factor, machine.arc_center_corrected,
            machine.arc_correction_angle};
  }

  const ir::analysis::FlowGraphs& graphs_;
  const ir::analysis::ModalFlow& modal_;
  const ir::analysis::CallContext* context_ = nullptr;
  BlockId before_;                        // the block that was handed out before, of this context
  bool computed_ = false;                 // a jump of this program may lead to any label or number
  bool in_cycle_ = false;                 // in the order of the text
  bool assigns_ = false;                  // this block does
  Values at_;                             // as programmed, the transverse axis as radius
  std::array<bool, kAxes> doubtful_{};    // written before the tool that is in came into force
  std::map<CallPlace, Values> at_calls_;  // of this start
};

}  // namespace

std::unique_ptr<ValueRule> MakeArcs(const ValueRuleInput& input, ValueFindings& findings,
                                    const ir::analysis::FlowGraphs& graphs, const ir::analysis::ModalFlow& modal) {
  return std::make_unique<Arcs>(input, findings, graphs, modal);
}

}  // namespace ncport::check
