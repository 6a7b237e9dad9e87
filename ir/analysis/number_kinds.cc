#include "ir/analysis/number_kinds.h"

#include <algorithm>
#include <cmath>

#include "ir/analysis/cfg.h"
#include "ir/analysis/unwritten_cells.h"

namespace ncport::ir::analysis {

namespace {

constexpr int kDigits = 12;

NumberKind Join(NumberKind a, NumberKind b) { return std::max(a, b); }

bool IsCount(Type type) { return type == Type::kInt || type == Type::kBool || type == Type::kChar; }

NumberKind OfLiteral(const Expr& literal) {
  if (literal.number == std::floor(literal.number) && std::fabs(literal.number) < 1e12) return NumberKind::kWhole;
  const bool plain = (literal.format.flags & (NumberFormat::kAsText | NumberFormat::kComputed)) == 0;
  return plain && literal.format.int_digits + literal.format.decimals <= kDigits ? NumberKind::kWritten
                                                                                 : NumberKind::kComputed;
}

}  // namespace

NumberKinds::NumberKinds(const Module& module, const CallGraph& calls, bool counters_round)
    : module_(module),
      graphs_(module),
      counters_round_(counters_round),
      variables_(module.variables.Size(), NumberKind::kNever),
      any_cell_(module.spaces.Size(), NumberKind::kNever),
      whole_space_(module.spaces.Size(), NumberKind::kNever),
      input_space_(module.spaces.Size(), false) {
  for (const UnwrittenRead& read : UnwrittenCells(module, graphs_, calls)) {
    if (read.cell == UnwrittenRead::kComputed) {
      input_space_[read.space.value] = true;
    } else {
      inputs_.emplace(read.space.value, read.cell);
    }
  }
  std::vector<bool> called(module.programs.Size(), false);
  for (const CallSite& site : calls.AllSites()) {
    if (site.callee.Valid()) called[site.callee.value] = true;
    modal_ = modal_ || site.modal;
  }
  for (const ProgramId program : module.programs.Ids()) {
    const IdRange<VariableId> parameters = module.programs[program].parameters;
    if (called[program.value]) continue;
    // Callers that are not known: a person wrote the arguments.
    for (const VariableId parameter : parameters) Give(parameter, NumberKind::kWritten);
  }
  Run();
}

void NumberKinds::Give(VariableId variable, NumberKind kind) {
  const Variable& known = module_.variables[variable];
  // What is handed over by reference is written under another name too.
  if (known.by_reference) kind = NumberKind::kComputed;
  if (IsCount(known.type)) kind = NumberKind::kWhole;
  NumberKind& held = variables_[variable.value];
  if (Join(held, kind) == held) return;
  held = Join(held, kind);
  changed_ = true;
}

void NumberKinds::Give(ExprId place, NumberKind kind) {
  const Expr& expr = module_.exprs[place];
  const auto raise = [&](NumberKind& held) {
    if (Join(held, kind) == held) return;
    held = Join(held, kind);
    changed_ = true;
  };
  switch (expr.op) {
    case ExprOp::kVariable:
    case ExprOp::kElement:
      return Give(VariableId{expr.a}, kind);
    case ExprOp::kCell:
      raise(cells_[{expr.a, expr.b}]);
      return raise(whole_space_[expr.a]);
    case ExprOp::kCellAt:
      raise(any_cell_[expr.b]);
      return raise(whole_space_[expr.b]);
    case ExprOp::kGroup:
    case ExprOp::kConvert:
      return Give(ExprId{expr.a}, kind);
    default:
      return;  // system variables are computed anyhow
  }
}

NumberKind NumberKinds::OfCell(SpaceId space, std::uint32_t cell) const {
  if (IsCount(module_.spaces[space].type)) return NumberKind::kWhole;
  const auto known = cells_.find({space.value, cell});
  NumberKind kind = Join(known == cells_.end() ? NumberKind::kNever : known->second, any_cell_[space.value]);
  if (input_space_[space.value] || inputs_.contains({space.value, cell})) kind = Join(kind, NumberKind::kWritten);
  return kind;
}

const NumberKind* NumberKinds::Slot(const Expr& place, const State* state) const {
  if (state == nullptr) return nullptr;
  const CellKey key = place.op == ExprOp::kCell ? CellKey{place.a, place.b} : CellKey{kNoSpace, place.a};
  const auto slot = flow_.slots.find(key);
  return slot == flow_.slots.end() ? nullptr : &(*state)[slot->second];
}

NumberKind NumberKinds::Of(ExprId id, const State* state) const {
  const Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kCell) {
    if (const NumberKind* held = Slot(expr, state)) return *held;
  }
  const auto left = [&] { return Of(ExprId{expr.a}, state); };
  switch (expr.op) {
    case ExprOp::kLiteral:
      return OfLiteral(expr);
    case ExprOp::kVariable:
    case ExprOp::kElement: {
      if (IsCount(expr.type)) return NumberKind::kWhole;
      // Never written: the zero it starts with.
      return expr.a < variables_.size() ? Join(variables_[expr.a], NumberKind::kWhole) : NumberKind::kComputed;
    }
    case ExprOp::kCell:
      return Join(OfCell(SpaceId{expr.a}, expr.b), NumberKind::kWhole);
    case ExprOp::kCellAt: {
      if (IsCount(module_.spaces[SpaceId{expr.b}].type)) return NumberKind::kWhole;
      return Join(whole_space_[expr.b], NumberKind::kWritten);
    }
    case ExprOp::kConvert:
      return IsCount(expr.type) ? NumberKind::kWhole : left();
    case ExprOp::kGroup:
    case ExprOp::kNegate:
    case ExprOp::kPlus:
      return left();
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kModulo: {
      // A sum of counts is a count; a product may grow beyond what doubles tell apart.
      const NumberKind both = Join(left(), Of(ExprId{expr.b}, state));
      return both <= NumberKind::kWhole ? both : NumberKind::kComputed;
    }
    case ExprOp::kMultiply: {
      const NumberKind both = Join(left(), Of(ExprId{expr.b}, state));
      if (both == NumberKind::kNever) return both;
      const bool literal = module_.exprs[ExprId{expr.a}].op == ExprOp::kLiteral ||
                           module_.exprs[ExprId{expr.b}].op == ExprOp::kLiteral || IsCount(expr.type);
      return both == NumberKind::kWhole && literal ? both : NumberKind::kComputed;
    }
    case ExprOp::kDivideInteger:
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
    case ExprOp::kBitNot:
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor:
    case ExprOp::kNot:
      return NumberKind::kWhole;
    case ExprOp::kFunction:
      switch (static_cast<Function>(expr.a)) {
        case Function::kTruncate:
        case Function::kRound:
        case Function::kRoundUp:
        case Function::kRoundAway:
          return NumberKind::kWhole;
        case Function::kAbs:
        case Function::kMinimum:
        case Function::kMaximum:
        case Function::kBound: {
          NumberKind kind = NumberKind::kNever;
          for (std::uint32_t i = 0; i < expr.count; ++i) kind = Join(kind, Of(module_.Item(expr.b + i), state));
          return kind;
        }
        default:
          return NumberKind::kComputed;
      }
    default:
      return NumberKind::kComputed;
  }
}

