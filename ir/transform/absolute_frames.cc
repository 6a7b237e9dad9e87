// Programmable frames: positions seen from a new frame, and moves under it in the coordinates of the workpiece (part of
// absolute_dimensions.h).
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/transform/dimension_pass.h"

namespace ncport::ir::transform {

namespace {

bool Sided(CutterComp comp) { return comp == CutterComp::kLeft || comp == CutterComp::kRight; }

/// Only turns by right angles, mirrors and whole factors.
bool KeepsDecimals(const FrameMatrix& matrix) {
  for (const auto& row : matrix.at) {
    for (const double value : row) {
      if (value != std::round(value)) return false;
    }
  }
  return true;
}

bool Mirrored(const FrameState& state, Plane plane) {
  const auto [first, second, normal] = AxesOf(plane);
  const std::optional<PlaneImage> image = ImageOf(state.matrix, first, second);
  return image && image->mirrored;
}

}  // namespace

const Word* DimensionPass::FrameWord(BlockId id) const {
  if (!frames_.Any()) return nullptr;
  const Word* word = WordOf(id, WordOp::kFrame);
  return word != nullptr && word->index < static_cast<std::uint8_t>(FrameOp::kLocalShift) ? word : nullptr;
}

Step DimensionPass::ShiftStep(BlockId id, Slot) const {
  const Word* frame = FrameWord(id);
  if (frame == nullptr) return Step::kNone;
  switch (static_cast<FrameOp>(frame->index)) {
    case FrameOp::kAddTranslate:
      return WordOf(id, WordOp::kAxis) != nullptr ? Step::kComputed : Step::kNone;
    case FrameOp::kAddRotate:
    case FrameOp::kAddScale:
    case FrameOp::kAddMirror:
      return Step::kNone;
    default:
      return Step::kComputed;
  }
}

SlotMask DimensionPass::MovedLinear(BlockId id) const {
  if (WordOf(id, WordOp::kFrame) != nullptr || WordOf(id, WordOp::kMachineCoords) != nullptr ||
      WordOf(id, WordOp::kReference) != nullptr || WordOf(id, WordOp::kPole) != nullptr)
    return 0;
  SlotMask moved = 0;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    if (word.op == WordOp::kAxis && word.index < 3) moved |= MaskOf(word.index);
  }
  const PlaneWords& plane = PlaneAt(id);
  if (plane.kind == PlaneWords::Kind::kPolar || plane.kind == PlaneWords::Kind::kOpeningCenter)
    moved |= MaskOf(plane.first) | MaskOf(plane.second);
  return moved;
}

bool DimensionPass::UsesForFrame(BlockId id, Slot slot) const {
  if (!config_.work_frames_in || !frames_.Any()) return false;
  const bool shift = slot >= kShift;
  if (!shift && slot >= 3) return false;
  const SlotMask moved = MovedLinear(id);
  const FrameState state = frames_.Before(id);
  if (moved == 0 || state.untouched || state.kind != FrameState::Kind::kKnown) return false;
  if (!shift && WordOf(id, WordOp::kRadius) != nullptr && !KeepsDecimals(state.matrix)) return true;
  if (state.matrix.IsDiagonal()) return shift && ((moved >> (slot - kShift)) & 1U) != 0;
  if (shift) return true;
  // An axis that the block names, or that the frame ties to none that moves, may stand anywhere.
  if (AxisStep(id, slot) == Step::kAbsolute) return false;
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    const bool tied = axis == slot || state.matrix.at[axis][slot] != 0 || state.matrix.at[slot][axis] != 0;
    if (tied && axis != slot && ((moved >> axis) & 1U) != 0) return true;
  }
  return (moved >> slot & 1U) != 0;
}

SlotMask DimensionPass::LiveThroughFrame(BlockId id, SlotMask behind) const {
  const Word* frame = FrameWord(id);
  if (frame == nullptr) return 0;
  SlotMask live = 0;
  if ((behind & kLinearSlots) != 0) {
    const bool diagonal = frames_.Before(id).matrix.IsDiagonal() && frames_.After(program_, id).matrix.IsDiagonal();
    live |= (diagonal ? behind & kLinearSlots : kLinearSlots) | kShiftSlots;
  }
  if ((behind & kShiftSlots) != 0 && ShiftStep(id, kShift) == Step::kComputed &&
      static_cast<FrameOp>(frame->index) == FrameOp::kAddTranslate)
    live |= behind & kShiftSlots;
  return live;
}

