// Polar words as end points, and the pole that they count from (part of absolute_dimensions.h).
#include <utility>
#include <vector>

#include "ir/make_word.h"
#include "ir/transform/dimension_pass.h"

namespace ncport::ir::transform {

namespace {

using Kind = PlaneWords::Kind;
using Change = PlaneWords::Change;

}  // namespace

Step DimensionPass::PolarStep(BlockId id, Slot slot) const {
  const PlaneWords& plane = PlaneAt(id);
  const bool angle = slot == kPolarAngle, radius = slot == kPolarRadius;
  if (plane.kind == Kind::kPole) return angle ? Step::kLost : radius ? Step::kNone : Step::kComputed;
  if (plane.kind == Kind::kPolar && (angle || radius)) {
    if (WordOf(id, angle ? WordOp::kPolarAngle : WordOp::kPolarRadius) != nullptr) return Step::kComputed;
  }
  if (plane.plane_changes == Change::kNo || radius) return Step::kNone;
  return angle || plane.plane_changes == Change::kMaybe ? Step::kLost : Step::kComputed;
}

bool DimensionPass::PolarAngleAdds(BlockId id) const {
  const Word* word = WordOf(id, WordOp::kPolarAngle);
  if (word == nullptr) return false;
  return word->mode == ValueMode::kIncremental ||
         (word->mode == ValueMode::kModal && flow_.At(program_, id).distance == Distance::kIncremental);
}

/// An arc to a polar end point without another word for its centre turns about the pole.
bool DimensionPass::PoleIsCenter(BlockId id) const {
  return PlaneAt(id).kind == Kind::kPolar && IsPlaneArc(flow_.At(program_, id).motion) &&
         WordOf(id, WordOp::kCenter) == nullptr && WordOf(id, WordOp::kRadius) == nullptr;
}

std::optional<PlanePoint> DimensionPass::PoleOf(BlockId id, const Slots& in) const {
  switch (PlaneAt(id).plane_changes) {
    case Change::kYes:
      return PlanePoint{};
    case Change::kMaybe:
      return std::nullopt;
    case Change::kNo:
      break;
  }
  if (!in[kPoleFirst].Known() || !in[kPoleSecond].Known()) return std::nullopt;
  return PlanePoint{in[kPoleFirst].form, in[kPoleSecond].form};
}

std::optional<PlanePoint> DimensionPass::PolarEnd(BlockId id, const Slots& in) {
  const std::optional<PlanePoint> pole = PoleOf(id, in);
  const auto value = [&](Slot slot, WordOp op) -> std::optional<LinearForm> {
    if (WordOf(id, op) != nullptr) return Computed(id, slot, in);
    if (slot == kPolarAngle && PlaneAt(id).plane_changes != Change::kNo) return std::nullopt;
    if (!in[slot].Known()) return std::nullopt;
    return in[slot].form;
  };
  const std::optional<LinearForm> radius = value(kPolarRadius, WordOp::kPolarRadius);
  const std::optional<LinearForm> angle = value(kPolarAngle, WordOp::kPolarAngle);
  if (!pole || !radius || !angle || PlaneAt(id).plane == Plane::kUnknown) return std::nullopt;
  return PolarPoint(module_, *pole, *radius, *angle);
}

std::optional<PlanePoint> DimensionPass::NewPole(BlockId id, const Slots& in) {
  const PlaneWords& plane = PlaneAt(id);
  if (plane.plane == Plane::kUnknown) return std::nullopt;
  PlanePoint pole;
  switch (static_cast<PoleBase>(WordOf(id, WordOp::kPole)->index)) {
    case PoleBase::kWorkpieceZero:
      break;
    case PoleBase::kLastPosition:
    case PoleBase::kLastPole: {
      const bool here = WordOf(id, WordOp::kPole)->index == static_cast<std::uint8_t>(PoleBase::kLastPosition);
      const std::optional<PlanePoint> base = here ? StartOfPlane(id, in) : PoleOf(id, in);
      if (!base) return std::nullopt;
      pole = *base;
      break;
    }
  }
  const double unit = UnitFactor(flow_.At(program_, id));
  const Word* angle = WordOf(id, WordOp::kPolarAngle);
  const Word* radius = WordOf(id, WordOp::kPolarRadius);
  if (angle != nullptr || radius != nullptr) {
    return PolarPoint(module_, pole, radius == nullptr ? LinearForm{} : ScaledForm(radius->value, unit),
                      angle == nullptr ? LinearForm{} : FormOf(module_, angle->value));
  }
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const Word* word = WordFor(id, axis);
    if (word == nullptr) continue;
    LinearForm& coordinate = axis == plane.first ? pole.u : pole.v;
    coordinate = Sum(module_, coordinate, ScaledForm(word->value, unit));
  }
  return pole;
}

