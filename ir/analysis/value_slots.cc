#include "ir/analysis/value_slots.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ncport::ir::analysis {

namespace {

constexpr std::uint64_t kVariableKey = std::uint64_t{1} << 62U;
constexpr std::uint64_t kLoopKey = std::uint64_t{2} << 62U;

std::uint64_t KeyOf(SpaceId space, std::uint32_t cell) { return std::uint64_t{space.value} << 32U | cell; }
std::uint64_t KeyOf(VariableId variable) { return kVariableKey | variable.value; }
std::uint64_t KeyOf(ForId loop) { return kLoopKey | loop.value; }

}  // namespace

bool JoinInto(ValueState& into, const ValueState& from) {
  if (!from.reached) return false;
  if (!into.reached) {
    into = from;
    return true;
  }
  bool changed = false;
  for (std::size_t i = 0; i < into.cells.size(); ++i) {
    if (into.cells[i] == from.cells[i]) continue;
    const Interval joined = Join(into.cells[i], from.cells[i]);
    if (joined == into.cells[i]) continue;
    into.cells[i] = joined;
    changed = true;
  }
  return changed;
}

SlotMap::SlotMap(const Module& module, const CallGraph& calls, ProgramId start, bool program_variables_visible)
    : module_(module), program_variables_visible_(program_variables_visible) {
  std::set<std::uint32_t> seen{start.value};
  programs_.push_back(start);
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    for (const CallSite& site : calls.SitesOf(programs_[i])) {
      if (site.callee.Valid() && seen.insert(site.callee.value).second) programs_.push_back(site.callee);
    }
  }
  for (const ProgramId program : programs_) {
    locals_[program.value];
    Scan(program);
  }
  // Numbers: shared ones first.
  for (const std::uint64_t key : shared_keys_) {
    if (!index_.emplace(key, static_cast<std::uint32_t>(shared_.size())).second) continue;
    Slot slot;
    if ((key & kVariableKey) != 0) {
      slot.kind = SlotKind::kVariable;
      slot.id = static_cast<std::uint32_t>(key);
    } else {
      slot.id = static_cast<std::uint32_t>(key >> 32U);
      slot.number = static_cast<std::uint32_t>(key);
      slot.level = module.spaces[SpaceId{std::size_t{slot.id}}].visibility == Visibility::kLevel;
    }
    shared_.push_back(slot);
  }
  for (const ProgramId program : programs_) {
    std::vector<Slot>& locals = locals_[program.value];
    std::vector<Slot> kept;
    for (const Slot& slot : locals) {
      const std::uint64_t key = slot.kind == SlotKind::kVariable ? KeyOf(VariableId{std::size_t{slot.id}})
                                                                 : KeyOf(ForId{std::size_t{slot.id}});
      if (!index_.emplace(key, static_cast<std::uint32_t>(shared_.size() + kept.size())).second) continue;
      kept.push_back(slot);
    }
    locals = std::move(kept);
  }
  std::ranges::sort(landmarks_);
  landmarks_.erase(std::unique(landmarks_.begin(), landmarks_.end()), landmarks_.end());
  std::ranges::sort(opaque_);
  MarkChanges(calls);
}

std::uint32_t SlotMap::Of(SpaceId space, std::uint32_t cell) const {
  const auto found = index_.find(KeyOf(space, cell));
  return found == index_.end() ? kNone : found->second;
}

std::uint32_t SlotMap::Of(VariableId variable) const {
  const auto found = index_.find(KeyOf(variable));
  return found == index_.end() ? kNone : found->second;
}

std::uint32_t SlotMap::Of(ForId loop) const {
  const auto found = index_.find(KeyOf(loop));
  return found == index_.end() ? kNone : found->second;
}

bool SlotMap::IsWritten(VariableId variable) const {
  return std::ranges::any_of(writes_, [&](const auto& write) { return write.second == KeyOf(variable); });
}

bool SlotMap::IsOpaque(ProgramId program) const { return std::ranges::binary_search(opaque_, program.value); }

