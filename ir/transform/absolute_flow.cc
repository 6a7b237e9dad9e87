// Where the axes stand on arrival at each block, and which values must be in a local there (part of
// absolute_dimensions.h).
#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ir/axis_names.h"
#include "ir/block_words.h"
#include "ir/make_word.h"
#include "ir/transform/dimension_pass.h"
#include "ir/transform/new_local.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/word_values.h"

namespace ncport::ir::transform {

bool DimensionPass::UsesSlot(BlockId id, Slot slot) const {
  if (PassedAt(id) >> slot & 1U) return true;
  if (UsesForPlane(id, slot) || UsesForFrame(id, slot)) return true;
  if (StepOf(id, slot) == Step::kIncremental && !KeptAt(id, slot)) return true;
  // The circles in front of the last turn share the way from where the axes stand.
  const bool plane_axis = slot < 3;
  if (HasWord(module_, module_.blocks[id], WordOp::kTurns) &&
      (plane_axis || (slot < kLetterAxes && WordFor(id, slot) != nullptr)))
    return true;
  for (const WordId word : module_.blocks[id].words) {
    const Word& center = module_.words[word];
    if (center.op == WordOp::kCenter && center.index == slot && center.mode == ValueMode::kAbsolute) return true;
  }
  return false;
}

/// Backward: is the value on arrival used before the slot is set anew?
void DimensionPass::FindLive() {
  live_.assign(blocks_.count, 0);
  std::vector<SlotMask> uses(blocks_.count, 0), sets(blocks_.count, 0);
  for (std::uint32_t i = 0; i < blocks_.count; ++i) {
    for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
      if (UsesSlot(blocks_[i], slot)) uses[i] |= MaskOf(slot);
      const Step step = StepOf(blocks_[i], slot);
      const bool always = !Conditional(module_.blocks[blocks_[i]]);
      if (step != Step::kNone && step != Step::kIncremental && always) sets[i] |= MaskOf(slot);
    }
  }
  const analysis::Cfg& graph = analyses_.Graphs().Of(program_);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = blocks_.count; i-- > 0;) {
      SlotMask behind = LeftAt(blocks_[i]);
      for (const analysis::Edge& edge : graph.Successors(blocks_[i])) {
        if (edge.to.Valid()) behind |= live_[IndexOf(edge.to)];
        if (edge.kind == analysis::EdgeKind::kComputed) behind = kAllSlots;
      }
      const SlotMask now = uses[i] | (behind & ~sets[i]) | LiveThroughFrame(blocks_[i], behind);
      changed = changed || now != live_[i];
      live_[i] = now;
    }
  }
}

/// Backward: does a block that takes the value from its local follow before the slot is set again?
void DimensionPass::FindCarryLive() {
  std::vector<SlotMask> arrives(blocks_.count, 0), named(blocks_.count, 0);
  for (std::uint32_t i = 0; i < blocks_.count; ++i) {
    for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
      if (StepOf(blocks_[i], slot) != Step::kNone) named[i] |= MaskOf(slot);
    }
  }
  carry_live_.assign(blocks_.count, 0);
  const analysis::Cfg& graph = analyses_.Graphs().Of(program_);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = blocks_.count; i-- > 0;) {
      SlotMask behind = 0;
      for (const analysis::Edge& edge : graph.Successors(blocks_[i])) {
        if (edge.to.Valid()) behind |= arrives[IndexOf(edge.to)];
      }
      const SlotMask now = carried_[i] | (behind & ~named[i]);
      changed = changed || now != arrives[i] || behind != carry_live_[i];
      arrives[i] = now;
      carry_live_[i] = behind;
    }
  }
  entry_carried_ = blocks_.count == 0 ? 0 : arrives[0];
}

ExprId DimensionPass::Held(Slot slot) {
  static constexpr std::string_view kOtherNames[] = {"POLE_1",  "POLE_2",  "POLAR_ANGLE", "POLAR_RADIUS",
                                                     "SHIFT_X", "SHIFT_Y", "SHIFT_Z"};
  VariableId& held = held_[program_.value][slot];
  if (!held.Valid()) {
    const std::string name =
        slot < kMaxAxes ? fmt::format("POS_{}", kAxisLetters[slot]) : std::string(kOtherNames[slot - kPoleFirst]);
    held = NewLocal(module_, program_, name, Type::kReal);
  }
  return make_.Variable(held);
}

