#include "ir/transform/absolute_dimensions.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/transform/dimension_pass.h"
#include "ir/transform/new_local.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/word_values.h"

namespace ncport::ir::transform {

namespace {

constexpr double kInch = 25.4;
constexpr double kFoot = 0.3048;  // ft/min in m/min

/// Words that make the axis words of their block something else than a move.
bool AxisWordsAreMoves(const Module& module, const Block& block) {
  for (const WordId id : block.words) {
    switch (module.words[id].op) {
      case WordOp::kFrame:
      case WordOp::kReference:
      case WordOp::kPole:
      case WordOp::kPresetPosition:
      case WordOp::kMachineCoords:
        return false;
      default:
        break;
    }
  }
  return true;
}

bool Has(const Module& module, const Block& block, WordOp op) {
  for (const WordId id : block.words) {
    if (module.words[id].op == op) return true;
  }
  return false;
}

}  // namespace

const Word* DimensionPass::WordFor(BlockId block, std::uint8_t axis) const {
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op == WordOp::kAxis && word.index == axis) return &word;
  }
  return nullptr;
}

const Word* DimensionPass::WordOf(BlockId block, WordOp op) const {
  for (const WordId id : module_.blocks[block].words) {
    if (module_.words[id].op == op) return &module_.words[id];
  }
  return nullptr;
}

double DimensionPass::UnitFactor(const ModalState& state) {
  return state.units == Units::kInch || state.units == Units::kInchGeometry ? kInch : 1;
}

bool DimensionPass::Conditional(const Block& block) const {
  return block.skip_level != Block::kNoSkip || Has(module_, block, WordOp::kWhen) ||
         Has(module_, block, WordOp::kSkipRest);
}

void DimensionPass::Unknown(BlockId block, const Word& word, std::uint8_t axis) {
  ok_ = false;
  diag::Diagnostic& finding = sink_.Report(diag::Code::kUnknownPosition, module_.RangeOf(module_.blocks[block], word),
                                           std::string(1, kDimensionAxes[axis]));
  finding.help = "program the axis once with an absolute word before the increment, on every way that leads here";
  const auto caller = unknown_callers_.find({program_.value, axis});
  if (caller != unknown_callers_.end())
    finding.notes.push_back({module_.RangeOf(module_.blocks[caller->second]), "it is not known at this call"});
}

bool DimensionPass::TriggersModal(ProgramId program, BlockId id) const {
  if (!flow_.ModalCallPossible(program, id)) return false;
  for (const WordId word : module_.blocks[id].words) {
    if (DefaultPhaseOf(module_.words[word].op) == Phase::kMotion) return true;
  }
  return false;
}

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

DimensionPass::Scale DimensionPass::ScaleOf(const Word& word, std::uint8_t axis, const ModalState& state, BlockId block,
                                            bool report) {
  Scale scale;
  // Where no way leads, nothing runs under any mode.
  const bool reached = flow_.Reached(program_, block);
  const auto unknown = [&](std::string_view group) {
    scale.known = false;
    if (!report || !reached) return;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[block], word), group,
                 "the programs that lead here leave it open");
  };
  bool diameter = false;  // the number is a diameter
  const bool transverse = axis == source_.transverse_axis;
  switch (word.mode) {
    case ValueMode::kModal:
      if (state.distance == Distance::kUnknown) unknown("the distance mode (absolute or incremental)");
      scale.incremental = state.distance == Distance::kIncremental;
      break;
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      scale.incremental = true;
      break;
    default:
      break;
  }
  switch (word.mode) {
    case ValueMode::kAbsoluteDiameter:
    case ValueMode::kIncrementalDiameter:
      diameter = true;
      break;
    case ValueMode::kAbsoluteRadius:
    case ValueMode::kIncrementalRadius:
      break;
    default:
      if (!transverse) break;
      if (state.diameter == Diameter::kUnknown) unknown("the diameter mode");
      diameter = state.diameter == Diameter::kDiameter ||
                 (state.diameter == Diameter::kDiameterAbsolute && !scale.incremental);
      break;
  }
  const bool wants_diameter = axis == config_.diameter_axis;
  scale.factor = wants_diameter == diameter ? 1 : wants_diameter ? 2 : 0.5;
  if (!IsRotary(axis)) scale.factor *= UnitFactor(state);
  return scale;
}

