// Positions across calls (part of absolute_dimensions.h): an increment of a subprogram starts where its caller stands,
// and goes on from there behind the call. Callers put the position into a cell of its own (AT_X) in front of the call,
// subprograms put it back in front of their end: a call with repeats then goes on by itself.
#include <fmt/format.h>

#include "ir/axis_names.h"
#include "ir/transform/dimension_pass.h"
#include "ir/word_values.h"

namespace ncport::ir::transform {

namespace {

bool Leaves(analysis::EdgeKind kind) {
  return kind == analysis::EdgeKind::kReturn || kind == analysis::EdgeKind::kReturnToTarget ||
         kind == analysis::EdgeKind::kTextEnd;
}

}  // namespace

bool DimensionPass::TriggersModal(ProgramId program, BlockId id) const {
  if (!flow_.ModalCallPossible(program, id)) return false;
  for (const WordId word : module_.blocks[id].words) {
    if (DefaultPhaseOf(module_.words[word].op) == Phase::kMotion) return true;
  }
  return false;
}

/// What runs behind each call moves and writes.
void DimensionPass::FindEffects() {
  effects_.assign(module_.programs.Size(), {});
  bool changed = true;
  while (changed) {
    changed = false;
    for (const Word& word : module_.words.All()) {
      if (word.op != WordOp::kModalCall || !word.Extra<CallId>().Valid()) continue;
      const ProgramId runs = module_.calls[word.Extra<CallId>()].program;
      const Effects below = runs.Valid() ? effects_[runs.value] : Effects{kAllSlots, true, true};
      modal_.slots |= below.slots;
      modal_.writes_shared = modal_.writes_shared || below.writes_shared;
      modal_.reframes = modal_.reframes || below.reframes;
    }
    for (const ProgramId program : module_.programs.Ids()) {
      Effects now = effects_[program.value];
      for (const BlockId block : module_.programs[program].blocks) {
        if (TriggersModal(program, block)) {
          now.slots |= modal_.slots;
          now.writes_shared = now.writes_shared || modal_.writes_shared;
          now.reframes = now.reframes || modal_.reframes;
        }
        for (const WordId id : module_.blocks[block].words) {
          const Word& word = module_.words[id];
          if (word.op == WordOp::kAxis) now.slots |= MaskOf(word.index);
          if (word.op == WordOp::kAxisComputed || word.op == WordOp::kOpeningAngle)
            now.slots |= kAllSlots & ~kPolarSlots;
          if (word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius || word.op == WordOp::kPole)
            now.slots = kAllSlots;
          if (word.op == WordOp::kPlane) now.slots |= kPolarSlots;
          if (word.op == WordOp::kFrame) now.slots |= kLinearSlots | kShiftSlots;
          // The zero point moves: what the axes stand at are other numbers then.
          if (word.op == WordOp::kWorkOffset || word.op == WordOp::kPresetPosition) now.slots |= kAxisSlots;
          now.reframes = now.reframes || word.op == WordOp::kFrame || word.op == WordOp::kWorkOffset ||
                         word.op == WordOp::kPresetPosition;
          VisitPlaces(module_, word, [&](ExprId written) {
            const Expr& place = module_.exprs[written];
            const bool own = (place.op == ExprOp::kVariable || place.op == ExprOp::kElement) &&
                             module_.variables[VariableId{place.a}].owner == program &&
                             !module_.variables[VariableId{place.a}].by_reference;
            now.writes_shared = now.writes_shared || !own;
          });
          if (word.op == WordOp::kCall || word.op == WordOp::kModalCall) {
            const auto call = word.Extra<CallId>();
            if (!call.Valid()) continue;
            const ProgramId callee = module_.calls[call].program;
            const Effects below = callee.Valid() ? effects_[callee.value] : Effects{kAllSlots, true, true};
            now.slots |= below.slots;
            now.writes_shared = now.writes_shared || below.writes_shared;
            now.reframes = now.reframes || below.reframes;
          }
        }
      }
      Effects& known = effects_[program.value];
      if (now.slots != known.slots || now.writes_shared != known.writes_shared || now.reframes != known.reframes) {
        known = now;
        changed = true;
      }
    }
  }
}

/// Programs whose every call is here and runs the whole program at once.
void DimensionPass::FindPassable() {
  passable_.assign(module_.programs.Size(), 0);
  for (const analysis::CallSite& site : analyses_.Calls().AllSites()) {
    if (site.callee.Valid()) passable_[site.callee.value] = 1;
  }
  for (const analysis::CallSite& site : analyses_.Calls().AllSites()) {
    if (!site.callee.Valid()) {
      passable_.assign(passable_.size(), 0);  // it may run any program
      return;
    }
    const Call& call = module_.calls[site.call];
    const bool whole = !site.modal && call.form != CallForm::kBlockRange && !call.from_block;
    if (!whole || module_.programs[site.callee].kind == ProgramKind::kMain) passable_[site.callee.value] = 0;
  }
}

ExprId DimensionPass::CellAt(Slot axis) {
  if (!at_[axis].Valid()) {
    Space space;
    space.name = module_.strings.Intern(fmt::format("AT_{}", kAxisLetters[axis]));
    space.type = Type::kReal;
    space.lifetime = Lifetime::kProgram;
    space.start = StartValue::kUnknown;
    at_[axis] = module_.spaces.Add(space);
  }
  return make_.Cell(at_[axis], 0);
}

bool DimensionPass::ReadsCells(const LinearForm& form) const {
  bool reads = false;
  for (const LinearForm::Term& term : form.terms) {
    VisitReads(module_, term.atom, [&](ExprId id) {
      const Expr& read = module_.exprs[id];
      for (const SpaceId space : at_)
        reads = reads || (read.op == ExprOp::kCell && space.Valid() && read.a == space.value);
    });
  }
  return reads;
}

const Word* DimensionPass::PassableCall(BlockId block) const {
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op != WordOp::kCall || !word.Extra<CallId>().Valid()) continue;
    const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
    return callee.Valid() && passable_[callee.value] != 0 ? &word : nullptr;
  }
  return nullptr;
}

