#include "ir/transform/drilling_flow.h"

#include <string_view>

#include "ir/literal_value.h"
#include "ir/plane_axes.h"
#include "ir/transform/new_local.h"

namespace ncport::ir::transform {

namespace {
constexpr std::uint32_t At(Cycle cycle) { return static_cast<std::uint32_t>(cycle); }
}  // namespace

bool IsHole(std::uint32_t cycle) { return cycle >= At(Cycle::kDrill) && cycle <= At(Cycle::kBoreManual); }

Drilling DrillingFlow::Entry(ProgramId program) const {
  return {.cycle = module_.programs[program].kind == ProgramKind::kMain ? Drilling::kNoCycle : Drilling::kCallers};
}

bool DrillingFlow::Join(BlockId, Drilling& into, const Drilling& from) const {
  const Drilling before = into;
  const auto untouched = [](std::uint32_t cycle) { return cycle == Drilling::kNoCycle || cycle == Drilling::kCallers; };
  const auto same = [&](std::uint32_t a, std::uint32_t b) {
    const auto one = LiteralOf(ExprId{a});
    return a == b || (one && one == LiteralOf(ExprId{b}));
  };
  const auto join = [&](std::uint32_t& a, std::uint32_t b) { a = same(a, b) ? a : Drilling::kOpen; };
  const bool callers = into.cycle != from.cycle && untouched(into.cycle) && untouched(from.cycle);
  if (into.cycle != from.cycle) into.cycle = Drilling::kOpen;
  if (callers) into.cycle = Drilling::kCallers;
  for (std::uint8_t i = 0; i < Drilling::kFields; ++i) join(into.fields[i], from.fields[i]);
  if (into.start != from.start) into.start = Drilling::Start::kOpen;
  into.low = into.low || from.low;
  into.rigid = into.rigid || from.rigid;
  if (into.spindle != from.spindle) into.spindle = SpindleState::kUnknown;
  return into != before;
}

void DrillingFlow::Run() {
  do {
    flow_.emplace(analyses_.Sources(), *this);
    flow_->Run();
  } while (HoldMore());
}

bool DrillingFlow::Uses(std::uint32_t cycle, std::uint8_t field) {
  const bool taps = cycle == At(Cycle::kTap) || cycle == At(Cycle::kTapLeft);
  switch (field) {
    case Drilling::kStep:
      return taps || cycle == At(Cycle::kPeck) || cycle == At(Cycle::kPeckChip);
    case Drilling::kDwell:
      return taps || cycle == At(Cycle::kDrillDwell) || cycle == At(Cycle::kBoreDwell);
    default:
      return true;
  }
}

bool DrillingFlow::HoldMore() {
  bool more = false;
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId block : module_.programs[program].blocks) {
      const Drilling* const before = Before(block);
      if (before == nullptr) continue;
      Drilling state = *before;
      Transfer(program, block, state);
      const std::uint8_t normal = AxesOf(analyses_.Modal().At(program, block).plane).normal;
      if (!IsHole(state.cycle) || !WordsOf(block, normal, IsHole(before->cycle)).Drills()) continue;
      for (std::uint8_t field = 0; field < Drilling::kFields; ++field) {
        bool& held = locals_[program.value].held[field];
        if (state.fields[field] != Drilling::kOpen || held || !Uses(state.cycle, field)) continue;
        held = more = true;
      }
    }
  }
  return more;
}

/// Words of the spindle, those that act in front of the move or those behind it; what taps leave.
void DrillingFlow::Turn(BlockId id, Drilling& state, bool drills, bool behind) const {
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    const bool at_place = drills && word.op == WordOp::kSpindle;  // as all functions beside a hole
    if ((!at_place && (word.phase == Phase::kAfter || word.phase == Phase::kLast)) != behind) continue;
    if (word.op == WordOp::kSpindle && word.index == 0) state.spindle = static_cast<SpindleState>(word.extra);
    if (word.op == WordOp::kSpindlePosition) state.spindle = SpindleState::kPositioned;
    if (word.op == WordOp::kComputedM) state.spindle = SpindleState::kUnknown;
  }
}

