// What a write leaves in its place (part of value_transfer.h).
#include <cmath>
#include <vector>

#include "ir/analysis/value_transfer.h"

namespace ncport::ir::analysis {

void ValueTransfer::Write(std::uint32_t slot, const Interval& value, bool strong) {
  Interval& cell = state_->cells[slot];
  cell = strong ? value : Join(cell, value);
}

Interval ValueTransfer::Limited(const Variable& variable, Interval value) {
  if (variable.lower_limit.Valid()) {
    const Interval limit = Evaluate(variable.lower_limit);
    if (limit.IsPoint()) value = Meet(value, {limit.low, kInfinity, 0});
  }
  if (variable.upper_limit.Valid()) {
    const Interval limit = Evaluate(variable.upper_limit);
    if (limit.IsPoint()) value = Meet(value, {-kInfinity, limit.high, 0});
  }
  return value.HasNumber() ? value : AllOf(variable.type, machine_, Interval::kInput);
}

void ValueTransfer::Store(ExprId place, const Interval& value) {
  const Expr& expr = module_.exprs[place];
  switch (expr.op) {
    case ExprOp::kGroup:
      return Store(ExprId{std::size_t{expr.a}}, value);
    case ExprOp::kVariable:
    case ExprOp::kElement: {
      const VariableId id{std::size_t{expr.a}};
      const Variable& variable = module_.variables[id];
      if (expr.op == ExprOp::kElement) EvalIndices(place, expr);
      if (variable.type == Type::kString) return;
      Interval written = WithoutVacant(value);
      if (value.Has(Interval::kVacant) || !value.HasNumber()) {
        written = AllOf(variable.type, machine_, Interval::kInput);
      } else {
        written = ConvertedTo(place, variable.type, written);
        if (variable.by_reference) {
          // The variable behind it keeps its own type.
          written = Join(written, Join(value, Rounded(value)));
        }
        if (variable.lower_limit.Valid() || variable.upper_limit.Valid()) written = Limited(variable, written);
      }
      if (observer_ != nullptr) observer_->Write(site_, place, written);
      if (variable.by_reference && shared_references_) return Forget(false, true);
      const std::uint32_t slot = slots_.Of(id);
      if (slot != SlotMap::kNone) Write(slot, written, expr.op == ExprOp::kVariable);
      return;
    }
    case ExprOp::kCell:
    case ExprOp::kCellAt: {
      Interval index = Interval::Point(expr.b);
      SpaceId named{std::size_t{expr.a}};
      if (expr.op == ExprOp::kCellAt) {
        index = Rounded(Eval(ExprId{std::size_t{expr.a}}));
        named = SpaceId{std::size_t{expr.b}};
        CheckCell(place, named, index);
      }
      const auto converted = [&](const Space& space) {
        Interval result = WithoutVacant(value);
        if (result.HasNumber()) result = ConvertedTo(place, space.type, result);
        if (value.Has(Interval::kVacant)) result.flags |= Interval::kVacant;
        if (machine_.numeric_model == NumericModel::kNum8 && result.HasNumber()) {
          if (!std::isinf(result.low)) result.low -= std::fabs(result.low) * 1e-7;
          if (!std::isinf(result.high)) result.high += std::fabs(result.high) * 1e-7;
          result.flags &= static_cast<std::uint8_t>(~Interval::kNonZero);
        }
        if (machine_.cell_max > 0 && result.HasNumber()) {
          Interval fits = Meet(result, {-machine_.cell_max, machine_.cell_max, Interval::kVacant});
          result = fits.HasNumber() ? fits : result;
        }
        return result;
      };
      if (index.IsPoint()) {
        const SpaceId space = SpaceOf(named, index.low);
        if (!space.Valid()) return;
        const Interval written = converted(module_.spaces[space]);
        if (observer_ != nullptr) observer_->Write(site_, place, written);
        const std::uint32_t slot = slots_.Of(space, static_cast<std::uint32_t>(index.low));
        if (slot != SlotMap::kNone) Write(slot, written, true);
        return;
      }
      const Interval written = converted(module_.spaces[named]);
      if (observer_ != nullptr) observer_->Write(site_, place, written);
      const std::vector<Slot>& shared = slots_.Shared();
      for (std::uint32_t i = 0; i < shared.size(); ++i) {
        if (shared[i].kind != SlotKind::kCell) continue;
        const Space& space = module_.spaces[SpaceId{std::size_t{shared[i].id}}];
        if (space.name == module_.spaces[named].name && index.Holds(shared[i].number)) Write(i, written, false);
      }
      return;
    }
    case ExprOp::kSystem:
      return StoreSystem(place, expr, value);
    default:
      return;
  }
}

void ValueTransfer::StoreSystem(ExprId place, const Expr& expr, const Interval& value) {
  const System& system = module_.systems[SystemId{std::size_t{expr.a}}];
  for (std::uint32_t i = 0; i < expr.count; ++i) {
    const Interval index = Rounded(Eval(module_.Item(expr.b + i)));
    constexpr std::uint32_t kCells = 4'000'000'000U;
    if (observer_ != nullptr && i == 0 && system.kind == SystemKind::kUserMemory)
      observer_->Index(site_, place, 0, index, kCells, *this);
  }
  if (system.kind == SystemKind::kUserMemory) (void)ConvertedTo(place, system.type, WithoutVacant(value));
}

void ValueTransfer::Define(VariableId id) {
  const Variable& variable = module_.variables[id];
  const std::uint32_t slot = slots_.Of(id);
  if (variable.by_reference) return;
  Interval start = Interval::Point(0);
  if (variable.type == Type::kInt || variable.type == Type::kBool || variable.type == Type::kChar)
    start.flags |= Interval::kInteger;
  if (variable.type == Type::kNumber || variable.type == Type::kAny) start = AllOf(variable.type, machine_, 0);
  if (variable.lower_limit.Valid() || variable.upper_limit.Valid()) {
    start = Join(start, AllOf(variable.type, machine_, 0));
    start = Limited(variable, start);
  }
  Interval value = start;
  if (variable.initial.Valid()) {
    const Interval initial = Eval(variable.initial);
    if (variable.type != Type::kString) {
      value = initial.HasNumber() && !initial.Has(Interval::kVacant)
                  ? ConvertedTo(variable.initial, variable.type, initial)
                  : AllOf(variable.type, machine_, Interval::kInput);
    }
    if (variable.lower_limit.Valid() || variable.upper_limit.Valid()) value = Limited(variable, value);
    if (variable.dimension_count != 0) value = Join(value, start);
  }
  if (slot == SlotMap::kNone) return;
  Write(slot, value, !keeps_locals_);
  if (variable.initial_list.Valid()) Assign(module_.assign_lists[variable.initial_list]);
  if (variable.initial_list.Valid()) {
    // The list of a definition names no place.
    const AssignList& list = module_.assign_lists[variable.initial_list];
    if (list.place.Valid() || variable.type == Type::kString) return;
    for (const ExprItemId item : list.values) {
      const ExprId expr = module_.Item(item.value);
      if (expr.Valid()) Write(slot, ConvertedTo(expr, variable.type, Eval(expr)), false);
    }
  }
}

/// The last element that a list of values fills, counted through all dimensions.
void ValueTransfer::CheckListEnd(const AssignList& list, ExprId id) {
  const Expr& place = module_.exprs[id];
  const Variable& variable = module_.variables[VariableId{std::size_t{place.a}}];
  if (observer_ == nullptr || variable.dimension_count == 0) return;
  Interval at = Interval::Point(0);
  double size = 1;
  for (std::uint32_t i = 0; i < variable.dimension_count; ++i) {
    if (variable.dimensions[i] == 0) return;  // as large as what was passed
    size *= variable.dimensions[i];
    at = Product(at, Interval::Point(variable.dimensions[i]));
    if (place.op == ExprOp::kElement && i < place.count) at = Sum(at, Rounded(Evaluate(module_.Item(place.b + i))));
  }
  Interval values = Interval::Point(list.values.count);
  if (list.repeat) values = list.count.Valid() ? Rounded(Evaluate(list.count)) : Interval::Point(0);
  if (!at.HasNumber() || !values.HasNumber() || size > 1e9) return;
  if (values.low < 0)
    observer_->Index(site_, id, RangeObserver::kListEnd, values, static_cast<std::uint32_t>(size), *this);
  const Interval last = Difference(Sum(at, values), Interval::Point(1));
  // No value at all fills no element.
  if (last.high >= size)
    observer_->Index(site_, id, RangeObserver::kListEnd, Meet(last, {0, kInfinity, 0}),
                     static_cast<std::uint32_t>(size), *this);
}

void ValueTransfer::Assign(const AssignList& list) {
  if (!list.place.Valid()) return;
  if (list.count.Valid()) (void)Eval(list.count);
  const Expr& place = module_.exprs[list.place];
  const bool cells = place.op == ExprOp::kCell || place.op == ExprOp::kCellAt;
  if (place.op == ExprOp::kElement) EvalIndices(list.place, place);
  if (place.op == ExprOp::kElement || place.op == ExprOp::kVariable) CheckListEnd(list, list.place);
  for (const ExprItemId item : list.values) {
    const ExprId expr = module_.Item(item.value);
    if (!expr.Valid()) continue;
    const Interval value = Eval(expr);
    if (cells) continue;
    if (place.op != ExprOp::kVariable && place.op != ExprOp::kElement) continue;
    const Variable& variable = module_.variables[VariableId{std::size_t{place.a}}];
    const std::uint32_t slot = slots_.Of(VariableId{std::size_t{place.a}});
    if (slot == SlotMap::kNone || variable.type == Type::kString) continue;
    Interval written = value.HasNumber() ? ConvertedTo(expr, variable.type, WithoutVacant(value))
                                         : AllOf(variable.type, machine_, Interval::kInput);
    if (variable.by_reference) written = Join(written, value);
    if (variable.by_reference && shared_references_) return Forget(false, true);
    Write(slot, written, false);
  }
  // Consecutive cells from a place on: any of them.
  if (cells) Forget(false, true);
}

void ValueTransfer::Forget(bool locals, bool level_cells) {
  const std::vector<Slot>& shared = slots_.Shared();
  for (std::uint32_t i = 0; i < shared.size(); ++i) {
    if (!shared[i].level || level_cells) state_->cells[i] = UnknownOf(shared[i], Interval::kInput);
  }
  if (!locals) return;
  const std::vector<Slot>& own = slots_.LocalsOf(site_.context->program);
  for (std::uint32_t i = 0; i < own.size(); ++i) state_->cells[shared.size() + i] = UnknownOf(own[i], Interval::kInput);
}

void ValueTransfer::Put(ExprId id, const Interval& value) {
  const Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kGroup) return Put(ExprId{std::size_t{expr.a}}, value);
  if (expr.op != ExprOp::kVariable && expr.op != ExprOp::kElement) return ForgetPlace(id);
  const std::uint32_t slot = slots_.Of(VariableId{std::size_t{expr.a}});
  if (slot != SlotMap::kNone) Write(slot, value, expr.op == ExprOp::kVariable);
}

void ValueTransfer::ForgetPlace(ExprId id) {
  const Expr& expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kGroup:
      return ForgetPlace(ExprId{std::size_t{expr.a}});
    case ExprOp::kVariable:
    case ExprOp::kElement: {
      const VariableId variable{std::size_t{expr.a}};
      const std::uint32_t slot = slots_.Of(variable);
      if (slot != SlotMap::kNone)
        Write(slot, AllOf(module_.variables[variable].type, machine_, Interval::kInput), true);
      return;
    }
    case ExprOp::kCell:
    case ExprOp::kCellAt:
      return Forget(false, true);
    default:
      return;
  }
}

}  // namespace ncport::ir::analysis
