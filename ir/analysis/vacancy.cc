#include "ir/analysis/vacancy.h"

#include <algorithm>
#include <utility>

namespace ncport::ir::analysis {

Vacancy::Vacancy(const Module& module, const Machine& machine, const FlowGraphs& graphs, const CallGraph& calls,
                 VacancyConfig config)
    : module_(module),
      calls_(calls),
      config_(std::move(config)),
      flow_({module, machine, graphs, calls, nullptr}, *this) {
  FindCells();
  FindWrites();
  flow_.Run();
}

bool Vacancy::Join(BlockId, State& into, const State& from) {
  bool changed = false;
  for (std::size_t i = 0; i < into.size(); ++i) {
    const auto joined = static_cast<std::uint8_t>(into[i] | from[i]);
    changed = changed || joined != into[i];
    into[i] = joined;
  }
  return changed;
}

/// Brackets, the sign of a word (`X-#1`), and what passes make of a word's value (its unit, its rounding) hide no
/// emptiness; operations that the source wrote do: they have kVacantAsZero.
ExprId Vacancy::Bare(ExprId id) const {
  while (id.Valid()) {
    const Expr& expr = module_.exprs[id];
    const bool written = (expr.flags & Expr::kVacantAsZero) != 0;
    switch (expr.op) {
      case ExprOp::kGroup:
      case ExprOp::kConvert:
        break;
      case ExprOp::kNegate:
      case ExprOp::kPlus:
        if (written) return id;
        break;
      case ExprOp::kMultiply:
      case ExprOp::kDivide:
        if (written || module_.exprs[ExprId{std::size_t{expr.b}}].op != ExprOp::kLiteral) return id;
        break;
      case ExprOp::kFunction:
        if (written || static_cast<Function>(expr.a) != Function::kRound) return id;
        id = module_.Item(expr.b);
        continue;
      default:
        return id;
    }
    id = ExprId{std::size_t{expr.a}};
  }
  return id;
}

std::optional<std::size_t> Vacancy::IndexOf(ExprId id) const {
  const ExprId bare = Bare(id);
  if (!bare.Valid()) return std::nullopt;
  const Expr& expr = module_.exprs[bare];
  if (expr.op != ExprOp::kCell) return std::nullopt;
  const auto found = index_.find({expr.a, expr.b});
  return found == index_.end() ? std::nullopt : std::optional(found->second);
}

std::uint8_t Vacancy::ClassOf(ExprId id, const State& state) const {
  const ExprId bare = Bare(id);
  if (!bare.Valid()) return kEmpty;
  const Expr& expr = module_.exprs[bare];
  if (expr.op == ExprOp::kVacant) return kEmpty;
  if (expr.op == ExprOp::kCellAt) {
    if (!IsTracked(SpaceId{std::size_t{expr.b}})) return kNumber;
    std::uint8_t bits = 0;
    if (!Reached(expr, [&](std::size_t index) { bits = static_cast<std::uint8_t>(bits | (state[index] & kUnsure)); }))
      return kUnsure;
    return bits == 0 ? kUnsure : bits;
  }
  const auto index = IndexOf(bare);
  return index ? static_cast<std::uint8_t>(state[*index] & kUnsure) : kNumber;
}

void Vacancy::FindCells() {
  const auto track = [&](const Space& record, SpaceId space, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t cell = std::max(first, record.first); cell <= std::min(last, record.last); ++cell)
      index_.try_emplace({space.value, cell}, 0);
  };
  for (const Expr& expr : module_.exprs.All()) {
    if (expr.op == ExprOp::kCell && IsTracked(SpaceId{std::size_t{expr.a}})) index_.try_emplace({expr.a, expr.b}, 0);
    const bool compares = expr.op == ExprOp::kEqual || expr.op == ExprOp::kNotEqual;
    if (compares && (expr.flags & Expr::kVacantDiffers) != 0) {
      const Expr& a = module_.exprs[Bare(ExprId{std::size_t{expr.a}})];
      const Expr& b = module_.exprs[Bare(ExprId{std::size_t{expr.b}})];
      if (a.op == ExprOp::kCell && b.op == ExprOp::kVacant) asked_.insert(a.b);
      if (b.op == ExprOp::kCell && a.op == ExprOp::kVacant) asked_.insert(b.b);
    }
    if (expr.op != ExprOp::kCellAt) continue;
    const auto range = IndexRangeOf(module_, ExprId{std::size_t{expr.a}});
    for (const SpaceId space : module_.spaces.Ids()) {
      if (range && IsTracked(space)) track(module_.spaces[space], space, range->first, range->last);
    }
  }
  for (const SpaceId space : module_.spaces.Ids()) {
    if (IsTracked(space) && module_.spaces[space].visibility == Visibility::kLevel) local_space_ = space;
  }
  for (const Arg& arg : module_.args.All()) {
    if (arg.letter != 0 && local_space_.Valid()) index_.try_emplace({local_space_.value, arg.position}, 0);
  }
  for (auto& [cell, index] : index_) {
    index = cells_.size();
    cells_.emplace_back(SpaceId{std::size_t{cell.first}}, cell.second);
    local_.push_back(module_.spaces[cells_.back().first].visibility == Visibility::kLevel ? 1 : 0);
  }
}