SpindleState DrillingFlow::SpindleAt(BlockId id) const {
  Drilling state = *Before(id);
  Turn(id, state, true, false);
  return state.spindle;
}

void DrillingFlow::Transfer(ProgramId program, BlockId id, Drilling& state) {
  const ModalState at = analyses_.Modal().At(program, id);
  const DrillingWords parts = WordsOf(id, AxesOf(at.plane).normal, IsHole(state.cycle));
  Store(program, parts, at.distance == Distance::kIncremental, state, nullptr);
  // A count of 0 makes no hole.
  if (parts.Drills() && IsHole(state.cycle))
    state.low = at.return_level != ReturnLevel::kInitial || (parts.repeats != nullptr && state.low);
  Turn(id, state, parts.Drills(), false);
  const bool left = state.cycle == At(Cycle::kTapLeft);
  if (parts.Drills() && (left || state.cycle == At(Cycle::kTap))) {
    const SpindleState tapped = left ? SpindleState::kCcw : SpindleState::kCw;
    // No hole with a count of 0.
    if (parts.repeats == nullptr || state.spindle == tapped) {
      state.spindle = tapped;
    } else {
      state.spindle = SpindleState::kUnknown;
    }
  }
  Turn(id, state, parts.Drills(), true);
}

std::optional<Drilling> DrillingFlow::Into(const analysis::CallSite&, analysis::CallMoment moment,
                                           const Drilling& at) const {
  if (moment == analysis::CallMoment::kModalStart) return std::nullopt;
  if (!IsHole(at.cycle)) return Drilling{.cycle = at.cycle, .rigid = at.rigid, .spindle = at.spindle};
  return moment == analysis::CallMoment::kModalRun ? Unknown({}) : Drilling{.spindle = at.spindle};
}

Drilling DrillingFlow::Back(const analysis::CallSite&, const Drilling& at, const Drilling& exit) const {
  Drilling behind{.cycle = exit.cycle == Drilling::kNoCycle ? Drilling::kNoCycle : Drilling::kOpen};
  if (exit.cycle == Drilling::kCallers) behind = at;
  behind.low = exit.low;
  behind.rigid = exit.rigid;
  behind.spindle = exit.spindle;
  return behind;
}

DrillingWords DrillingFlow::WordsOf(BlockId id, std::uint8_t normal, bool in_cycle) const {
  DrillingWords parts;
  const Block& block = module_.blocks[id];
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    if (word.op == WordOp::kCycle && word.extra != Id<void>::kNone) {
      parts.rigid = true;
      continue;
    }
    if (word.op == WordOp::kCycle) parts.cycle = word.index;
    if (word.op == WordOp::kMotion) parts.motion = true;
  }
  const bool holes = parts.cycle != Drilling::kUnset ? IsHole(parts.cycle) : in_cycle && !parts.motion;
  if (!holes) return parts;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    switch (word.op) {
      case WordOp::kAxis:
        if (word.index == normal) {
          parts.values[Drilling::kDepth] = &module_.words[word_id];
        } else {
          parts.place.push_back(word);
        }
        parts.geometry = parts.geometry || word.index < 3;
        break;
      case WordOp::kRadius:
        parts.values[Drilling::kLevel] = &module_.words[word_id];
        break;
      case WordOp::kCenter:
        if (word.index == 2) parts.repeats = &module_.words[word_id];
        break;
      case WordOp::kCycleValue:
        switch (static_cast<CycleField>(word.index)) {
          case CycleField::kLevel:
            parts.values[Drilling::kLevel] = &module_.words[word_id];
            break;
          case CycleField::kStep:
            parts.values[Drilling::kStep] = &module_.words[word_id];
            break;
          case CycleField::kDwell:
            parts.values[Drilling::kDwell] = &module_.words[word_id];
            break;
          case CycleField::kRepeats:
            parts.repeats = &module_.words[word_id];
            break;
          default:
            break;
        }
        break;
      default:
        break;
    }
  }
  return parts;
}