SlotMask DimensionPass::PassedAt(BlockId block) const {
  const Word* call = PassableCall(block);
  return call == nullptr ? 0 : passes_[module_.calls[call->Extra<CallId>()].program.value];
}

SlotMask DimensionPass::ReturnedAt(BlockId block) const {
  const Word* call = PassableCall(block);
  if (call == nullptr) return 0;
  const std::uint32_t callee = module_.calls[call->Extra<CallId>()].program.value;
  return returns_[callee] | (passes_[callee] & ~effects_[callee].slots);
}

SlotMask DimensionPass::LeftAt(BlockId block) const {
  for (const analysis::Edge& edge : analyses_.Graphs().Of(program_).Successors(block)) {
    if (!edge.to.Valid() && Leaves(edge.kind)) return returns_[program_.value];
  }
  return 0;
}

SlotMask DimensionPass::LiveBehind(BlockId block) const {
  SlotMask behind = LeftAt(block);
  for (const analysis::Edge& edge : analyses_.Graphs().Of(program_).Successors(block)) {
    if (edge.to.Valid()) behind |= live_[IndexOf(edge.to)];
  }
  return behind;
}

/// Which positions each program takes and gives back: those that somebody uses, in callers of callers too.
void DimensionPass::FindPassed() {
  passes_.assign(module_.programs.Size(), 0);
  returns_.assign(module_.programs.Size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    const auto add = [&](SlotMask& to, SlotMask slots) {
      changed = changed || (slots & ~to) != 0;
      to |= slots;
    };
    for (const ProgramId program : module_.programs.Ids()) {
      Enter(program);
      FindLive();
      if (passable_[program.value] != 0 && blocks_.count != 0)
        add(passes_[program.value], live_[0] & kAxisSlots & ~never_passed_[program.value]);
      for (const BlockId block : blocks_) {
        const Word* word = PassableCall(block);
        if (word == nullptr) continue;
        const Call& call = module_.calls[word->Extra<CallId>()];
        const std::uint32_t callee = call.program.value;
        SlotMask used = LiveBehind(block);
        if (call.passes.Valid()) used |= passes_[callee];
        // A zero point that moved below makes the positions numbers of another kind.
        if (!effects_[callee].reframes)
          add(returns_[callee], used & effects_[callee].slots & kAxisSlots & ~never_returned_[callee]);
      }
    }
  }
}