/// `whole`: more than the place is written, of its array or space.
bool DimensionPass::ReadsPlace(const LinearForm& form, ExprId place, bool whole) const {
  const Expr& target = module_.exprs[place];
  const bool target_cell = target.op == ExprOp::kCell || target.op == ExprOp::kCellAt;
  bool reads = false;
  for (const LinearForm::Term& term : form.terms) {
    VisitReads(module_, term.atom, [&](ExprId id) {
      const Expr& read = module_.exprs[id];
      const bool read_cell = read.op == ExprOp::kCell || read.op == ExprOp::kCellAt;
      if (read_cell != target_cell) return;
      if (!read_cell) {
        reads = reads || read.a == target.a;
        return;
      }
      const bool both_fixed = !whole && read.op == ExprOp::kCell && target.op == ExprOp::kCell;
      reads = reads || !both_fixed || (read.a == target.a && read.b == target.b);
    });
  }
  return reads;
}

bool DimensionPass::ReadsShared(const LinearForm& form) const {
  bool shared = false;
  for (const LinearForm::Term& term : form.terms) {
    VisitReads(module_, term.atom, [&](ExprId id) {
      const Expr& read = module_.exprs[id];
      const bool own = (read.op == ExprOp::kVariable || read.op == ExprOp::kElement) &&
                       module_.variables[VariableId{read.a}].owner == program_ &&
                       !module_.variables[VariableId{read.a}].by_reference;
      shared = shared || !own;
    });
  }
  return shared;
}

/// The value goes to its local. Sums of other slots that read what the local held until then go to their own locals
/// first; where two read each other, or nobody needs the other, that one is given up.
void DimensionPass::Save(BlockId id, Slot slot, Slots& slots, bool before, bool emit) {
  const ExprId place = Held(slot);
  if (!SameForm(module_, slots[slot].form, FormOf(module_, place))) {
    const SlotMask needed = live_[IndexOf(id)] | LiveBehind(id);
    for (Slot other = 0; other < SlotsUsed(); ++other) {
      if (other == slot || !slots[other].Known() || !ReadsPlace(slots[other].form, place)) continue;
      const VariableId local = held_[program_.value][other];
      const bool both =
          (saving_ >> other & 1U) != 0 || (local.Valid() && ReadsPlace(slots[slot].form, make_.Variable(local)));
      if (both || (needed >> other & 1U) == 0) {
        slots[other] = {SlotValue::Kind::kUnknown, {}};
      } else {
        saving_ |= MaskOf(slot);
        Save(id, other, slots, before, emit);
        saving_ &= ~MaskOf(slot);
      }
      if (!slots[slot].Known()) return;
    }
  }
  PutInto(place, id, slots[slot], before, emit);
}

/// The value goes to `place`, before or behind the block; from there on it is what the place holds.
void DimensionPass::PutInto(ExprId place, BlockId id, SlotValue& value, bool before, bool emit) {
  const LinearForm there = FormOf(module_, place);
  if (emit && !SameForm(module_, value.form, there)) {
    // What follows reads the place on both ways: it is set even where the block is skipped.
    const std::vector<Word> words{MakeAssignment(place, ExprOf(module_, value.form))};
    if (before) {
      editor_->PutInFront(id, words, {.skip = false});
    } else {
      Block made = editor_->MakeBlock(id);
      editor_->SetWords(made, words);
      editor_->InsertAfter(id, made);
    }
  }
  value.form = there;
}

