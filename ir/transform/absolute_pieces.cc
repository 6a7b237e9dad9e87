// Blocks that become several: additional full turns and corners (part of absolute_dimensions.h).
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/make_word.h"
#include "ir/transform/dimension_pass.h"

namespace ncport::ir::transform {

namespace {

constexpr double kSmall = 1e-9;
constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr double kMostTurns = 99;  // that are written out

Word MotionWord(Motion motion) { return MakeWord(WordOp::kMotion, motion); }

void NameMotion(std::vector<Word>& words, Motion motion) {
  if (std::ranges::find(words, WordOp::kMotion, &Word::op) == words.end())
    words.insert(words.begin(), MotionWord(motion));
}

/// Words that act behind the motion stay with its last piece.
bool ActsBehind(const Word& word) {
  return word.phase == Phase::kAfter || word.phase == Phase::kFlow || word.phase == Phase::kLast;
}

}  // namespace

void DimensionPass::Insert(BlockId id, const std::vector<Word>& words, bool before) {
  if (!before) return editor_->PutBehind(id, words);
  editor_->PutInFront(id, words);
}

/// sinumerik-8.3: the full turns come first, the other axes run evenly over the whole angle.
bool DimensionPass::LowerTurns(BlockId id, const Slots& in, std::vector<Word>& words,
                               std::vector<std::vector<Word>>& before) {
  const Word turns = *WordOf(id, WordOp::kTurns);
  const ModalState state = flow_.At(program_, id);
  const LinearForm form = FormOf(module_, turns.value);
  if (!IsPlaneArc(state.motion) || state.plane == Plane::kUnknown || WordOf(id, WordOp::kCenter) == nullptr ||
      WordOf(id, WordOp::kRadius) != nullptr || WordOf(id, WordOp::kWhen) != nullptr)
    return Refuse(id, turns, "additional turns of an arc without centre words");
  if (!form.IsConstant() || form.constant < 0 || form.constant > kMostTurns)
    return Refuse(id, turns, "a computed or very large number of additional turns");
  const int count = static_cast<int>(std::lround(form.constant));
  std::erase_if(words, [](const Word& word) { return word.op == WordOp::kTurns; });
  if (count == 0) return true;

  const std::uint8_t first = state.plane == Plane::kZX ? 2 : state.plane == Plane::kYZ ? 1 : 0;
  const std::uint8_t second = state.plane == Plane::kZX ? 0 : state.plane == Plane::kYZ ? 2 : 1;
  // The angle of the last part, from the centre as the start sees it.
  LinearForm center[3];
  bool along = false;
  for (const Word& word : words) {
    if (word.op == WordOp::kCenter) center[word.index] = FormOf(module_, word.value);
    along = along || (word.op == WordOp::kAxis && word.index != first && word.index != second);
  }
  double sweep = 360;
  if (along) {
    const std::optional<LinearForm> end_u = EndOfAxis(id, first, in), end_v = EndOfAxis(id, second, in);
    if (!end_u || !end_v || !in[first].Known() || !in[second].Known())
      return Refuse(id, turns, "additional turns of a helix whose start point is not known");
    const LinearForm way_u = Sum(module_, *end_u, AsRadius(first, in[first].form), -1);
    const LinearForm way_v = Sum(module_, *end_v, AsRadius(second, in[second].form), -1);
    const LinearForm& u = center[first];
    const LinearForm& v = center[second];
    if (!way_u.IsConstant() || !way_v.IsConstant() || !u.IsConstant() || !v.IsConstant())
      return Refuse(id, turns, "additional turns of a helix whose angle is computed");
    if (std::hypot(way_u.constant, way_v.constant) > kSmall) {
      const double from = std::atan2(-v.constant, -u.constant);
      const double to = std::atan2(way_v.constant - v.constant, way_u.constant - u.constant);
      sweep = (state.motion == Motion::kArcCw ? from - to : to - from) * kDegrees;
      if (sweep <= 0) sweep += 360;
    }
  }
  const double whole = 360.0 * count + sweep;
  for (int turn = 1; turn <= count; ++turn) {
    std::vector<Word> circle;
    for (const Word& word : words) {
      if (word.op == WordOp::kAxis) {
        if (word.index == first || word.index == second) continue;
        if (!in[word.index].Known())
          return Refuse(id, turns, "additional turns of a helix whose start point is not known");
        const LinearForm& start = in[word.index].form;
        const LinearForm way = Sum(module_, FormOf(module_, word.value), start, -1);
        Word share = word;
        share.value = ExprOf(module_, Sum(module_, start, way, 360.0 * turn / whole));
        circle.push_back(share);
      } else if (word.op == WordOp::kCenter || word.op == WordOp::kMotion || (turn == 1 && !ActsBehind(word))) {
        circle.push_back(word);
      }
    }
    NameMotion(circle, state.motion);
    before.push_back(std::move(circle));
  }
  std::erase_if(words, [](const Word& word) {
    return word.op != WordOp::kAxis && word.op != WordOp::kCenter && word.op != WordOp::kMotion && !ActsBehind(word);
  });
  NameMotion(words, state.motion);
  return true;
}

bool DimensionPass::CornerMoves(BlockId id) const {
  using Corners = AbsoluteDimensionsConfig::Corners;
  const Word* chamfer = config_.corners_to_moves == Corners::kNone ? nullptr : WordOf(id, WordOp::kChamfer);
  return chamfer != nullptr && (config_.corners_to_moves == Corners::kAll ||
                                static_cast<ChamferKind>(chamfer->index) == ChamferKind::kLength);
}

std::optional<PlanePoint> DimensionPass::NextWay(BlockId id, const PlanePoint& corner) {
  const ModalState state = flow_.At(program_, id);
  const std::uint8_t first = state.plane == Plane::kZX ? 2 : state.plane == Plane::kYZ ? 1 : 0;
  const std::uint8_t second = state.plane == Plane::kZX ? 0 : state.plane == Plane::kYZ ? 2 : 1;
  if (state.motion != Motion::kLinear || module_.blocks[id].skip_level != Block::kNoSkip) return std::nullopt;
  PlanePoint way;
  bool moves = false;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    switch (word.op) {
      case WordOp::kAxis: {
        if (word.index != first && word.index != second) return std::nullopt;
        const Scale scale = ScaleOf(word, word.index, state, id, false);
        if (!scale.known) return std::nullopt;
        const LinearForm named = AsRadius(word.index, ScaledForm(word.value, scale.factor));
        const LinearForm& from = word.index == first ? corner.u : corner.v;
        (word.index == first ? way.u : way.v) = scale.incremental ? named : Sum(module_, named, from, -1);
        moves = true;
        break;
      }
      case WordOp::kMotion:
      case WordOp::kDistance:
      case WordOp::kChamfer:
        break;
      default:
        return std::nullopt;
    }
  }
  if (!moves || !way.u.IsConstant() || !way.v.IsConstant()) return std::nullopt;
  return way;
}