/// Takes back what some caller does not know, or some end of a program; true if there was something.
bool DimensionPass::DropUnknownPassed() {
  bool dropped = false;
  for (const ProgramId program : module_.programs.Ids()) {
    Enter(program);
    FindLive();
    Flow();
    for (std::uint32_t i = 0; i < blocks_.count; ++i) {
      if (in_[i][0].kind == SlotValue::Kind::kNoWay) continue;
      const SlotMask passed = PassedAt(blocks_[i]);
      const SlotMask left = LeftAt(blocks_[i]);
      if ((passed | left) == 0) continue;
      Slots slots = in_[i];
      unknown_left_ = 0;
      Through(blocks_[i], slots, false);
      if (passed != 0) {
        const std::uint32_t callee = module_.calls[PassableCall(blocks_[i])->Extra<CallId>()].program.value;
        for (Slot slot = 0; slot < kMaxAxes; ++slot) {
          if ((passed >> slot & 1U) == 0 || in_[i][slot].Known()) continue;
          never_passed_[callee] |= MaskOf(slot);
          unknown_callers_.try_emplace({callee, slot}, blocks_[i]);
          dropped = true;
        }
      }
      if (unknown_left_ != 0) {
        never_returned_[program.value] |= unknown_left_;
        dropped = true;
      }
    }
  }
  return dropped;
}

void DimensionPass::FindCallPositions() {
  held_.assign(module_.programs.Size(), {});
  never_passed_.assign(module_.programs.Size(), 0);
  never_returned_.assign(module_.programs.Size(), 0);
  FindPassable();
  do {
    FindPassed();
  } while (DropUnknownPassed());
}

CarriedPositions DimensionPass::Carried() const {
  CarriedPositions carried;
  SlotMask used = 0;
  for (const ProgramId program : module_.programs.Ids()) {
    const SlotMask slots = passes_[program.value] | returns_[program.value];
    used |= slots;
    if (slots != 0) carried.programs.push_back(program);
  }
  for (Slot axis = 0; axis < kMaxAxes; ++axis) {
    if ((used >> axis & 1U) != 0 && at_[axis].Valid()) carried.cells.push_back(at_[axis]);
  }
  return carried;
}

/// In front of a call the positions go to their cells.
void DimensionPass::PassPositions(BlockId id, Slots& slots, bool emit) {
  SlotMask passed = PassedAt(id);
  if (Conditional(module_.blocks[id])) passed |= ReturnedAt(id);  // where the call is skipped the cells hold them too
  PutPositions(id, passed, slots, true, emit);
}

/// In front of the end of the program likewise.
void DimensionPass::LeavePositions(BlockId id, Slots& slots, bool emit) {
  const SlotMask left = LeftAt(id);
  if (left == 0) return;
  bool before = true;  // a return acts in its block
  for (const analysis::Edge& edge : analyses_.Graphs().Of(program_).Successors(id)) {
    if (!edge.to.Valid() && edge.kind == analysis::EdgeKind::kTextEnd) before = false;
  }
  for (Slot slot = 0; slot < kMaxAxes; ++slot) {
    if ((left >> slot & 1U) != 0 && !slots[slot].Known()) unknown_left_ |= MaskOf(slot);
  }
  PutPositions(id, left, slots, before, emit);
}

void DimensionPass::PutPositions(BlockId id, SlotMask which, Slots& slots, bool before, bool emit) {
  // A sum that reads the cell of another axis is taken before that one is written.
  for (Slot slot = 0; slot < kMaxAxes; ++slot) {
    for (Slot other = 0; other < kMaxAxes; ++other) {
      if (other == slot || (which >> other & 1U) == 0 || !slots[slot].Known()) continue;
      if (ReadsPlace(slots[slot].form, CellAt(other))) Save(id, slot, slots, before, emit);
    }
  }
  for (Slot slot = 0; slot < kMaxAxes; ++slot) {
    if ((which >> slot & 1U) != 0 && slots[slot].Known()) PutInto(CellAt(slot), id, slots[slot], before, emit);
  }
}

}  // namespace ncport::ir::transform
