// What words and expressions do to the values of one place of a program. Control flow and calls are elsewhere
// (value_flow, value_calls).
#pragma once

#include "ir/analysis/value_range.h"
#include "ir/analysis/value_slots.h"

namespace ncport::ir::analysis {

/// All values of a type: what is known of a variable of which nothing is known.
Interval AllOf(Type type, const Machine& machine, std::uint8_t flags);

class ValueTransfer : public RangeLookup {
 public:
  ValueTransfer(const Module& module, const Machine& machine, const SlotMap& slots)
      : module_(module), machine_(machine), slots_(slots) {}

  /// Works on `state` from here on; `context` with `shared_references`: parameters by reference may be any variable.
  void Enter(const CallContext& context, bool shared_references, bool keeps_locals) {
    site_.context = &context;
    shared_references_ = shared_references;
    keeps_locals_ = keeps_locals;
  }
  void On(ValueState& state) { state_ = &state; }
  void At(BlockId block, WordId word) {
    site_.block = block;
    site_.word = word;
  }
  void Observe(RangeObserver* observer) { observer_ = observer; }
  [[nodiscard]] const RangeSite& Site() const { return site_; }
  [[nodiscard]] RangeObserver* Observer() const { return observer_; }
  [[nodiscard]] ValueState& State() { return *state_; }

  Interval Eval(ExprId id);
  /// Writes a value, converted to the type of the place.
  void Store(ExprId place, const Interval& value);
  /// Leaves out the values with which the condition is not `holds`. False: there are none.
  bool Assume(ExprId condition, bool holds);
  /// The place lies in the interval. False: it cannot.
  bool Bind(ExprId place, const Interval& to) { return Narrow(place, to); }
  void Define(VariableId variable);
  void Assign(const AssignList& list);
  /// Cells and variables that other programs see can be anything now. `locals`: all others too.
  void Forget(bool locals, bool level_cells);
  /// What a subprogram left in a variable that it got by reference.
  void Put(ExprId place, const Interval& value);
  /// The place can hold anything of its type.
  void ForgetPlace(ExprId place);

  [[nodiscard]] Interval ValueOf(VariableId variable) const override;
  [[nodiscard]] Interval ValueOf(SpaceId space, std::uint32_t cell) const override;
  Interval Evaluate(ExprId expr) override;

  [[nodiscard]] Interval UnknownOf(const Slot& slot, std::uint8_t flags) const;
  /// Conversion to the type of a variable as an assignment does it.
  Interval ConvertedTo(ExprId expr, Type type, const Interval& value);

 private:
  Interval Load(std::uint32_t slot) const;
  void Write(std::uint32_t slot, const Interval& value, bool strong);
  Interval EvalBinary(ExprId id, const Expr& expr);
  Interval EvalComparison(const Expr& expr);
  Interval EvalFunction(ExprId id, const Expr& expr);
  Interval EvalSystem(const Expr& expr);
  Interval EvalCellAt(ExprId id, const Expr& expr);
  void CheckListEnd(const AssignList& list, ExprId id);
  void StoreSystem(ExprId place, const Expr& expr, const Interval& value);
  void CheckCell(ExprId id, SpaceId named, const Interval& index);
  void EvalIndices(ExprId id, const Expr& expr);
  [[nodiscard]] Interval Operand(const Interval& value, const Expr& expr) const;
  [[nodiscard]] Interval Finished(Interval value, const Expr& expr, bool integer) const;
  Interval Operated(ExprId id, const Expr& expr, const Interval* operands, std::size_t count);
  bool AssumeComparison(const Expr& expr, bool holds);
  /// The expression lies in the interval.
  bool Narrow(ExprId id, const Interval& to);
  [[nodiscard]] SpaceId SpaceOf(SpaceId any, double number) const;
  [[nodiscard]] Interval Limited(const Variable& variable, Interval value);

  const Module& module_;
  const Machine& machine_;
  const SlotMap& slots_;
  RangeObserver* observer_ = nullptr;
  bool looks_ = false;  // evaluated for an observer: the state learns nothing from it
  RangeSite site_;
  ValueState* state_ = nullptr;
  bool shared_references_ = false;
  bool keeps_locals_ = false;
};

}  // namespace ncport::ir::analysis