bool DimensionPass::LowerCorner(BlockId id, const Slots& in, std::vector<Word>& words,
                                std::vector<std::vector<Word>>& after) {
  const Word chamfer = *WordOf(id, WordOp::kChamfer);
  const ModalState state = flow_.At(program_, id);
  PlaneWords plane;
  plane.plane = state.plane;
  plane.first = state.plane == Plane::kZX ? 2 : state.plane == Plane::kYZ ? 1 : 0;
  plane.second = state.plane == Plane::kZX ? 0 : state.plane == Plane::kYZ ? 2 : 1;
  const LinearForm size = FormOf(module_, std::ranges::find(words, WordOp::kChamfer, &Word::op)->value);  // in mm there
  constexpr std::string_view kHelp = "write the corner as moves of its own";
  BlockId next;
  for (std::uint32_t i = IndexOf(id) + 1; i < blocks_.count && !next.Valid(); ++i) {
    if (!module_.blocks[blocks_[i]].words.Empty()) next = blocks_[i];
  }
  const std::optional<LinearForm> end_u = EndOfAxis(id, plane.first, in), end_v = EndOfAxis(id, plane.second, in);
  if (state.motion != Motion::kLinear || state.plane == Plane::kUnknown || !end_u || !end_v || !next.Valid() ||
      !in[plane.first].Known() || !in[plane.second].Known() || !size.IsConstant() || size.constant < 0)
    return Refuse(id, chamfer, "a corner whose sides or size are not known here", kHelp);
  const PlanePoint corner{*end_u, *end_v};
  const PlanePoint way{Sum(module_, *end_u, AsRadius(plane.first, in[plane.first].form), -1),
                       Sum(module_, *end_v, AsRadius(plane.second, in[plane.second].form), -1)};
  const std::optional<PlanePoint> out = NextWay(next, corner);
  if (!out || !way.u.IsConstant() || !way.v.IsConstant())
    return Refuse(id, chamfer, "a corner whose sides or size are not known here", kHelp);
  const double length_in = std::hypot(way.u.constant, way.v.constant);
  const double length_out = std::hypot(out->u.constant, out->v.constant);
  if (length_in <= kSmall || length_out <= kSmall)
    return Refuse(id, chamfer, "a corner at a side without length", kHelp);
  const double in_u = way.u.constant / length_in, in_v = way.v.constant / length_in;
  const double out_u = out->u.constant / length_out, out_v = out->v.constant / length_out;
  const double sine = in_u * out_v - in_v * out_u, cosine = in_u * out_u + in_v * out_v;
  std::erase_if(words, [](const Word& word) { return word.op == WordOp::kChamfer; });
  if (size.constant == 0 || (std::fabs(sine) <= kSmall && cosine >= 0)) return true;  // no corner there
  if (std::fabs(sine) <= kSmall)
    return Refuse(id, chamfer, "a corner between sides that run back on each other", kHelp);
  const auto kind = static_cast<ChamferKind>(chamfer.index);
  const bool round = kind == ChamferKind::kRound;
  // Half of the change of direction: its tangent for a rounding, the sine of the inner half angle for a length.
  const double cut = round                          ? size.constant * std::fabs(sine) / (1 + cosine)
                     : kind == ChamferKind::kLength ? size.constant / (2 * std::sqrt((1 + cosine) / 2))
                                                    : size.constant;
  const auto taken = cut_.find(id.value);
  if (cut + (taken == cut_.end() ? 0 : taken->second) > length_in + kSmall || cut > length_out + kSmall)
    return Refuse(id, chamfer, "a corner that is longer than its side", kHelp);
  cut_[next.value] = cut;
  const PlanePoint start{Sum(module_, corner.u, {in_u, {}}, -cut), Sum(module_, corner.v, {in_v, {}}, -cut)};
  const PlanePoint end{Sum(module_, corner.u, {out_u, {}}, cut), Sum(module_, corner.v, {out_v, {}}, cut)};
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const bool is_first = axis == plane.first;
    if ((is_first ? in_u : in_v) == 0) continue;
    const auto word =
        std::ranges::find_if(words, [&](const Word& each) { return each.op == WordOp::kAxis && each.index == axis; });
    if (word != words.end()) word->value = ExprOf(module_, AsTarget(axis, is_first ? start.u : start.v));
  }
  std::vector<Word> piece{MotionWord(!round ? Motion::kLinear : sine < 0 ? Motion::kArcCw : Motion::kArcCcw)};
  AddAxes(plane, end, piece);
  if (round) {
    const double side = sine > 0 ? size.constant : -size.constant;  // to the left of the way in
    AddCenters(plane, {{-in_v * side + 0.0, {}}, {in_u * side + 0.0, {}}}, piece);
  }
  after.push_back(std::move(piece));
  return true;
}

}  // namespace ncport::ir::transform
