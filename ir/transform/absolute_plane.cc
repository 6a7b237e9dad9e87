// Opening angles and intermediate points as end points and centres (part of absolute_dimensions.h).
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/analysis/value_range.h"
#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/transform/dimension_pass.h"

namespace ncport::ir::transform {

namespace {

using Kind = PlaneWords::Kind;
using Change = PlaneWords::Change;

constexpr double kSamePoint = 1e-9;  // mm

Word MadeWord(WordOp op, std::uint8_t index, ValueMode mode, ExprId value) {
  Word word = MakeWord(op, index, value);
  word.mode = mode;
  return word;
}

/// Joins the values of the watched words over all ways to them.
class Watcher final : public analysis::RangeObserver {
 public:
  Watcher(const Module& module, std::map<std::uint32_t, analysis::Interval>& ranges)
      : module_(module), ranges_(ranges) {}
  void Block(const analysis::RangeSite& site, analysis::RangeLookup& lookup) override {
    for (const WordId id : module_.blocks[site.block].words) {
      const Word& word = module_.words[id];
      if (word.op != WordOp::kPolarRadius && word.op != WordOp::kOpeningAngle) continue;
      const analysis::Interval value = lookup.Evaluate(word.value);
      const auto [known, first] = ranges_.emplace(id.value, value);
      if (!first) known->second = analysis::Join(known->second, value);
    }
  }

 private:
  const Module& module_;
  std::map<std::uint32_t, analysis::Interval>& ranges_;
};

}  // namespace

bool DimensionPass::Refuse(BlockId block, const Word& word, std::string_view what, std::string_view help) {
  ok_ = false;
  auto& finding = sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[block], word), what,
                               config_.target.empty() ? std::string_view("the target") : config_.target);
  if (!help.empty()) finding.help = help;
  return false;
}

/// What radii and opening angles can be is asked for only where a program computes them.
void DimensionPass::FindRanges() {
  bool computed = false;
  for (const Word& word : module_.words.All()) {
    if (word.op == WordOp::kPolarRadius || word.op == WordOp::kPolarAngle) polar_ = true;
    if (word.op == WordOp::kPole || word.op == WordOp::kPlane) poles_ = true;
    if (word.op == WordOp::kPolarRadius || word.op == WordOp::kOpeningAngle)
      computed = computed || !FormOf(module_, word.value).IsConstant();
  }
  if (!computed) return;
  analysis::RangeOptions options;
  options.declared = config_.declared;
  Watcher watcher(module_, ranges_);
  analysis::FindValueRanges(module_, source_, analyses_.Graphs(), analyses_.Calls(), options, watcher);
}

bool DimensionPass::Within(BlockId block, const Word& word, double low, double high) const {
  const LinearForm form = FormOf(module_, word.value);
  if (form.IsConstant()) return form.constant >= low && form.constant <= high;
  for (const WordId id : module_.blocks[block].words) {
    const Word& each = module_.words[id];
    if (each.op != word.op) continue;
    const auto known = ranges_.find(id.value);
    return known != ranges_.end() && known->second.HasNumber() && known->second.low >= low &&
           known->second.high <= high && !known->second.Has(analysis::Interval::kVacant);
  }
  return false;
}

PlaneWords DimensionPass::PlaneWordsOf(BlockId id) const {
  PlaneWords found;
  bool opening = false, center = false, via = false, polar = false, pole = false, plane = false;
  for (const WordId word_id : module_.blocks[id].words) {
    const WordOp op = module_.words[word_id].op;
    opening = opening || op == WordOp::kOpeningAngle;
    center = center || op == WordOp::kCenter;
    via = via || op == WordOp::kVia;
    polar = polar || op == WordOp::kPolarAngle || op == WordOp::kPolarRadius;
    pole = pole || op == WordOp::kPole;
    plane = plane || op == WordOp::kPlane;
  }
  if (!opening && !via && !polar && !pole && !(plane && polar_)) return found;
  found.kind = pole      ? Kind::kPole
               : polar   ? Kind::kPolar
               : opening ? (center ? Kind::kOpeningCenter : Kind::kOpeningToEnd)
               : via     ? Kind::kThrough
                         : Kind::kNone;
  found.plane = flow_.At(program_, id).plane;
  found.first = AxesOf(found.plane).first;
  found.second = AxesOf(found.plane).second;
  if (plane) {
    const Plane before = flow_.Before(program_, id).plane;
    found.plane_changes = before == Plane::kUnknown || found.plane == Plane::kUnknown ? Change::kMaybe
                          : before == found.plane                                     ? Change::kNo
                                                                                      : Change::kYes;
  }
  return found;
}