void SlotMap::AddVariable(ProgramId program, VariableId id) {
  const Variable& variable = module_.variables[id];
  // Variables of the main program are its own where no other program can see them.
  const bool own_scope = variable.scope == Scope::kLocal || variable.scope == Scope::kParameter ||
                         (variable.scope == Scope::kProgram && !program_variables_visible_);
  const bool local = own_scope && variable.owner == program;
  if (local) {
    Slot slot;
    slot.kind = SlotKind::kVariable;
    slot.id = id.value;
    locals_[program.value].push_back(slot);
  } else {
    shared_keys_.push_back(KeyOf(id));
  }
}

void SlotMap::Scan(ProgramId program) {
  const Program& record = module_.programs[program];
  for (const VariableId parameter : record.parameters) {
    AddVariable(program, parameter);
    ScanExpr(program, module_.variables[parameter].initial, false);
  }
  for (const BlockId block : record.blocks) {
    for (const WordId word : module_.blocks[block].words) ScanWord(program, word);
  }
}

void SlotMap::ScanExpr(ProgramId program, ExprId id, bool written) {
  if (!id.Valid()) return;
  const Expr& expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kLiteral:
      if (std::isfinite(expr.number)) {
        for (const double side : {-1.0, 0.0, 1.0}) landmarks_.push_back(expr.number + side);
      }
      return;
    case ExprOp::kVariable:
      AddVariable(program, VariableId{std::size_t{expr.a}});
      if (written) writes_.emplace_back(program.value, KeyOf(VariableId{std::size_t{expr.a}}));
      return;
    case ExprOp::kCell:
      shared_keys_.push_back(KeyOf(SpaceId{std::size_t{expr.a}}, expr.b));
      if (written) writes_.emplace_back(program.value, KeyOf(SpaceId{std::size_t{expr.a}}, expr.b));
      return;
    case ExprOp::kCellAt:
      if (written) computed_writes_.emplace_back(program.value, expr.b);
      return ScanExpr(program, ExprId{std::size_t{expr.a}}, false);
    case ExprOp::kElement:
      AddVariable(program, VariableId{std::size_t{expr.a}});
      if (written) writes_.emplace_back(program.value, KeyOf(VariableId{std::size_t{expr.a}}));
      break;
    case ExprOp::kGroup:
      return ScanExpr(program, ExprId{std::size_t{expr.a}}, written);
    default:
      break;
  }
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return;
    case Operands::kUnary:
      return ScanExpr(program, ExprId{std::size_t{expr.a}}, false);
    case Operands::kBinary:
      ScanExpr(program, ExprId{std::size_t{expr.a}}, false);
      return ScanExpr(program, ExprId{std::size_t{expr.b}}, false);
    case Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) ScanExpr(program, module_.Item(expr.b + i), false);
      return;
  }
}

void SlotMap::ScanCall(ProgramId program, CallId id, bool modal) {
  if (!id.Valid()) return;
  const Call& call = module_.calls[id];
  ScanExpr(program, call.name_expr, false);
  ScanExpr(program, call.passes, false);
  for (const ArgId arg : call.args) {
    ScanExpr(program, module_.args[arg].value, true);  // perhaps by reference
    if (module_.args[arg].letter == 0) continue;
    // A lettered argument fills a cell of the level below.
    for (const SpaceId space : module_.spaces.Ids()) {
      const Space& record = module_.spaces[space];
      const std::uint32_t cell = module_.args[arg].position;
      if (record.visibility == Visibility::kLevel && cell >= record.first && cell <= record.last)
        shared_keys_.push_back(KeyOf(space, cell));
    }
  }
  const bool range = call.form == CallForm::kBlockRange || call.from_block;
  const ProgramId target = call.form == CallForm::kBlockRange && !call.program.Valid() ? program : call.program;
  if (range && target.Valid()) opaque_.push_back(target.value);
  if (range) opaque_.push_back(program.value);
  if (call.form != CallForm::kName && call.form != CallForm::kBlockRange && !call.program.Valid()) open_calls_ = true;
  if (!modal) return;
  if (call.program.Valid()) {
    for (const VariableId parameter : module_.programs[call.program].parameters) {
      // A variable of this program that changes at any motion.
      if (module_.variables[parameter].by_reference) opaque_.push_back(program.value);
    }
    modal_callees_.push_back(call.program.value);
  } else {
    open_modal_ = true;
  }
}