void NumberKinds::ReadCall(const Call& call) {
  // An argument may be handed over by reference, which the caller's text does not always tell.
  const IdRange<VariableId> parameters =
      call.program.Valid() ? module_.programs[call.program].parameters : IdRange<VariableId>{};
  std::vector<bool> given(parameters.count, false);
  for (const ArgId id : call.args) {
    const Arg& arg = module_.args[id];
    if (!arg.value.Valid()) continue;
    if (arg.letter == 0 && arg.position < parameters.count) {
      const VariableId parameter = parameters[arg.position];
      given[arg.position] = true;
      if (module_.variables[parameter].by_reference) Give(arg.value, NumberKind::kComputed);
      // The call may be written anew by hand: its argument is at least a written number.
      Give(parameter, Join(Of(arg.value), NumberKind::kWritten));
    } else {
      Give(arg.value, NumberKind::kComputed);
    }
  }
  for (std::uint32_t i = 0; i < parameters.count; ++i) {
    const Variable& parameter = module_.variables[parameters[i]];
    if (given[i]) continue;
    Give(parameters[i], parameter.initial.Valid() ? Of(parameter.initial) : NumberKind::kWhole);
  }
}

void NumberKinds::Read(const Block& block) {
  for (const WordId id : block.words) {
    const Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kAssign:
        Give(word.Extra<ExprId>(), Of(word.value));
        break;
      case WordOp::kAssignList: {
        const AssignList& list = module_.assign_lists[word.Extra<AssignListId>()];
        if (list.place.Valid()) Give(list.place, NumberKind::kComputed);
        break;
      }
      case WordOp::kDefine: {
        const VariableId variable = word.Extra<VariableId>();
        const Variable& known = module_.variables[variable];
        if (known.initial.Valid()) Give(variable, Of(known.initial));
        if (known.initial_list.Valid()) Give(variable, NumberKind::kComputed);
        break;
      }
      case WordOp::kFor: {
        const For& loop = module_.fors[word.Extra<ForId>()];
        const NumberKind start = counters_round_ ? NumberKind::kWhole : Of(word.value);
        const NumberKind step = loop.step.Valid() ? Of(loop.step) : NumberKind::kWhole;
        const NumberKind both = Join(start, step);
        Give(loop.variable, both <= NumberKind::kWhole ? NumberKind::kWhole : NumberKind::kComputed);
        break;
      }
      case WordOp::kCall:
      case WordOp::kModalCall:
        if (word.Extra<CallId>().Valid()) ReadCall(module_.calls[word.Extra<CallId>()]);
        break;
      default:
        break;
    }
  }
}

