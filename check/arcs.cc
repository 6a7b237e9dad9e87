// Arcs whose start, end, centre and radius are known numbers, in the text or as values of variables here: end points
// and centre that do not lie on one circle, a radius that does not reach, or one where the start is the end.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "check/expressions.h"
#include "check/value_rules.h"
#include "ir/plane_axes.h"

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
      computed_ = HasComputedJumps(program);
    }
    const ir::Block& block = input_.module.blocks[site.block];
    const auto ways = graphs_.Of(program).Predecessors(site.block);
    const bool target = block.label.Valid() || block.number != ir::Block::kNoNumber;
    if (!before_.Valid() || ways.size() != 1 || ways[0] != before_ || (computed_ && target)) Forget();
    before_ = site.block;
    Follow(site, block, lookup);
  }

  void StartDone() override { context_ = nullptr; }

 private:
  using Values = std::array<std::optional<double>, kAxes>;

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

  void Forget() { at_ = {}; }

  void Follow(const Site& site, const ir::Block& block, Lookup& lookup) {
    if (block.words.Empty()) return;
    const ir::ModalState modes = modal_.At(site.context->program, site.block);
    const ir::ModalState before = modal_.Before(site.context->program, site.block);
    bool keeps = block.skip_level == ir::Block::kNoSkip && (block.flags & ir::Block::kRefused) == 0;
    bool renews = modes.diameter != before.diameter;
    assigns_ = false;
    for (const ir::WordId word : block.words) {
      const WordOp op = input_.module.words[word].op;
      renews = renews || RenewsCoordinates(op);
      keeps = keeps && (KeepsCoordinates(op) || RenewsCoordinates(op));
      assigns_ = assigns_ || op == WordOp::kAssign;
    }
    if (!keeps || renews) Forget();
    if (!keeps) return;
    const Values start = at_;
    Move(block, modes, lookup);
    const bool arc = modes.motion == ir::Motion::kArcCw || modes.motion == ir::Motion::kArcCcw;
    if (arc) Arc(site, start, modes, lookup);
  }

  /// The number that the expression has here whatever happens. A block that also assigns is taken by its literals.
  [[nodiscard]] std::optional<double> Known(ir::ExprId expr, Lookup& lookup) const {
    if (const std::optional<double> literal = LiteralValue(input_.module, expr)) return literal;
    if (assigns_ || !expr.Valid()) return std::nullopt;
    const Interval value = lookup.Evaluate(expr);
    if (!value.IsPoint() || value.Has(Interval::kInput)) return std::nullopt;
    return value.low;
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
    std::array<double, kAxes> center{};
    bool has_center = false;
  };

  /// False if something of it is not known, or wrong in a way that another rule tells.
  [[nodiscard]] bool Describe(const Site& site, const ir::PlaneAxes& plane, Lookup& lookup, Description& arc) const {
    for (const ir::WordId id : input_.module.blocks[site.block].words) {
      const ir::Word& word = input_.module.words[id];
      if (word.op == WordOp::kRadius) arc.radius = &word;
      if (word.op == WordOp::kAxis || word.op == WordOp::kCenter) {
        if (arc.first == nullptr) arc.first = &word;
        arc.last = &word;
      }
      if (word.op != WordOp::kCenter) continue;
      const std::optional<double> value = Known(word.value, lookup);
      const bool from_start = word.mode == ir::ValueMode::kStep || word.mode == ir::ValueMode::kIncremental;
      if (!value || !from_start || word.index >= kAxes || (word.flags & ir::Word::kIncrements) != 0) return false;
      // A centre letter that is not of the plane is the cause, and CheckArcWords tells it.
      if (word.index != plane.first && word.index != plane.second) return false;
      arc.center[word.index] = *value;
      arc.has_center = true;
    }
    return arc.has_center != (arc.radius != nullptr);
  }

  void Arc(const Site& site, const Values& start, const ir::ModalState& modes, Lookup& lookup) {
    if (modes.plane == ir::Plane::kUnknown || modes.units == ir::Units::kUnknown) return;
    const ir::PlaneAxes plane = ir::AxesOf(modes.plane);
    Description arc;
    if (!Describe(site, plane, lookup, arc) || arc.first == nullptr) return;
    if (!start[plane.first] || !at_[plane.first] || !start[plane.second] || !at_[plane.second]) return;
    const double way_u = *at_[plane.first] - *start[plane.first];
    const double way_v = *at_[plane.second] - *start[plane.second];
    const bool inch = modes.units == ir::Units::kInch || modes.units == ir::Units::kInchGeometry;
    if (arc.radius != nullptr) {
      const double way = std::hypot(way_u, way_v);
      if (way > kSamePoint) return Radius(site, *arc.radius, way / 2, inch, lookup);
      // Where the control stays where it is, nothing alarms, and nothing is cut.
      const bool stays = input_.machine.arc_radius_without_end_stays;
      ValueFinding finding{.code = diag::Code::kWordConflict,
                           .certainty = stays ? Certainty::kLikely : Certainty::kCertain,
                           .first = "an end point that is the start point",
                           .second = "a radius",
                           .help = "a full circle needs its centre, and other arcs another end point"};
      if (!stays) finding.control = ControlAlarm(ir::AlarmClass::kCircle);
      return Add(site, arc, lookup, std::move(finding));
    }
    const double u = arc.center[plane.first];
    const double v = arc.center[plane.second];
    const double at_start = std::hypot(u, v);
    const double at_end = std::hypot(u - way_u, v - way_v);
    const double tolerance = Tolerance(at_start, inch);
    if (std::fabs(at_start - at_end) <= tolerance * (1 + 1e-9)) return;
    ValueFinding finding{.code = diag::Code::kArcRadius,
                         .certainty = Certainty::kCertain,
                         .first = fmt::format("{:.6g}", at_start),
                         .second = fmt::format("{:.6g}", at_end),
                         .notes = {{{}, fmt::format("the control takes a difference of {:.4g}", tolerance)}},
                         .help = "one of the end point and the centre is wrong; the centre counts from the start point",
                         .control = ControlAlarm(ir::AlarmClass::kCircle)};
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
  void Radius(const Site& site, const ir::Word& word, double least, bool inch, Lookup& lookup) {
    const std::optional<double> value = Known(word.value, lookup);
    if (!value || (word.flags & ir::Word::kIncrements) != 0) return;
    const double radius = std::fabs(*value);
    if (least - radius <= Tolerance(radius, inch) * (1 + 1e-9)) return;
    if (!findings_.IsNews(diag::Code::kOutOfRange, word.value, 0, Certainty::kCertain)) return;
    findings_.Add(word.value, 0,
                  {.code = diag::Code::kOutOfRange,
                   .certainty = Certainty::kCertain,
                   .first = fmt::format("{:.6g}", radius),
                   .second = fmt::format("the radii that reach the end point, {:.6g} and more", least),
                   .at = PlaceOf(site, word),
                   .notes = Reasons(site, word.value, lookup),
                   .help = "one of the radius and the end point is wrong"});
  }

  [[nodiscard]] SourceRange PlaceOf(const Site& site, const ir::Word& word) const {
    return input_.module.RangeOf(input_.module.blocks[site.block], word);
  }

  /// Difference of radii that the control takes.
  [[nodiscard]] double Tolerance(double radius, bool inch) const {
    return std::fmax(input_.machine.circle_tolerance / (inch ? kInch : 1),
                     input_.machine.circle_tolerance_factor * radius);
  }

  const ir::analysis::FlowGraphs& graphs_;
  const ir::analysis::ModalFlow& modal_;
  const ir::analysis::CallContext* context_ = nullptr;
  BlockId before_;         // the block that was handed out before, of this context
  bool computed_ = false;  // a jump of this program may lead to any label or number
  bool assigns_ = false;   // this block does
  Values at_;              // lengths as programmed, the transverse axis as radius
};

}  // namespace

std::unique_ptr<ValueRule> MakeArcs(const ValueRuleInput& input, ValueFindings& findings,
                                    const ir::analysis::FlowGraphs& graphs, const ir::analysis::ModalFlow& modal) {
  return std::make_unique<Arcs>(input, findings, graphs, modal);
}

}  // namespace ncport::check