Step DimensionPass::StepOf(BlockId id, Slot slot) const {
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& call = module_.words[word_id];
    if ((call.op != WordOp::kCall && call.op != WordOp::kModalCall) || !call.Extra<CallId>().Valid()) continue;
    const ProgramId callee = module_.calls[call.Extra<CallId>()].program;
    if (ReturnedAt(id) >> slot & 1U) return Step::kReturned;
    const SlotMask slots = callee.Valid() ? effects_[callee.value].slots : kAllSlots;
    if (slots >> slot & 1U) return Step::kLost;
  }
  return slot < kMaxAxes ? AxisStep(id, slot) : slot < kShift ? PolarStep(id, slot) : ShiftStep(id, slot);
}

Step DimensionPass::AxisStep(BlockId id, std::uint8_t axis) const {
  const Block& block = module_.blocks[id];
  const Word* word = WordFor(id, axis);
  const PlaneWords& plane = plane_words_[IndexOf(id)];
  if (Has(module_, block, WordOp::kAxisComputed) || Has(module_, block, WordOp::kContourAngle)) {
    const bool named = word != nullptr && !Has(module_, block, WordOp::kContourAngle);
    return named ? Step::kAbsolute : Step::kLost;
  }
  if (frames_.Any() && FrameWord(id) != nullptr && (axis < 3 || word == nullptr))
    return axis < 3 ? Step::kComputed : Step::kNone;
  if (LosesUnderFrame(id, axis)) return Step::kLost;
  if (Has(module_, block, WordOp::kFrame) || Has(module_, block, WordOp::kWorkOffset) ||
      Has(module_, block, WordOp::kPresetPosition)) {
    // The zero point moves: what the axis stands at is another number now.
    if (word == nullptr || !AxisWordsAreMoves(module_, block)) return Step::kLost;
  }
  if (plane.kind == PlaneWords::Kind::kPole) return Step::kNone;
  if ((plane.kind == PlaneWords::Kind::kPolar || plane.kind == PlaneWords::Kind::kOpeningCenter) && plane.HasAxis(axis))
    return Step::kComputed;
  if (word == nullptr) return Step::kNone;
  if (!AxisWordsAreMoves(module_, block)) return Step::kLost;
  switch (word->mode) {
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      return Step::kIncremental;
    case ValueMode::kModal:
      return flow_.At(program_, id).distance == Distance::kIncremental ? Step::kIncremental : Step::kAbsolute;
    default:
      return Step::kAbsolute;
  }
}