void NumberKinds::Run() {
  // Each kind only climbs, so this ends.
  do {
    changed_ = false;
    for (const Program& program : module_.programs.All()) {
      for (const BlockId id : program.blocks) Read(module_.blocks[id]);
    }
  } while (changed_);
}

NumberKind NumberKinds::Everywhere(const CellKey& slot) const {
  if (slot.first != kNoSpace) return Join(OfCell(SpaceId{std::size_t{slot.first}}, slot.second), NumberKind::kWhole);
  const VariableId variable{std::size_t{slot.second}};
  if (IsCount(module_.variables[variable].type)) return NumberKind::kWhole;
  return Join(variables_[variable.value], NumberKind::kWhole);
}

NumberKinds::State NumberKinds::Through(const Block& block, State state) const {
  bool conditional = block.skip_level != Block::kNoSkip;
  const State before = state;
  for (const WordId id : block.words) {
    const Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kAssign: {
        const Expr& place = module_.exprs[word.Extra<ExprId>()];
        if (place.op == ExprOp::kCellAt) {
          const NumberKind kind = Of(word.value, &state);
          for (const auto& [key, slot] : flow_.slots) {
            if (key.first == place.b) state[slot] = Join(state[slot], kind);
          }
          break;
        }
        if (place.op != ExprOp::kVariable && place.op != ExprOp::kCell) break;
        const CellKey key = place.op == ExprOp::kCell ? CellKey{place.a, place.b} : CellKey{kNoSpace, place.a};
        const auto slot = flow_.slots.find(key);
        if (slot == flow_.slots.end()) break;
        const bool count = IsCount(place.op == ExprOp::kCell ? module_.spaces[SpaceId{place.a}].type : place.type);
        state[slot->second] = count ? NumberKind::kWhole : Of(word.value, &state);
        break;
      }
      case WordOp::kDefine: {
        const VariableId variable = word.Extra<VariableId>();
        const auto slot = flow_.slots.find({kNoSpace, variable.value});
        if (slot == flow_.slots.end()) break;
        const ExprId initial = module_.variables[variable].initial;
        state[slot->second] = initial.Valid() ? Of(initial, &state) : NumberKind::kWhole;
        if (IsCount(module_.variables[variable].type)) state[slot->second] = NumberKind::kWhole;
        break;
      }
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        conditional = true;
        break;
      case WordOp::kAssignList:
      case WordOp::kCall:
      case WordOp::kModalCall:
      case WordOp::kRepeatPart:
      case WordOp::kVerbatim:
        for (const auto& [key, slot] : flow_.slots) state[slot] = Everywhere(key);
        break;
      default:
        break;
    }
  }
  if (conditional) {
    for (std::size_t i = 0; i < state.size(); ++i) state[i] = Join(state[i], before[i]);
  }
  return state;
}

