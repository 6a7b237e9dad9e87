#include "ir/transform/drilling_flow.h"

#include <string_view>

#include "ir/literal_value.h"
#include "ir/plane_axes.h"
#include "ir/transform/new_local.h"

namespace ncport::ir::transform {

bool IsHole(std::uint32_t cycle) {
  return cycle >= static_cast<std::uint32_t>(Cycle::kDrill) && cycle <= static_cast<std::uint32_t>(Cycle::kBoreManual);
}

Drilling DrillingFlow::Entry(ProgramId program) const {
  return {.cycle = module_.programs[program].kind == ProgramKind::kMain ? Drilling::kNoCycle : Drilling::kCallers};
}

bool DrillingFlow::Join(BlockId, Drilling& into, const Drilling& from) const {
  const Drilling before = into;
  const auto untouched = [](std::uint32_t cycle) { return cycle == Drilling::kNoCycle || cycle == Drilling::kCallers; };
  const auto join = [](std::uint32_t& a, std::uint32_t b) { a = a == b ? a : Drilling::kOpen; };
  const bool callers = into.cycle != from.cycle && untouched(into.cycle) && untouched(from.cycle);
  join(into.cycle, from.cycle);
  if (callers) into.cycle = Drilling::kCallers;
  for (std::uint8_t i = 0; i < Drilling::kFields; ++i) join(into.fields[i], from.fields[i]);
  into.initial = into.initial && from.initial;
  return into != before;
}

void DrillingFlow::Transfer(ProgramId program, BlockId id, Drilling& state) {
  const ModalState at = analyses_.Modal().At(program, id);
  Store(program, WordsOf(id, AxesOf(at.plane).normal, IsHole(state.cycle)), at.distance == Distance::kIncremental,
        state, nullptr);
}

std::optional<Drilling> DrillingFlow::Into(const analysis::CallSite&, analysis::CallMoment moment,
                                           const Drilling& at) const {
  if (moment == analysis::CallMoment::kModalStart) return std::nullopt;
  if (!IsHole(at.cycle)) return Drilling{.cycle = at.cycle};
  return moment == analysis::CallMoment::kModalRun ? Unknown({}) : Drilling{};
}

Drilling DrillingFlow::Back(const analysis::CallSite&, const Drilling& at, const Drilling& exit) const {
  if (exit.cycle == Drilling::kCallers) return at;
  return {.cycle = exit.cycle == Drilling::kNoCycle ? Drilling::kNoCycle : Drilling::kOpen};
}

DrillingWords DrillingFlow::WordsOf(BlockId id, std::uint8_t normal, bool in_cycle) const {
  DrillingWords parts;
  const Block& block = module_.blocks[id];
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
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
    if (!IsHole(parts.cycle) || !IsHole(state.cycle)) state = {};
    state.cycle = parts.cycle;
  } else if (parts.motion) {
    state = {};
  }
  if (!IsHole(state.cycle)) return;
  // A place, a depth or a level begins the first hole: there the initial level is taken.
  bool begins = parts.geometry;
  for (const Word* value : parts.values) begins = begins || value != nullptr;
  if (begins && !state.initial) {
    state.initial = true;
    if (assigns != nullptr) {
      assigns->emplace_back(Initial(program), ExprId{});
    } else {
      static_cast<void>(Initial(program));
    }
  }
  for (std::uint8_t field = 0; field < Drilling::kFields; ++field) {
    const Word* word = parts.values[field];
    if (word == nullptr) continue;
    const bool step = field == Drilling::kDepth && word->mode == ValueMode::kIncremental;
    const bool adds = (incremental && (field == Drilling::kLevel || field == Drilling::kDepth)) || step;
    if (LiteralOf(word->value) && !adds) {
      state.fields[field] = word->value.value;
      continue;
    }
    state.fields[field] = Local(program, field).value;
    if (assigns == nullptr) continue;
    const ExprId base = field == Drilling::kLevel ? Initial(program) : ExprId{state.fields[Drilling::kLevel]};
    assigns->emplace_back(Local(program, field), adds ? make_.Binary(ExprOp::kAdd, base, word->value) : word->value);
  }
}

}  // namespace ncport::ir::transform