bool DimensionPass::LosesUnderFrame(BlockId id, std::uint8_t axis) const {
  if (!frames_.Any() || axis >= 3) return false;
  if (WordOf(id, WordOp::kMachineCoords) == nullptr && WordOf(id, WordOp::kReference) == nullptr) return false;
  const FrameState state = frames_.Before(id);
  return state.kind == FrameState::Kind::kUnknown || !state.matrix.IsDiagonal();
}

std::optional<LinearForm> DimensionPass::ShiftBefore(BlockId id, std::uint8_t axis, const Slots& in) const {
  if (frames_.Before(id).untouched) return LinearForm{};
  if (!in[kShift + axis].Known()) return std::nullopt;
  return in[kShift + axis].form;
}

std::optional<LinearForm> DimensionPass::NewShift(BlockId id, std::uint8_t axis, const Slots& in) {
  const auto op = static_cast<FrameOp>(FrameWord(id)->index);
  if (op != FrameOp::kTranslate && op != FrameOp::kAddTranslate) {
    const bool adds = op > FrameOp::kAddTranslate && op <= FrameOp::kAddMirror;
    return adds ? ShiftBefore(id, axis, in) : LinearForm{};
  }
  const ModalState state = flow_.At(program_, id);
  const FrameState before = frames_.Before(id);
  LinearForm shift;
  if (op == FrameOp::kAddTranslate) {
    const std::optional<LinearForm> old = ShiftBefore(id, axis, in);
    if (!old || before.kind != FrameState::Kind::kKnown) return std::nullopt;
    shift = *old;
  }
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    if (word.op != WordOp::kAxis || word.index >= 3) continue;
    const double factor = op == FrameOp::kAddTranslate ? before.matrix.at[axis][word.index]
                          : word.index == axis         ? 1
                                                       : 0;
    const bool diameter = word.index == source_.transverse_axis && source_.frame_shift_in_diameter &&
                          (state.diameter == Diameter::kDiameter || state.diameter == Diameter::kDiameterAbsolute);
    if (factor != 0)
      shift = Sum(module_, shift, FormOf(module_, word.value), factor * UnitFactor(state) * (diameter ? 0.5 : 1));
  }
  return shift;
}

/// No axis moves when the frame changes: the same point has other coordinates.
std::optional<LinearForm> DimensionPass::SeenFromNewFrame(BlockId id, std::uint8_t axis, const Slots& in) {
  const FrameState before = frames_.Before(id);
  const FrameState after = frames_.After(program_, id);
  if (before.kind != FrameState::Kind::kKnown || after.kind != FrameState::Kind::kKnown) return std::nullopt;
  const std::optional<FrameMatrix> inverse = after.matrix.Inverse();
  if (!inverse) return std::nullopt;
  const FrameMatrix turn = inverse->Times(before.matrix);
  LinearForm seen;
  for (std::uint8_t column = 0; column < 3; ++column) {
    const double old = turn.at[axis][column];
    if (old != 0) {
      if (!in[column].Known()) return std::nullopt;
      seen = Sum(module_, seen, AsRadius(column, in[column].form), old);
    }
    const double shifted = inverse->at[axis][column];
    if (shifted == 0) continue;
    const std::optional<LinearForm> from = ShiftBefore(id, column, in);
    const std::optional<LinearForm> to = NewShift(id, column, in);
    if (!from || !to) return std::nullopt;
    seen = Sum(module_, seen, Sum(module_, *from, *to, -1), shifted);
  }
  return AsTarget(axis, seen);
}

/// Whether some frame of the program turns the sense of arcs.
void DimensionPass::FindSenses() {
  names_senses_ = false;
  if (!config_.work_frames_in || !frames_.Any()) return;
  for (const BlockId id : blocks_)
    names_senses_ = names_senses_ || Mirrored(frames_.Before(id), flow_.At(program_, id).plane);
}