void DimensionPass::FindPlaneWords() {
  plane_words_.assign(blocks_.count, {});
  for (std::uint32_t i = 0; i < blocks_.count; ++i) plane_words_[i] = PlaneWordsOf(blocks_[i]);
}

bool DimensionPass::UsesForPlane(BlockId id, Slot slot) const {
  const PlaneWords& plane = PlaneAt(id);
  const bool pole = slot == kPoleFirst || slot == kPoleSecond;
  switch (plane.kind) {
    case Kind::kNone:
      return false;
    case Kind::kOpeningToEnd:
    case Kind::kOpeningCenter:
      return plane.HasAxis(slot);
    case Kind::kThrough:
      return slot < 3;
    case Kind::kPolar:
      if (pole) return plane.plane_changes == Change::kNo;
      if (slot == kPolarAngle) return WordOf(id, WordOp::kPolarAngle) == nullptr || PolarAngleAdds(id);
      if (slot == kPolarRadius) return WordOf(id, WordOp::kPolarRadius) == nullptr;
      return plane.HasAxis(slot) && PoleIsCenter(id);
    case Kind::kPole: {
      const auto base = static_cast<PoleBase>(WordOf(id, WordOp::kPole)->index);
      if (pole) return base == PoleBase::kLastPole && plane.plane_changes == Change::kNo;
      return base == PoleBase::kLastPosition && plane.HasAxis(slot);
    }
  }
  return false;
}

LinearForm DimensionPass::AsRadius(std::uint8_t axis, const LinearForm& target) const {
  return axis == config_.diameter_axis ? Sum(module_, {}, target, 0.5) : target;
}

LinearForm DimensionPass::AsTarget(std::uint8_t axis, const LinearForm& radius) const {
  return axis == config_.diameter_axis ? Sum(module_, {}, radius, 2) : radius;
}

std::optional<PlanePoint> DimensionPass::StartOfPlane(BlockId id, const Slots& in) const {
  const PlaneWords& plane = PlaneAt(id);
  if (!in[plane.first].Known() || !in[plane.second].Known()) return std::nullopt;
  return PlanePoint{AsRadius(plane.first, in[plane.first].form), AsRadius(plane.second, in[plane.second].form)};
}

std::optional<LinearForm> DimensionPass::EndOfAxis(BlockId id, std::uint8_t axis, const Slots& in) {
  const Word* word = WordFor(id, axis);
  if (word == nullptr) {
    if (!in[axis].Known()) return std::nullopt;
    return AsRadius(axis, in[axis].form);
  }
  const Scale scale = ScaleOf(*word, axis, flow_.At(program_, id), id, false);
  if (!scale.known || (scale.incremental && !in[axis].Known())) return std::nullopt;
  const LinearForm named = ScaledForm(word->value, scale.factor);
  return AsRadius(axis, scale.incremental ? Sum(module_, in[axis].form, named) : named);
}

/// The centre words of the block, from the start point.
std::optional<PlanePoint> DimensionPass::CenterOfPlane(BlockId id, const Slots& in) const {
  const PlaneWords& plane = PlaneAt(id);
  PlanePoint center;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    if (word.op != WordOp::kCenter) continue;
    const std::optional<LinearForm> form = CenterForm(id, word, in);
    if (!form || !plane.HasAxis(word.index)) return std::nullopt;
    (word.index == plane.first ? center.u : center.v) = *form;
  }
  return center;
}

std::optional<PlanePoint> DimensionPass::EndOfPlane(BlockId id, const Slots& in) {
  if (PlaneAt(id).kind == Kind::kPolar) return PolarEnd(id, in);
  const LinearForm angle = FormOf(module_, WordOf(id, WordOp::kOpeningAngle)->value);
  const std::optional<PlanePoint> start = StartOfPlane(id, in);
  const std::optional<PlanePoint> center = CenterOfPlane(id, in);
  const Motion motion = flow_.At(program_, id).motion;
  if (!angle.IsConstant() || !start || !center || !IsPlaneArc(motion)) return std::nullopt;
  if (angle.constant == 360) return start;
  const PlanePoint way = EndByOpening(module_, *center, angle.constant, motion == Motion::kArcCw);
  return PlanePoint{Sum(module_, start->u, way.u), Sum(module_, start->v, way.v)};
}