bool DimensionPass::UsesSlot(BlockId id, Slot slot) const {
  if (PassedAt(id) >> slot & 1U) return true;
  if (UsesForPlane(id, slot) || UsesForFrame(id, slot)) return true;
  if (StepOf(id, slot) == Step::kIncremental && !KeptAt(id, slot)) return true;
  // The circles in front of the last turn share the way from where the axes stand.
  const bool plane_axis = slot < 3;
  if (Has(module_, module_.blocks[id], WordOp::kTurns) &&
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
  const analysis::Cfg& graph = graphs_.Of(program_);
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
  const analysis::Cfg& graph = graphs_.Of(program_);
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
        slot < kMaxAxes ? fmt::format("POS_{}", kDimensionAxes[slot]) : std::string(kOtherNames[slot - kPoleFirst]);
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
    Word word;
    word.op = WordOp::kAssign;
    word.phase = DefaultPhaseOf(WordOp::kAssign);
    word.extra = place.value;
    word.value = ExprOf(module_, value.form);
    Block made = editor_->MakeBlock(id);
    editor_->SetWords(made, {word});
    if (before) {
      // The new block takes the place that jumps go to.
      Block& block = module_.blocks[id];
      made.label = std::exchange(block.label, StringId{});
      made.number = std::exchange(block.number, Block::kNoNumber);
      made.number_digits = block.number_digits;
      made.flags = static_cast<std::uint8_t>(made.flags | (block.flags & Block::kMainBlock));
      editor_->InsertBefore(id, made);
    } else {
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
    if (Has(module_, block, WordOp::kEndFor) && block.link.Valid()) {
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
  for (const analysis::CallSite& site : calls_.AllSites()) called = called || site.callee == program_;
  if (!called || !poles_) {
    slots[kPoleFirst] = {SlotValue::Kind::kKnown, {}};
    slots[kPoleSecond] = {SlotValue::Kind::kKnown, {}};
  }
  for (Slot axis = 0; axis < kMaxAxes; ++axis) {
    if (passes_[program_.value] >> axis & 1U) slots[axis] = {SlotValue::Kind::kKnown, FormOf(module_, CellAt(axis))};
  }
  const bool framed = blocks_.count != 0 && !frames_.Before(program_, blocks_[0]).untouched;
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
      Word word;
      word.op = WordOp::kAssign;
      word.phase = DefaultPhaseOf(WordOp::kAssign);
      word.extra = held.value;
      word.value = ExprOf(module_, value.form);
      Block made = editor_->MakeBlock(blocks_[0]);
      editor_->SetWords(made, {word});
      // Behind the head; in front of a block that jumps may come back to, without its label.
      if (Has(module_, module_.blocks[blocks_[0]], WordOp::kHeader)) {
        editor_->InsertAfter(blocks_[0], made);
      } else {
        editor_->InsertBefore(blocks_[0], made);
      }
    }
    value.form = FormOf(module_, held);
  }
}

void DimensionPass::Flow() {
  const analysis::Cfg& graph = graphs_.Of(program_);
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

ExprId DimensionPass::Scaled(ExprId value, double factor) {
  return factor == 1 ? value : ExprOf(module_, ScaledForm(value, factor));
}

/// From the start point, as radius, mm. None: an absolute one while the position is not known.
std::optional<LinearForm> DimensionPass::CenterForm(BlockId id, const Word& word, const Slots& in) const {
  const ModalState state = flow_.At(program_, id);
  if (word.mode != ValueMode::kAbsolute) return ScaledForm(word.value, UnitFactor(state));
  const std::uint8_t axis = word.index;
  if (!in[axis].Known()) return std::nullopt;
  const bool diameter = axis == source_.transverse_axis && source_.centers_are_diameter_when_absolute &&
                        (state.diameter == Diameter::kDiameter || state.diameter == Diameter::kDiameterAbsolute);
  const LinearForm center = ScaledForm(word.value, (diameter ? 0.5 : 1) * UnitFactor(state));
  return Sum(module_, center, in[axis].form, axis == config_.diameter_axis ? -0.5 : -1);
}

/// Lengths and feeds besides the axis words, in the target's units.
void DimensionPass::RewriteCenter(BlockId id, Word& word, const Slots& in) {
  const ModalState state = flow_.At(program_, id);
  if (word.op == WordOp::kRadius || word.op == WordOp::kChamfer ||
      (word.op == WordOp::kCenter && word.mode != ValueMode::kAbsolute)) {
    word.value = Scaled(word.value, UnitFactor(state));
  } else if (word.op == WordOp::kFeed && state.units == Units::kInch && state.feed_mode != FeedMode::kInverseTime) {
    word.value = Scaled(word.value, kInch);
  } else if (word.op == WordOp::kSpeed && state.units == Units::kInch &&
             state.speed_mode == SpeedMode::kConstantSurface) {
    // A number is checked where it is printed; a computed one would be rounded to whole m/min unseen.
    if (!FormOf(module_, word.value).IsConstant()) {
      ok_ = false;
      sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[id], word),
                   "a computed surface speed in ft/min", "whole m/min");
    }
    word.value = Scaled(word.value, kFoot);
  } else if (word.op == WordOp::kCenter) {
    // A target's centre words are radius values on every axis.
    const std::optional<LinearForm> center = CenterForm(id, word, in);
    if (!center) return Unknown(id, word, word.index);
    word.value = ExprOf(module_, *center);
    word.mode = ValueMode::kStep;
  }
}