ExprId DrillingFlow::Local(ProgramId program, std::uint8_t field) {
  static constexpr std::string_view kNames[] = {"U_LEVEL", "U_DEPTH", "U_PECK", "U_DWELL"};
  ExprId& local = locals_[program.value].fields[field];
  if (!local.Valid()) local = make_.Variable(NewLocal(module_, program, kNames[field], Type::kReal));
  return local;
}

ExprId DrillingFlow::Initial(ProgramId program) {
  ExprId& local = locals_[program.value].initial;
  if (!local.Valid()) local = make_.Variable(NewLocal(module_, program, "U_INITIAL", Type::kReal));
  return local;
}

std::optional<double> DrillingFlow::LiteralOf(ExprId id) const {
  return id.value == Drilling::kUnset || id.value == Drilling::kOpen ? std::nullopt : LiteralValue(module_, id);
}

void DrillingFlow::Store(ProgramId program, const DrillingWords& parts, bool incremental, Drilling& state,
                         std::vector<std::pair<ExprId, ExprId>>* assigns) {
  if (parts.cycle != Drilling::kUnset) {
    const bool rigid = (state.rigid || parts.rigid) && IsHole(parts.cycle);
    if (!IsHole(parts.cycle) || !IsHole(state.cycle)) {
      // Where a cycle may be in force already, its start level and its data go on. Behind holes that go back to that
      // level the tool stands there.
      const bool goes_on = state.cycle == Drilling::kOpen && IsHole(parts.cycle);
      state = {.low = goes_on && state.low, .spindle = state.spindle};
      if (state.low) state.start = Drilling::Start::kOpen;
      if (goes_on) state.fields[Drilling::kStep] = state.fields[Drilling::kDwell] = Drilling::kOpen;
    }
    state.cycle = parts.cycle;
    state.rigid = rigid;
    if (rigid && state.cycle == At(Cycle::kTap)) state.cycle = At(Cycle::kRigidTap);
    if (rigid && state.cycle == At(Cycle::kTapLeft)) state.cycle = At(Cycle::kRigidTapLeft);
  } else if (parts.rigid) {
    state.rigid = true;
    state.spindle = SpindleState::kStop;
  } else if (parts.motion) {
    state = {.rigid = state.rigid && !IsHole(state.cycle), .spindle = state.spindle};
  }
  if (!IsHole(state.cycle)) return;
  // A place, a depth or a level begins the first hole: there the initial level is taken.
  if (!parts.Drills()) return;
  if (state.start == Drilling::Start::kNone) {
    state.start = Drilling::Start::kTaken;
    if (assigns != nullptr) {
      assigns->emplace_back(Initial(program), ExprId{});
    } else {
      static_cast<void>(Initial(program));
    }
    // Without P a hole waits 0 seconds.
    if (locals_[program.value].held[Drilling::kDwell] && parts.values[Drilling::kDwell] == nullptr) {
      state.fields[Drilling::kDwell] = Local(program, Drilling::kDwell).value;
      if (assigns != nullptr) assigns->emplace_back(Local(program, Drilling::kDwell), make_.Number("0"));
    }
  }
  for (std::uint8_t field = 0; field < Drilling::kFields; ++field) {
    const Word* word = parts.values[field];
    if (word == nullptr) continue;
    const bool step = field == Drilling::kDepth && word->mode == ValueMode::kIncremental;
    const bool adds = (incremental && (field == Drilling::kLevel || field == Drilling::kDepth)) || step;
    if (LiteralOf(word->value) && !adds && !locals_[program.value].held[field]) {
      state.fields[field] = word->value.value;
      continue;
    }
    if (field == Drilling::kDepth && adds && state.fields[Drilling::kLevel] >= Drilling::kOpen) {
      state.fields[field] = Drilling::kOpen;  // counts from a level that nobody knows
      continue;
    }
    state.fields[field] = Local(program, field).value;
    if (assigns == nullptr) continue;
    const ExprId base = field == Drilling::kLevel ? Initial(program) : ExprId{state.fields[Drilling::kLevel]};
    assigns->emplace_back(Local(program, field), adds ? make_.Binary(ExprOp::kAdd, base, word->value) : word->value);
  }
}

}  // namespace ncport::ir::transform