/// The frame is in the coordinates of what follows.
void DimensionPass::RemoveFrame(BlockId id) {
  const Word frame = *FrameWord(id);
  const std::string_view trouble = frames_.Trouble(program_, id);
  if (!trouble.empty()) {
    Refuse(id, frame, trouble);
    return;
  }
  const ModalState state = flow_.At(program_, id);
  const FrameState before = frames_.Before(id), after = frames_.After(program_, id);
  if (state.comp != CutterComp::kOff &&
      (before.kind == FrameState::Kind::kUnknown || Mirrored(before, state.plane) != Mirrored(after, state.plane))) {
    Refuse(id, frame, "a mirror of the frame while cutter compensation may be on");
    return;
  }
  std::vector<Word> kept;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    if (word.op != WordOp::kFrame && word.op != WordOp::kFrameAngle && word.op != WordOp::kFrameFactor &&
        word.op != WordOp::kAxis)
      kept.push_back(word);
  }
  rewritten_.emplace_back(id, std::move(kept));
}

/// The axes that the words of the block reach through the frame, in place of its own words.
bool DimensionPass::FramedAxes(BlockId id, const Slots& in, const FrameMatrix& matrix, std::vector<Word>& words) {
  std::array<std::optional<LinearForm>, 3> named;
  std::size_t place = words.size();
  Word model;
  for (std::size_t i = 0; i < words.size();) {
    if (words[i].op != WordOp::kAxis || words[i].index >= 3) {
      ++i;
      continue;
    }
    model = words[i];
    place = std::min(place, i);
    named[model.index] = AsRadius(model.index, FormOf(module_, model.value));
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
  }
  for (std::uint8_t row = 0; row < 3; ++row) {
    bool reached = false;
    for (std::uint8_t column = 0; column < 3; ++column)
      reached = reached || (named[column] && matrix.at[row][column] != 0);
    if (!reached) continue;
    const std::optional<LinearForm> shift = ShiftBefore(id, row, in);
    if (!shift) return Refuse(id, model, "a move under a shift of the frame that is not one value here");
    LinearForm value = *shift;
    for (std::uint8_t column = 0; column < 3; ++column) {
      const double factor = matrix.at[row][column];
      if (factor == 0) continue;
      if (!named[column] && !in[column].Known())
        return Refuse(id, model, "a move under a rotation while the position of another axis is not known",
                      "program all axes of the rotation once behind it, on every way that leads here");
      value = Sum(module_, value, named[column] ? *named[column] : AsRadius(column, in[column].form), factor);
    }
    model.op = WordOp::kAxis;
    model.index = row;
    model.mode = ValueMode::kAbsolute;
    model.value = ExprOf(module_, AsTarget(row, value));
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(place++), model);
  }
  return true;
}

bool DimensionPass::RadiusToCenter(BlockId id, const Slots& in, std::vector<Word>& words) {
  const ModalState state = flow_.At(program_, id);
  const auto [first, second, normal] = AxesOf(state.plane);
  const Word word = *WordOf(id, WordOp::kRadius);
  const LinearForm radius = FormOf(module_, std::ranges::find(words, WordOp::kRadius, &Word::op)->value);
  double way[2] = {};
  bool known = radius.IsConstant();
  for (const std::uint8_t axis : {first, second}) {
    const std::optional<LinearForm> end = EndOfAxis(id, axis, in);
    if (!end || !in[axis].Known()) {
      known = false;
      break;
    }
    const LinearForm form = Sum(module_, *end, AsRadius(axis, in[axis].form), -1);
    known = known && form.IsConstant();
    way[axis == first ? 0 : 1] = form.constant;
  }
  const std::optional<PlanePoint> center =
      known ? CenterByRadius(way[0], way[1], radius.constant, state.motion == Motion::kArcCw) : std::nullopt;
  if (!center)
    return Refuse(id, word, "an arc by its radius, from or to a computed point, under a frame that turns or scales it",
                  "write the arc with its centre");
  std::erase_if(words, [](const Word& each) { return each.op == WordOp::kRadius; });
  PlaneWords plane;
  plane.first = first;
  plane.second = second;
  AddCenters(plane, *center, words);
  return true;
}