void DimensionPass::Through(BlockId id, Slots& slots, bool emit) {
  const std::uint32_t index = IndexOf(id);
  const Block block = module_.blocks[id];
  // What the block writes may stand in a sum that is used later.
  bool calls_shared = false;
  bool writes_cells = false;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<CallId>().Valid()) {
      const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
      calls_shared = calls_shared || !callee.Valid() || effects_[callee.value].writes_shared;
      writes_cells = true;
    }
  }
  const SlotMask in_cells = PassedAt(id) | ReturnedAt(id);  // the call writes these, and what the callee passes on
  const SlotMask left = LeftAt(id);
  const SlotMask live_behind = LiveBehind(id);
  for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
    SlotValue& value = slots[slot];
    if (!value.Known() || ((live_[index] | live_behind) >> slot & 1U) == 0) continue;
    // In front of a return the cells are written before its block moves.
    bool changes = (calls_shared && (in_cells >> slot & 1U) == 0 && ReadsShared(value.form)) ||
                   (writes_cells && (in_cells >> slot & 1U) == 0 && ReadsCells(value.form)) ||
                   (left != 0 && StepOf(id, slot) != Step::kNone && ReadsCells(value.form));
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      const bool list = word.op == WordOp::kAssignList;
      const auto writes = [&](ExprId place) { changes = changes || ReadsPlace(value.form, place, list); };
      VisitPlaces(module_, word, writes);
      VisitReferences(module_, word, writes);
    }
    // The counter of FOR changes at its ENDFOR too.
    if (HasWord(module_, block, WordOp::kEndFor) && block.link.Valid()) {
      for (const WordId word_id : module_.blocks[block.link].words) {
        const Word& word = module_.words[word_id];
        if (word.op == WordOp::kFor)
          changes = changes || ReadsPlace(value.form, module_.fors[word.Extra<ForId>()].variable);
      }
    }
    if (changes) Save(id, slot, slots, true, emit);
  }
  PassPositions(id, slots, emit);
  if (emit) RewriteWords(id, slots);
  const ModalState state = flow_.At(program_, id);
  const Slots in = slots;
  for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
    SlotValue& value = slots[slot];
    const Step step = StepOf(id, slot);
    if (step == Step::kNone) continue;
    const SlotValue& before = in[slot];
    value = {SlotValue::Kind::kUnknown, {}};
    if (step == Step::kLost) continue;
    if (step == Step::kReturned) {
      // A call that may be skipped leaves the cell as it was filled before, if that was known.
      if (!Conditional(block) || before.Known()) value = {SlotValue::Kind::kKnown, FormOf(module_, CellAt(slot))};
      continue;
    }
    if (step == Step::kComputed) {
      const std::optional<LinearForm> form = Computed(id, slot, in);
      if (!form) continue;
      value.form = *form;
    } else {
      const Word& word = *WordFor(id, slot);
      const Scale scale = ScaleOf(word, slot, state, id, false);
      if (!scale.known || (step == Step::kIncremental && !before.Known())) continue;
      const LinearForm named = ScaledForm(word.value, scale.factor);
      value.form = step == Step::kIncremental ? Sum(module_, before.form, named) : named;
    }
    value.kind = SlotValue::Kind::kKnown;
    if (Conditional(block) && !(before.Known() && SameForm(module_, before.form, value.form)))
      value = {SlotValue::Kind::kUnknown, {}};  // the block may be skipped
  }
  for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
    const bool set = StepOf(id, slot) != Step::kNone && slots[slot].Known();
    if (set && (carry_live_[index] >> slot & 1U) != 0) Save(id, slot, slots, false, emit);
  }
  LeavePositions(id, slots, emit);
  if (!TriggersModal(program_, id)) return;
  // The program of the modal call moves on from there, and may change what a sum reads.
  for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
    SlotValue& value = slots[slot];
    const bool moved = (modal_.slots >> slot & 1U) != 0;
    const bool changed = value.Known() && ((modal_.writes_shared && ReadsShared(value.form)) || ReadsCells(value.form));
    if (value.kind != SlotValue::Kind::kNoWay && (moved || changed)) value = {SlotValue::Kind::kUnknown, {}};
  }
}

/// Takes the values of one way into those of the block; true if they changed.
bool DimensionPass::Join(BlockId block, Slots& at, const Slots& from) {
  bool changed = false;
  const std::uint32_t index = IndexOf(block);
  for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
    SlotValue& value = at[slot];
    const SlotValue& other = from[slot];
    if (other.kind == SlotValue::Kind::kNoWay) continue;
    if ((carried_[index] >> slot & 1U) && other.Known() && value.kind != SlotValue::Kind::kUnknown) {
      if (value.kind == SlotValue::Kind::kNoWay) {
        value = {SlotValue::Kind::kKnown, FormOf(module_, Held(slot))};
        changed = true;
      }
      continue;
    }
    if (value.kind == SlotValue::Kind::kNoWay) {
      value = other;
      changed = true;
    } else if (value.Known() && other.kind == SlotValue::Kind::kUnknown) {
      value = other;
      changed = true;
    } else if (value.Known() && !SameForm(module_, value.form, other.form)) {
      if (live_[index] >> slot & 1U) {
        carried_[index] |= MaskOf(slot);
        value.form = FormOf(module_, Held(slot));
      } else {
        value = {SlotValue::Kind::kUnknown, {}};
      }
      changed = true;
    }
  }
  return changed;
}