void SlotMap::ScanWord(ProgramId program, WordId id) {
  const Word& word = module_.words[id];
  ScanExpr(program, word.value, false);
  switch (word.op) {
    case WordOp::kAssign:
      return ScanExpr(program, word.Extra<ExprId>(), true);
    case WordOp::kAlarm:
    case WordOp::kAxisComputed:
    case WordOp::kMessage:
      return ScanExpr(program, word.Extra<ExprId>(), false);
    case WordOp::kDefine: {
      const auto variable = word.Extra<VariableId>();
      AddVariable(program, variable);
      ScanExpr(program, module_.variables[variable].initial, false);
      writes_.emplace_back(program.value, KeyOf(variable));
      return;
    }
    case WordOp::kAssignList: {
      const AssignList& list = module_.assign_lists[word.Extra<AssignListId>()];
      ScanExpr(program, list.place, true);
      ScanExpr(program, list.count, false);
      for (const ExprItemId item : list.values) ScanExpr(program, module_.Item(item.value), false);
      return;
    }
    case WordOp::kCall:
    case WordOp::kModalCall:
      return ScanCall(program, word.Extra<CallId>(), word.op == WordOp::kModalCall);
    case WordOp::kFor: {
      const auto id_of = word.Extra<ForId>();
      const For& loop = module_.fors[id_of];
      ScanExpr(program, loop.variable, true);
      ScanExpr(program, loop.end, false);
      ScanExpr(program, loop.step, false);
      Slot slot;
      slot.kind = SlotKind::kLoopEnd;
      slot.id = id_of.value;
      locals_[program.value].push_back(slot);
      return;
    }
    case WordOp::kSwitch: {
      const Switch& choice = module_.switches[word.Extra<SwitchId>()];
      for (std::uint32_t i = 0; i < choice.arm_count; ++i)
        ScanExpr(program, module_.switch_arms[choice.first_arm + i].value, false);
      return;
    }
    default:
      return;
  }
}

/// Cells that subprograms after motion write: their values hold nowhere between two blocks.
void SlotMap::MarkChanges(const CallGraph& calls) {
  if (modal_callees_.empty() && !open_modal_) return;
  std::set<std::uint32_t> below(modal_callees_.begin(), modal_callees_.end());
  std::vector<std::uint32_t> work(below.begin(), below.end());
  bool open = open_modal_ || open_calls_;
  while (!work.empty()) {
    const ProgramId program{std::size_t{work.back()}};
    work.pop_back();
    for (const CallSite& site : calls.SitesOf(program)) {
      if (!site.callee.Valid()) {
        open = true;
      } else if (below.insert(site.callee.value).second) {
        work.push_back(site.callee.value);
      }
    }
  }
  if (open) {
    for (Slot& slot : shared_) slot.changes = true;
    return;
  }
  for (const auto& [program, key] : writes_) {
    if (!below.contains(program)) continue;
    const auto found = index_.find(key);
    if (found != index_.end() && found->second < shared_.size()) shared_[found->second].changes = true;
  }
  for (const auto& [program, space] : computed_writes_) {
    if (!below.contains(program)) continue;
    for (Slot& slot : shared_) {
      if (slot.kind == SlotKind::kCell &&
          module_.spaces[SpaceId{std::size_t{slot.id}}].name == module_.spaces[SpaceId{std::size_t{space}}].name)
        slot.changes = true;
    }
  }
}

}  // namespace ncport::ir::analysis