bool DimensionPass::LowerPolar(BlockId id, const Slots& in, std::vector<Word>& words) {
  const PlaneWords& plane = PlaneAt(id);
  const Word* radius = WordOf(id, WordOp::kPolarRadius);
  const Word polar = radius != nullptr ? *radius : *WordOf(id, WordOp::kPolarAngle);
  const Motion motion = flow_.At(program_, id).motion;
  if (motion != Motion::kRapid && motion != Motion::kLinear && !IsPlaneArc(motion))
    return Refuse(id, polar, "polar words of a motion that is neither straight nor an arc");
  if (WordOf(id, WordOp::kOpeningAngle) != nullptr || WordOf(id, WordOp::kTurns) != nullptr ||
      WordOf(id, WordOp::kMachineCoords) != nullptr)
    return Refuse(id, polar, "polar words beside an opening angle, turns or machine coordinates");
  if (WordFor(id, plane.first) != nullptr || WordFor(id, plane.second) != nullptr)
    return Refuse(id, polar, "polar words beside axis words of the plane");
  if (radius != nullptr && !Within(id, *radius, 0, analysis::kInfinity))
    return Refuse(id, *radius, "a polar radius that may be negative",
                  "test it before, or declare its range in [ranges]");
  const std::optional<PlanePoint> end = PolarEnd(id, in);
  if (!end) {
    const std::string_view help =
        "write pole, angle and radius in this program before it, on every way that leads here";
    return Refuse(id, polar, "a polar end point whose pole, angle or radius is not known here", help);
  }
  std::optional<PlanePoint> center;
  if (PoleIsCenter(id)) {
    const std::optional<PlanePoint> start = StartOfPlane(id, in);
    const std::optional<PlanePoint> pole = PoleOf(id, in);
    if (!start) return Refuse(id, polar, "an arc about the pole whose start point is not known");
    center = PlanePoint{Sum(module_, pole->u, start->u, -1), Sum(module_, pole->v, start->v, -1)};
  }
  DropWords(words, WordOp::kPolarAngle);
  DropWords(words, WordOp::kPolarRadius);
  AddAxes(plane, *end, words);
  if (center) AddCenters(plane, *center, words);
  return true;
}

/// The pole is in the end points now.
void DimensionPass::RemovePole(BlockId id, const Slots& in) {
  const PlaneWords& plane = PlaneAt(id);
  const Word pole = *WordOf(id, WordOp::kPole);
  std::vector<Word> kept;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    switch (word.op) {
      case WordOp::kPole:
      case WordOp::kPolarAngle:
      case WordOp::kPolarRadius:
        break;
      case WordOp::kAxis:
        if (word.index == source_.transverse_axis && flow_.At(program_, id).diameter != Diameter::kRadius) {
          Refuse(id, pole, "a pole in an axis that is programmed as diameter");
          return;
        }
        break;
      default:
        kept.push_back(word);
    }
  }
  if (plane.plane == Plane::kUnknown || (in[0].kind != SlotValue::Kind::kNoWay && !NewPole(id, in))) {
    Refuse(id, pole, "a pole whose plane or base is not known here");
    return;
  }
  rewritten_.emplace_back(id, std::move(kept));
}

}  // namespace ncport::ir::transform