/// Nothing is known where a program starts; only the pole of a main program is the zero point (sinumerik-8.6).
Slots DimensionPass::EntrySlots() {
  Slots slots;
  for (SlotValue& value : slots) value.kind = SlotValue::Kind::kUnknown;
  bool called = module_.programs[program_].kind != ProgramKind::kMain;
  for (const analysis::CallSite& site : analyses_.Calls().AllSites()) called = called || site.callee == program_;
  if (!called || !poles_) {
    slots[kPoleFirst] = {SlotValue::Kind::kKnown, {}};
    slots[kPoleSecond] = {SlotValue::Kind::kKnown, {}};
  }
  for (Slot axis = 0; axis < kMaxAxes; ++axis) {
    if (passes_[program_.value] >> axis & 1U) slots[axis] = {SlotValue::Kind::kKnown, FormOf(module_, CellAt(axis))};
  }
  const bool framed = blocks_.count != 0 && !frames_.Before(blocks_[0]).untouched;
  for (std::uint8_t axis = 0; axis < 3 && !framed; ++axis) slots[kShift + axis] = {SlotValue::Kind::kKnown, {}};
  return slots;
}

/// Values that the program starts with and that arrive in their locals somewhere: no block names them before.
void DimensionPass::SaveEntry(Slots& slots, bool emit) {
  for (Slot slot = 0; slot < SlotsUsed(); ++slot) {
    SlotValue& value = slots[slot];
    if ((entry_carried_ >> slot & 1U) == 0 || !value.Known()) continue;
    const ExprId held = Held(slot);
    if (emit) {
      Block made = editor_->MakeBlock(blocks_[0]);
      editor_->SetWords(made, {MakeAssignment(held, ExprOf(module_, value.form))});
      // Behind the head; in front of a block that jumps may come back to, without its label.
      if (HasWord(module_, module_.blocks[blocks_[0]], WordOp::kHeader)) {
        editor_->InsertAfter(blocks_[0], made);
      } else {
        editor_->InsertBefore(blocks_[0], made);
      }
    }
    value.form = FormOf(module_, held);
  }
}

void DimensionPass::Flow() {
  const analysis::Cfg& graph = analyses_.Graphs().Of(program_);
  std::vector<SlotMask> carried_before;
  do {
    carried_before = carried_;
    FindCarryLive();
    in_.assign(blocks_.count, Slots{});
    if (blocks_.count == 0) return;
    if (graph.Opaque()) {  // any block may follow any other
      for (Slots& slots : in_) {
        for (SlotValue& value : slots) value.kind = SlotValue::Kind::kUnknown;
      }
      return;
    }
    in_[0] = EntrySlots();
    SaveEntry(in_[0], false);
    std::set<std::uint32_t> work{0};
    // As soon as a place is found where a local must hold the value, all is followed anew: sums found on the way
    // there were those of one way only.
    while (!work.empty() && carried_ == carried_before) {
      const std::uint32_t index = *work.begin();
      work.erase(work.begin());
      Slots slots = in_[index];
      Through(blocks_[index], slots, false);
      for (const analysis::Edge& edge : graph.Successors(blocks_[index])) {
        if (edge.to.Valid()) {
          if (Join(edge.to, in_[IndexOf(edge.to)], slots)) work.insert(IndexOf(edge.to));
          continue;
        }
        if (edge.kind != analysis::EdgeKind::kComputed) continue;
        Slots nowhere;
        for (SlotValue& value : nowhere) value.kind = SlotValue::Kind::kUnknown;
        for (const BlockId target : graph.ComputedTargets()) {
          if (Join(target, in_[IndexOf(target)], nowhere)) work.insert(IndexOf(target));
        }
      }
    }
  } while (carried_ != carried_before);
}

}  // namespace ncport::ir::transform