/// Machine coordinates are absolute whatever the distance mode; their unit and diameters are those of the block.
void DimensionPass::RewriteMachineWords(BlockId id) {
  const ModalState state = flow_.At(program_, id);
  std::vector<Word> words;
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op == WordOp::kAxis) {
      const Scale scale = ScaleOf(word, word.index, state, id, true);
      if (scale.known && scale.incremental) Unknown(id, word, word.index);
      if (scale.known && !scale.incremental) {
        word.value = Scaled(word.value, scale.factor);
        word.mode = ValueMode::kAbsolute;
      }
    }
    words.push_back(word);
  }
  rewritten_.emplace_back(id, std::move(words));
}

/// True where some program switches to inches: a unit that is not one on every way may then be that.
bool DimensionPass::InchesOccur() const {
  const auto inch = [](Units units) { return units == Units::kInch || units == Units::kInchGeometry; };
  if (inch(source_.start.units) || inch(config_.sub_entry.units)) return true;
  return std::ranges::any_of(module_.words.All(), [&](const Word& word) {
    return word.op == WordOp::kUnits && inch(static_cast<Units>(word.index));
  });
}

void DimensionPass::RefuseOpenUnits(BlockId id) {
  const ModalState state = flow_.At(program_, id);
  if (!inches_ || state.units != Units::kUnknown || !flow_.Reached(program_, id)) return;
  const Block& block = module_.blocks[id];
  if (Has(module_, block, WordOp::kReference)) return;
  const Word* const frame = FrameWord(id);
  const bool turns = frame != nullptr && frame->index != static_cast<std::uint8_t>(FrameOp::kTranslate) &&
                     frame->index != static_cast<std::uint8_t>(FrameOp::kAddTranslate);
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    bool length = false;
    switch (word.op) {
      case WordOp::kAxis:
        length = !IsRotary(word.index) && !turns;
        break;
      case WordOp::kCenter:
      case WordOp::kRadius:
      case WordOp::kVia:
      case WordOp::kChamfer:
      case WordOp::kPolarRadius:
        length = true;
        break;
      case WordOp::kFeed:
      case WordOp::kFeedOnce:
        length = state.feed_mode != FeedMode::kInverseTime;
        break;
      case WordOp::kSpeed:
        length = state.speed_mode == SpeedMode::kConstantSurface;
        break;
      default:
        break;
    }
    if (!length) continue;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(block, word), "the unit of lengths (mm or inch)",
                 "the programs that lead here leave it open");
    return;
  }
}

void DimensionPass::RewriteWords(BlockId id, const Slots& in) {
  RefuseOpenUnits(id);
  if (Has(module_, module_.blocks[id], WordOp::kMachineCoords)) return RewriteMachineWords(id);
  if (plane_words_[IndexOf(id)].kind == PlaneWords::Kind::kPole) return RemovePole(id, in);
  if (config_.work_frames_in && FrameWord(id) != nullptr) return RemoveFrame(id);
  if (!AxisWordsAreMoves(module_, module_.blocks[id])) return;
  const ModalState state = flow_.At(program_, id);
  std::vector<Word> words;
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op == WordOp::kAxis) {
      const Scale scale = ScaleOf(word, word.index, state, id, true);
      if (scale.known && (!scale.incremental || KeptAt(id, word.index))) {
        word.value = Scaled(word.value, scale.factor);
      } else if (scale.known && in[word.index].Known()) {
        word.value = ExprOf(module_, Sum(module_, in[word.index].form, ScaledForm(word.value, scale.factor)));
      } else if (scale.known) {
        Unknown(id, word, word.index);
      }
    } else {
      RewriteCenter(id, word, in);
    }
    words.push_back(word);
    if (word.op != WordOp::kAxis) continue;
    words.back().mode = ValueMode::kAbsolute;
    if (KeptAt(id, word.index)) words.back().mode = ValueMode::kIncremental;
  }
  if (plane_words_[IndexOf(id)].Moves() && !LowerPlaneWords(id, in, words)) return;
  if (cut_.contains(id.value) && WordOf(id, WordOp::kMotion) == nullptr) {
    Word linear;  // the corner in front may be an arc
    linear.op = WordOp::kMotion;
    linear.index = static_cast<std::uint8_t>(Motion::kLinear);
    linear.phase = DefaultPhaseOf(WordOp::kMotion);
    words.insert(words.begin(), linear);
  }
  std::vector<std::vector<Word>> before, after;
  if (Has(module_, module_.blocks[id], WordOp::kTurns) && !LowerTurns(id, in, words, before)) return;
  if (CornerMoves(id) && !LowerCorner(id, in, words, after)) return;
  if (config_.work_frames_in && frames_.Any()) {
    for (auto* pieces : {&before, &after}) {
      for (std::vector<Word>& piece : *pieces) {
        if (!ApplyFrame(id, in, piece)) return;
      }
    }
    if (!ApplyFrame(id, in, words)) return;
  }
  for (const std::vector<Word>& piece : before) Insert(id, piece, true);
  for (const std::vector<Word>& piece : after) Insert(id, piece, false);
  rewritten_.emplace_back(id, std::move(words));
}

