#include "check/comp_flow.h"

#include "check/motion_words.h"
#include "ir/plane_axes.h"

namespace ncport::check {
namespace {

using ir::CutterComp;
using ir::Motion;
using ir::WordOp;

/// Moves to other places, a new tool, cycles: whether one of them begins the compensation is not known.
bool MovesOtherwise(WordOp op) {
  switch (op) {
    case WordOp::kAxisComputed:
    case WordOp::kReference:
    case WordOp::kMachineCoords:
    case WordOp::kCycle:
    case WordOp::kTool:
    case WordOp::kToolChange:
      return true;
    default:
      return false;
  }
}

bool IsStraight(Motion motion) { return motion == Motion::kLinear || motion == Motion::kRapid; }

}  // namespace

bool EndsCompensation(const ir::Word& comp) { return static_cast<CutterComp>(comp.index) == CutterComp::kOff; }

CompFlow::CompFlow(const Subject& subject)
    : subject_(subject),
      module_(subject.module),
      flow_({subject.module, subject.machine, subject.graphs, subject.calls, &subject.modal}, *this) {
  flow_.Run();
}

const ir::Word* CompFlow::Switch(ir::BlockId block) const {
  const ir::Word* found = nullptr;
  for (const ir::WordId id : module_.blocks[block].words) {
    if (module_.words[id].op == WordOp::kCutterComp) found = &module_.words[id];
  }
  return found;
}

CompState CompFlow::Entry(ir::ProgramId program) const {
  switch (subject_.modal.Entry(program).comp) {
    case CutterComp::kOff:
      return {CompState::kOff, {}};
    case CutterComp::kLeft:
    case CutterComp::kRight:
      return {CompState::kBegun, {}};
    default:
      return {CompState::kAnything, {}};
  }
}

bool CompFlow::Join(ir::BlockId, State& into, const State& from) {
  const State old = into;
  into.ways |= from.ways;
  if (from.switched.Valid() && (!into.switched.Valid() || from.switched.value < into.switched.value))
    into.switched = from.switched;
  return into.ways != old.ways || into.switched != old.switched;
}

CompState CompFlow::At(ir::BlockId block, const CompState& before) const {
  CompState state = before;
  bool anything = (module_.blocks[block].flags & ir::Block::kRefused) != 0;
  for (const ir::WordId word : module_.blocks[block].words)
    anything = anything || MayDoAnything(module_, module_.words[word]);
  if (anything) state.ways |= CompState::kAnything;
  const ir::Word* word = Switch(block);
  if (word == nullptr) return state;
  if (EndsCompensation(*word)) return {CompState::kOff, {}};
  if ((state.ways & CompState::kOff) == 0) return state;
  state.ways = static_cast<std::uint8_t>((state.ways & ~CompState::kOff) | CompState::kSwitchedOn);
  if (!state.switched.Valid() || block.value < state.switched.value) state.switched = block;
  return state;
}

bool CompFlow::MovesInPlane(ir::ProgramId program, ir::BlockId id) const {
  const ir::Block& block = module_.blocks[id];
  const ir::ModalState modes = subject_.modal.At(program, id);
  if (ArcWord(module_, block, modes.motion) != nullptr) return true;
  if (!IsStraight(modes.motion) || MovingWord(module_, block) == nullptr) return false;
  if (modes.plane == ir::Plane::kUnknown) return false;
  const std::uint8_t normal = ir::AxesOf(modes.plane).normal;
  for (const ir::WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    const bool polar = word.op == WordOp::kPolarRadius || word.op == WordOp::kPolarAngle;
    if (polar || (word.op == WordOp::kAxis && word.index < 3 && word.index != normal)) return true;
  }
  return false;
}

void CompFlow::Transfer(ir::ProgramId program, ir::BlockId id, State& state) const {
  state = At(id, state);
  if ((state.ways & CompState::kSwitchedOn) == 0) return;
  const ir::Block& block = module_.blocks[id];
  const ir::ModalState modes = subject_.modal.At(program, id);
  const bool begins = MovesInPlane(program, id);
  bool anything = !begins && MovingWord(module_, block) != nullptr &&
                  (!IsStraight(modes.motion) || modes.plane == ir::Plane::kUnknown);
  for (const ir::WordId word : block.words) anything = anything || MovesOtherwise(module_.words[word].op);
  if (begins) state.ways = static_cast<std::uint8_t>((state.ways & ~CompState::kSwitchedOn) | CompState::kBegun);
  if (anything) state.ways |= CompState::kAnything;
}

}  // namespace ncport::check