void Vacancy::FindWrites() {
  writes_.resize(module_.programs.Size());
  for (const ProgramId program : calls_.BottomUp()) {
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId word_id : module_.blocks[block].words) {
        const Word& word = module_.words[word_id];
        if (word.op != WordOp::kAssign) continue;
        const ExprId place = word.Extra<ExprId>();
        if (const auto index = IndexOf(place)) writes_[program.value].insert(*index);
        if (module_.exprs[place].op != ExprOp::kCellAt) continue;
        if (Reached(module_.exprs[place], [&](std::size_t index) { writes_[program.value].insert(index); })) continue;
        for (std::size_t i = 0; i < cells_.size(); ++i) writes_[program.value].insert(i);
      }
    }
  }
  // Through calls, until nothing new comes: programs may call each other in a circle.
  for (bool again = true; again;) {
    again = false;
    for (const CallSite& site : calls_.AllSites()) {
      if (!site.callee.Valid()) continue;
      const bool shares = !module_.calls[site.call].new_level;
      for (const std::size_t index : writes_[site.callee.value]) {
        if (IsLocal(index) && !shares) continue;
        again = writes_[site.caller.value].insert(index).second || again;
      }
    }
  }
}

Vacancy::State Vacancy::Entry(ProgramId program) {
  const bool main = module_.programs[program].kind == ProgramKind::kMain;
  State state = Unknown(program);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (IsLocal(i) && main) state[i] = kEmpty;
    const std::uint32_t cell = cells_[i].second;
    if (!IsLocal(i) && config_.holds_number && config_.holds_number(cell)) state[i] = kNumber | kFromEntry;
    if (IsLocal(i) && !main && !asked_.contains(cell) && config_.given && config_.given(program, cell)) {
      state[i] = kNumber | kFromEntry;
      taken_for_given_.emplace(program, cell);
    }
  }
  return state;
}

bool Vacancy::Along(ProgramId, BlockId block, const Edge& edge, State& state) const {
  const Test test = TestOf(block);
  if (!test.cell || (edge.kind != test.holds && edge.kind != test.fails)) return true;
  const bool empty = test.empty == (edge.kind == test.holds);
  std::uint8_t& bits = state[*test.cell];
  if ((bits & (empty ? kEmpty : kNumber)) == 0) return false;
  bits = static_cast<std::uint8_t>(bits & ~(empty ? kNumber : kEmpty));
  return true;
}