void DimensionPass::DropModeWords() {
  ProgramEditor editor(module_, program_, "absolute_dimensions");
  for (const BlockId id : module_.programs[program_].blocks) {
    Block& block = module_.blocks[id];
    std::vector<Word> kept;
    bool dropped = false;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kDistance || word.op == WordOp::kDiameter || word.op == WordOp::kUnits) {
        dropped = true;
      } else {
        kept.push_back(word);
      }
    }
    if (!dropped) continue;
    Block changed = block;
    editor.SetWords(changed, kept);
    module_.blocks[id].words = changed.words;
    if (kept.empty() && !block.label.Valid() && block.number == Block::kNoNumber && block.comments.Empty())
      editor.Remove(id);
  }
  editor.Apply();
}

void DimensionPass::Enter(ProgramId program) {
  program_ = program;
  blocks_ = module_.programs[program].blocks;
  carried_.assign(blocks_.count, 0);
  FindPlaneWords();
  FindSenses();
}

bool DimensionPass::RunProgram(ProgramId program) {
  Enter(program);
  FindLive();
  Flow();
  editor_.emplace(module_, program, "absolute_dimensions");
  rewritten_.clear();
  cut_.clear();
  if (blocks_.count != 0) {
    Slots entry = EntrySlots();
    SaveEntry(entry, true);
  }
  for (std::uint32_t i = 0; i < blocks_.count; ++i) {
    Slots slots = in_[i];
    // Where no way leads, the increments are those of dead text. They are taken from the modes as they stand.
    if (slots[0].kind == SlotValue::Kind::kNoWay) {
      RewriteWords(blocks_[i], slots);
    } else {
      Through(blocks_[i], slots, true);
    }
  }
  for (const auto& [id, words] : rewritten_) {
    Block& block = module_.blocks[id];
    if (words.empty() && !block.words.Empty() && !block.label.Valid() && block.number == Block::kNoNumber &&
        block.comments.Empty()) {
      editor_->Remove(id);
    } else if (words.size() == block.words.count) {
      for (std::uint32_t i = 0; i < words.size(); ++i) module_.words[block.words[i]] = words[i];
    } else {
      editor_->SetWords(block, words);
    }
  }
  editor_->Apply();
  return ok_;
}

bool DimensionPass::Run() {
  inches_ = InchesOccur();
  FindRanges();
  FindEffects();
  FindKept();
  FindCallPositions();
  for (const ProgramId program : module_.programs.Ids()) RunProgram(program);
  if (!ok_) return false;
  for (const ProgramId program : module_.programs.Ids()) {
    program_ = program;
    DropModeWords();
    if (config_.keep == KeepIncrements::kBlocks && !kept_axes_.empty()) WriteDistanceModes();
  }
  return true;
}

bool AbsoluteDimensions(Module& module, const Machine& source, const AbsoluteDimensionsConfig& config, diag::Sink& sink,
                        CarriedPositions* carried, KeptIncrements* kept) {
  DimensionPass pass(module, source, config, sink);
  const bool ok = pass.Run();
  if (carried != nullptr) *carried = pass.Carried();
  if (kept != nullptr) *kept = pass.Kept();
  return ok;
}

}  // namespace ncport::ir::transform