std::optional<LinearForm> DimensionPass::Computed(BlockId id, Slot slot, const Slots& in) {
  const PlaneWords& plane = PlaneAt(id);
  switch (slot) {
    case kPolarAngle: {
      const LinearForm angle = FormOf(module_, WordOf(id, WordOp::kPolarAngle)->value);
      if (!PolarAngleAdds(id)) return angle;
      if (!in[slot].Known() || plane.plane_changes != Change::kNo) return std::nullopt;
      return Sum(module_, in[slot].form, angle);
    }
    case kPolarRadius:
      return ScaledForm(WordOf(id, WordOp::kPolarRadius)->value, UnitFactor(flow_.At(program_, id)));
    case kPoleFirst:
    case kPoleSecond: {
      if (plane.kind != Kind::kPole) return LinearForm{};  // the plane changes
      const std::optional<PlanePoint> pole = NewPole(id, in);
      if (!pole) return std::nullopt;
      return slot == kPoleFirst ? pole->u : pole->v;
    }
    case kShift:
    case kShift + 1:
    case kShift + 2:
      return NewShift(id, static_cast<std::uint8_t>(slot - kShift), in);
    default: {
      if (FrameWord(id) != nullptr) return SeenFromNewFrame(id, slot, in);
      const std::optional<PlanePoint> end = EndOfPlane(id, in);
      if (!end) return std::nullopt;
      return AsTarget(slot, slot == plane.first ? end->u : end->v);
    }
  }
}

void DimensionPass::AddAxes(const PlaneWords& plane, const PlanePoint& point, std::vector<Word>& words) {
  // In the order of the letters, behind what stands there already.
  const std::uint8_t low = std::min(plane.first, plane.second), high = std::max(plane.first, plane.second);
  for (const std::uint8_t axis : {low, high}) {
    const LinearForm value = AsTarget(axis, axis == plane.first ? point.u : point.v);
    std::size_t place = words.size();
    for (std::size_t i = 0; i < words.size(); ++i) {
      const bool before =
          words[i].op == WordOp::kAxis
              ? words[i].index > axis
              : words[i].op == WordOp::kCenter || words[i].op == WordOp::kRadius || words[i].op == WordOp::kFeed;
      if (!before) continue;
      place = i;
      break;
    }
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(place),
                 MadeWord(WordOp::kAxis, axis, ValueMode::kAbsolute, ExprOf(module_, value)));
  }
}

void DimensionPass::AddCenters(const PlaneWords& plane, const PlanePoint& center, std::vector<Word>& words) {
  std::size_t place = words.size();
  for (std::size_t i = words.size(); i-- > 0 && words[i].op != WordOp::kAxis;) {
    if (words[i].op == WordOp::kFeed) place = i;
  }
  const std::uint8_t low = std::min(plane.first, plane.second), high = std::max(plane.first, plane.second);
  for (const std::uint8_t axis : {low, high}) {
    words.insert(
        words.begin() + static_cast<std::ptrdiff_t>(place++),
        MadeWord(WordOp::kCenter, axis, ValueMode::kStep, ExprOf(module_, axis == plane.first ? center.u : center.v)));
  }
}

bool DimensionPass::LowerPlaneWords(BlockId id, const Slots& in, std::vector<Word>& words) {
  const PlaneWords& plane = PlaneAt(id);
  if (plane.plane == Plane::kUnknown && plane.kind != Kind::kThrough) {
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[id]), "the plane",
                 "the programs that lead here leave it open");
    return false;
  }
  switch (plane.kind) {
    case Kind::kThrough:
      return LowerThrough(id, in, words);
    case Kind::kPolar:
      return LowerPolar(id, in, words);
    default:
      return LowerOpening(id, in, words);
  }
}

bool DimensionPass::LowerOpening(BlockId id, const Slots& in, std::vector<Word>& words) {
  const PlaneWords& plane = PlaneAt(id);
  const Word opening = *WordOf(id, WordOp::kOpeningAngle);
  const Motion motion = flow_.At(program_, id).motion;
  if (!IsPlaneArc(motion) || WordOf(id, WordOp::kRadius) != nullptr || WordOf(id, WordOp::kTurns) != nullptr)
    return Refuse(id, opening, "an opening angle that is not the only word for the shape of an arc");
  const LinearForm angle = FormOf(module_, opening.value);
  if (!angle.IsConstant())
    return Refuse(id, opening, "a computed opening angle", "write the radius or the centre of the arc");
  const bool full = angle.constant == 360 && plane.kind == Kind::kOpeningCenter;
  if (!full && !(angle.constant > 0 && angle.constant < 360))
    return Refuse(id, opening, "an opening angle outside 0 to 360 degrees");
  const std::optional<PlanePoint> start = StartOfPlane(id, in);
  if (!start)
    return Refuse(id, opening, "an opening angle of an arc whose start point is not known",
                  "program both axes of the plane before it, on every way that leads here");
  const bool clockwise = motion == Motion::kArcCw;
  if (plane.kind == Kind::kOpeningCenter) {
    if (WordFor(id, plane.first) != nullptr || WordFor(id, plane.second) != nullptr)
      return Refuse(id, opening, "an opening angle beside a centre and an end point");
    const std::optional<PlanePoint> end = EndOfPlane(id, in);
    if (!end) return Refuse(id, opening, "an opening angle beside a centre outside the plane");
    DropWords(words, WordOp::kOpeningAngle);
    if (!full) AddAxes(plane, *end, words);
    return true;
  }
  const std::optional<LinearForm> end_u = EndOfAxis(id, plane.first, in);
  const std::optional<LinearForm> end_v = EndOfAxis(id, plane.second, in);
  if (!end_u || !end_v) return false;  // has its finding
  const PlanePoint way{Sum(module_, *end_u, start->u, -1), Sum(module_, *end_v, start->v, -1)};
  if (way.u.IsConstant() && way.v.IsConstant() && std::hypot(way.u.constant, way.v.constant) <= kSamePoint)
    return Refuse(id, opening, "an opening angle of an arc that ends where it starts");
  DropWords(words, WordOp::kOpeningAngle);
  AddCenters(plane, CenterByOpening(module_, way, angle.constant, clockwise), words);
  return true;
}