void DimensionPass::FramedCenters(const FrameMatrix& matrix, std::uint8_t first, std::uint8_t second,
                                  std::vector<Word>& words) {
  LinearForm center[3];
  std::size_t place = words.size();
  Word model;
  for (std::size_t i = 0; i < words.size();) {
    if (words[i].op != WordOp::kCenter) {
      ++i;
      continue;
    }
    model = words[i];
    place = std::min(place, i);
    center[model.index] = FormOf(module_, model.value);
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
  }
  for (const std::uint8_t axis : {std::min(first, second), std::max(first, second)}) {
    const auto& row = matrix.at[axis];
    model.index = axis;
    model.mode = ValueMode::kStep;
    model.value =
        ExprOf(module_, Sum(module_, Sum(module_, {}, center[first], row[first]), center[second], row[second]));
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(place++), model);
  }
}

/// The words of a block, absolute and in the system of the program, as the frame in force makes them.
bool DimensionPass::ApplyFrame(BlockId id, const Slots& in, std::vector<Word>& words) {
  const FrameState frame = frames_.Before(id);
  if (frame.kind == FrameState::Kind::kNoWay) return true;
  const ModalState state = flow_.At(program_, id);
  Motion motion = state.motion;
  const Word* first_move = nullptr;
  bool linear = false, center = false, sized = false, cycle = false, computed = false, comp = false;
  for (const Word& word : words) {
    const bool moves = (word.op == WordOp::kAxis && word.index < 3) || word.op == WordOp::kCenter ||
                       word.op == WordOp::kRadius || word.op == WordOp::kAxisComputed ||
                       (word.op == WordOp::kCutterComp && Sided(static_cast<CutterComp>(word.index)));
    if (moves && first_move == nullptr) first_move = &word;
    linear = linear || (word.op == WordOp::kAxis && word.index < 3);
    center = center || word.op == WordOp::kCenter;
    sized = sized || word.op == WordOp::kRadius || word.op == WordOp::kChamfer;
    cycle = cycle || word.op == WordOp::kCycleValue || word.op == WordOp::kCycle;
    computed = computed || word.op == WordOp::kAxisComputed;
    comp = comp || word.op == WordOp::kCutterComp;
    // A piece of the block may move in another way than the block itself.
    if (word.op == WordOp::kMotion) motion = static_cast<Motion>(word.index);
  }
  if (first_move == nullptr) return true;
  const Word at = *first_move;
  if (frame.kind == FrameState::Kind::kUnknown)
    return Refuse(id, at, "a move under a frame that is not the same on every way that leads here",
                  "set the frame in the program that moves, and take it back before its end");
  const bool arc = IsPlaneArc(motion) && (linear || center);
  const auto [first, second, normal] = AxesOf(state.plane);
  const std::optional<PlaneImage> image = ImageOf(frame.matrix, first, second);
  if (!frame.untouched) {
    const bool other = (motion >= Motion::kThread && motion <= Motion::kProbe) || computed || cycle;
    if (other && !(frame.matrix.IsIdentity() && !computed && !cycle))
      return Refuse(id, at, "a thread, probing, cycle or computed axis under a frame");
    if ((arc || center || sized || comp || Sided(state.comp)) && !image)
      return Refuse(id, at,
                    "an arc, corner or compensated move under a frame that tilts its plane or scales it unevenly");
    if (arc && !KeepsDecimals(frame.matrix) && WordOf(id, WordOp::kRadius) != nullptr) {
      if (!RadiusToCenter(id, in, words)) return false;
      center = true;
    }
    if (!FramedAxes(id, in, frame.matrix, words)) return false;
    if (arc && center) FramedCenters(frame.matrix, first, second, words);
    for (Word& word : words) {
      if (word.op == WordOp::kRadius || word.op == WordOp::kChamfer) word.value = Scaled(word.value, image->scale);
      if (word.op == WordOp::kCutterComp && image->mirrored && Sided(static_cast<CutterComp>(word.index)))
        word.index = static_cast<std::uint8_t>(
            static_cast<CutterComp>(word.index) == CutterComp::kLeft ? CutterComp::kRight : CutterComp::kLeft);
    }
  }
  if (!arc || !names_senses_) return true;
  std::erase_if(words, [](const Word& word) { return word.op == WordOp::kMotion; });
  const bool clockwise = (motion == Motion::kArcCw) != (!frame.untouched && image->mirrored);
  words.insert(words.begin(), MakeWord(WordOp::kMotion, clockwise ? Motion::kArcCw : Motion::kArcCcw));
  return true;
}

}  // namespace ncport::ir::transform