void NumberKinds::Follow(ProgramId program) {
  flow_ = {};
  flow_.program = program;
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  if (blocks.Empty()) return;
  // Where only the run knows what follows a block, nothing is followed.
  bool opaque = graphs_.Of(program).Opaque();
  for (const BlockId id : blocks) {
    for (const WordId word : module_.blocks[id].words) {
      const Word& call = module_.words[word];
      if (call.op != WordOp::kCall || !call.Extra<CallId>().Valid()) continue;
      const Call& known = module_.calls[call.Extra<CallId>()];
      opaque = opaque || known.form == CallForm::kBlockRange || known.from_block;
    }
  }
  for (const BlockId id : blocks) {
    if (opaque) break;
    for (const WordId word : module_.blocks[id].words) {
      if (module_.words[word].op != WordOp::kAssign) continue;
      const Expr& place = module_.exprs[module_.words[word].Extra<ExprId>()];
      if (place.op == ExprOp::kCell) flow_.slots.emplace(CellKey{place.a, place.b}, flow_.slots.size());
      if (place.op == ExprOp::kVariable && !module_.variables[VariableId{place.a}].by_reference)
        flow_.slots.emplace(CellKey{kNoSpace, place.a}, flow_.slots.size());
    }
  }
  // Counters of FOR are written by the loop itself: they stay what they are everywhere.
  for (const For& loop : module_.fors.All()) {
    const Expr& place = module_.exprs[loop.variable];
    flow_.slots.erase(place.op == ExprOp::kCell ? CellKey{place.a, place.b} : CellKey{kNoSpace, place.a});
  }
  std::size_t next = 0;
  for (auto& [key, slot] : flow_.slots) slot = next++;
  State entry(flow_.slots.size());
  for (const auto& [key, slot] : flow_.slots) entry[slot] = Everywhere(key);
  const Cfg& graph = graphs_.Of(program);
  const auto merge = [&](BlockId id, const State& state) {
    const auto [known, fresh] = flow_.before.try_emplace(id, state);
    if (fresh) return true;
    bool changed = false;
    for (std::size_t i = 0; i < state.size(); ++i) {
      const NumberKind joined = Join(known->second[i], state[i]);
      changed = changed || joined != known->second[i];
      known->second[i] = joined;
    }
    return changed;
  };
  merge(blocks[0], entry);
  for (bool changed = true; changed;) {
    changed = false;
    for (const BlockId id : blocks) {
      const auto before = flow_.before.find(id);
      if (before == flow_.before.end()) continue;
      const State after = Through(module_.blocks[id], before->second);
      flow_.after[id] = after;
      for (const Edge& edge : graph.Successors(id)) {
        if (edge.to.Valid()) {
          changed = merge(edge.to, after) || changed;
        } else if (edge.kind == EdgeKind::kComputed) {
          for (const BlockId target : graph.ComputedTargets()) changed = merge(target, entry) || changed;
        }
      }
    }
  }
}

NumberKind NumberKinds::At(ProgramId program, BlockId block, ExprId expr) {
  if (modal_ || graphs_.Of(program).Opaque()) return Of(expr);
  if (flow_.program != program) Follow(program);
  const auto before = flow_.before.find(block);
  if (before == flow_.before.end()) return Of(expr);
  // Assignments of the block itself may stand in front of the expression or behind it.
  return Join(Of(expr, &before->second), Of(expr, &flow_.after.at(block)));
}

}  // namespace ncport::ir::analysis