/// A circle through an intermediate point has its plane and sense from the three points (sinumerik-8.3): their
/// distances must be numbers.
bool DimensionPass::LowerThrough(BlockId id, const Slots& in, std::vector<Word>& words) {
  const ModalState state = flow_.At(program_, id);
  const Word first = *WordOf(id, WordOp::kVia);
  if (state.motion != Motion::kArcVia || WordOf(id, WordOp::kTurns) != nullptr ||
      WordOf(id, WordOp::kCenter) != nullptr || WordOf(id, WordOp::kRadius) != nullptr)
    return Refuse(id, first, "an intermediate point that is not the only word for the shape of an arc");
  double way[3] = {}, via[3] = {};
  bool known[3] = {}, named[3] = {};
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    std::optional<LinearForm> end = EndOfAxis(id, axis, in);
    std::optional<LinearForm> middle;
    const Word* point = nullptr;
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kVia && word.index == axis) point = &word;
    }
    named[axis] = point != nullptr || WordFor(id, axis) != nullptr;
    if (!in[axis].Known() || !end) continue;
    const LinearForm start = AsRadius(axis, in[axis].form);
    if (point == nullptr) {
      middle = start;
    } else {
      const bool step = point->mode == ValueMode::kStep || point->mode == ValueMode::kIncremental ||
                        (point->mode == ValueMode::kModal && state.distance == Distance::kIncremental);
      const bool diameter = !step && axis == source_.transverse_axis && source_.centers_are_diameter_when_absolute &&
                            (state.diameter == Diameter::kDiameter || state.diameter == Diameter::kDiameterAbsolute);
      const LinearForm value = ScaledForm(point->value, (diameter ? 0.5 : 1) * UnitFactor(state));
      middle = step ? Sum(module_, start, value) : value;
    }
    const LinearForm to_end = Sum(module_, *end, start, -1);
    const LinearForm to_via = Sum(module_, *middle, start, -1);
    known[axis] = to_end.IsConstant() && to_via.IsConstant();
    way[axis] = to_end.constant;
    via[axis] = to_via.constant;
  }
  for (const std::uint8_t normal : {std::uint8_t{2}, std::uint8_t{1}, std::uint8_t{0}}) {
    const auto [u, v, across] = AxesOf(PlaneWithNormal(normal));
    const bool flat =
        known[normal] ? std::fabs(way[normal]) <= kSamePoint && std::fabs(via[normal]) <= kSamePoint : !named[normal];
    if (!flat || !known[u] || !known[v]) continue;
    const std::optional<ThroughArc> arc = ArcThroughPoints(via[u], via[v], way[u], way[v]);
    if (!arc) continue;
    if (state.plane != PlaneWithNormal(normal))
      return Refuse(id, first, "an arc through a point outside the active plane",
                    "select the plane of the arc before it");
    DropWords(words, WordOp::kVia);
    DropWords(words, WordOp::kMotion);
    words.insert(words.begin(), MakeWord(WordOp::kMotion, arc->clockwise ? Motion::kArcCw : Motion::kArcCcw));
    PlaneWords plane = PlaneAt(id);
    plane.first = u;
    plane.second = v;
    AddCenters(plane, {{arc->center_u, {}}, {arc->center_v, {}}}, words);
    return true;
  }
  return Refuse(id, first, "an arc through a point whose distances from the start are not known numbers in one plane",
                "write the arc with its centre or radius");
}

}  // namespace ncport::ir::transform