Vacancy::Test Vacancy::TestOf(BlockId id) const {
  const Block& block = module_.blocks[id];
  Test test;
  if (block.words.count != 1 || block.skip_level != Block::kNoSkip) return test;
  const Word& word = module_.words[block.words[0]];
  if (word.op == WordOp::kJump) {
    test.holds = EdgeKind::kJump;
    test.fails = EdgeKind::kNext;
  } else if (word.op == WordOp::kIf || word.op == WordOp::kWhile) {
    test.holds = EdgeKind::kNext;
    test.fails = EdgeKind::kFalse;
  } else {
    return test;
  }
  if (!word.value.Valid()) return test;
  const Expr& condition = module_.exprs[Bare(word.value)];
  if ((condition.op != ExprOp::kEqual && condition.op != ExprOp::kNotEqual) ||
      (condition.flags & Expr::kVacantDiffers) == 0)
    return test;
  const ExprId left = Bare(ExprId{std::size_t{condition.a}}), right = Bare(ExprId{std::size_t{condition.b}});
  if (module_.exprs[right].op == ExprOp::kVacant) test.cell = IndexOf(left);
  if (module_.exprs[left].op == ExprOp::kVacant) test.cell = IndexOf(right);
  test.empty = condition.op == ExprOp::kEqual;
  return test;
}

void Vacancy::Transfer(ProgramId, BlockId block, State& state) const {
  for (const WordId id : module_.blocks[block].words) ThroughAssign(module_.words[id], state);
}

void Vacancy::ThroughAssign(const Word& word, State& state) const {
  if (word.op != WordOp::kAssign) return;
  const ExprId place = word.Extra<ExprId>();
  if (const auto index = IndexOf(place)) state[*index] = ClassOf(word.value, state);
  if (module_.exprs[place].op != ExprOp::kCellAt) return;
  // One of them is written, the others stay.
  const std::uint8_t made = ClassOf(word.value, state);
  const bool known = Reached(module_.exprs[place],
                             [&](std::size_t index) { state[index] = static_cast<std::uint8_t>(state[index] | made); });
  for (std::uint8_t& bits : state) bits = known ? bits : static_cast<std::uint8_t>(bits | kUnsure);
}

/// A word once the flow is known: what holds for the words behind it.
void Vacancy::ThroughWord(ProgramId program, BlockId block, WordId id, State& state) const {
  const Word& word = module_.words[id];
  ThroughAssign(word, state);
  if (word.op != WordOp::kCall) return;
  const auto call = word.Extra<CallId>();
  const ProgramId callee = module_.calls[call].program;
  const State* exit = callee.Valid() ? flow_.Exit(callee) : nullptr;
  if (callee.Valid() && exit == nullptr) return;  // no way back
  state = Back({program, block, id, call, callee}, state, exit != nullptr ? *exit : Unknown(program));
}

std::optional<Vacancy::State> Vacancy::Into(const CallSite& site, CallMoment moment, const State& at) const {
  const Call& call = module_.calls[site.call];
  State entry = at;
  if (!call.new_level) return entry;
  for (std::size_t i = 0; i < entry.size(); ++i) {
    // A modal call takes its locals where it is written, and what its runs left of them.
    if (IsLocal(i)) entry[i] = moment == CallMoment::kModalRun ? std::uint8_t{0} : kEmpty;
  }
  if (moment == CallMoment::kModalRun) return entry;
  for (const ArgId id : call.args) {
    const Arg& arg = module_.args[id];
    const auto found = index_.find({local_space_.value, arg.position});
    if (arg.letter != 0 && found != index_.end()) entry[found->second] = ClassOf(arg.value, at);
  }
  return entry;
}

Vacancy::State Vacancy::Back(const CallSite& site, const State& at, const State& exit) const {
  const Call& call = module_.calls[site.call];
  if (!site.callee.Valid()) return call.name_expr.Valid() ? exit : at;  // one that is not found has its finding
  State behind = at;
  for (const std::size_t index : writes_[site.callee.value]) {
    if (IsLocal(index) && call.new_level) continue;
    behind[index] = exit[index];
  }
  return behind;
}

}  // namespace ncport::ir::analysis
