// Constants of one program: values that a variable has on every way, worked out through its blocks with the arithmetic
// of the source's control. Conditions that they decide close the other way.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ir/analysis/cfg.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// A number with its type, or an axis (Type::kAxis).
struct ConstantValue {
  Type type = Type::kReal;
  double number = 0;
  bool operator==(const ConstantValue&) const = default;
};

/// Variables with one known value; all others may hold anything.
using ConstantState = std::map<std::uint32_t, ConstantValue>;

/// What a system variable reads at a block; none: not known there.
using SystemConstant = std::function<std::optional<ConstantValue>(BlockId block, const System& system, double index)>;

class ConstantValues {
 public:
  /// Only variables that `program` owns are followed: nothing else may write those. `keeps_locals`: later runs begin
  /// with what the run before left (modal calls), so that a definition gives no value to what the program writes.
  /// `entry`: values on entry.
  ConstantValues(const Module& module, const Machine& machine, ProgramId program, const analysis::Cfg& cfg,
                 bool keeps_locals, SystemConstant system, ConstantState entry = {});

  /// Variables that blocks on some way write.
  [[nodiscard]] std::set<std::uint32_t> Written() const;
  [[nodiscard]] bool Reached(BlockId block) const { return in_[block.value - blocks_.begin].has_value(); }
  /// Value of the expression where the block begins; none: not constant, or an alarm.
  [[nodiscard]] std::optional<ConstantValue> Evaluate(BlockId block, ExprId expr) const;
  /// As Evaluate, in front of the word with this index of the block.
  [[nodiscard]] std::optional<ConstantValue> EvaluateAt(BlockId block, std::uint32_t word, ExprId expr) const;

 private:
  [[nodiscard]] std::optional<ConstantValue> Value(BlockId block, const ConstantState& state, ExprId expr) const;
  [[nodiscard]] std::optional<ConstantValue> Arithmetic(const Expr& expr, ConstantValue a, ConstantValue b) const;
  [[nodiscard]] std::optional<ConstantValue> Finished(double value, const Expr& expr, bool whole) const;
  void ThroughWord(BlockId block, const Word& word, bool sure, ConstantState& state) const;
  [[nodiscard]] ConstantState Through(BlockId block, std::uint32_t words) const;
  void Write(ConstantState& state, ExprId place, std::optional<ConstantValue> value, bool sure) const;
  void Solve(const analysis::Cfg& cfg);
  [[nodiscard]] bool FindKept();

  const Module& module_;
  const Machine& machine_;
  ProgramId program_;
  IdRange<BlockId> blocks_;
  SystemConstant system_;
  ConstantState entry_;
  std::set<std::uint32_t> kept_;  // variables whose definition does not start them anew
  std::vector<std::optional<ConstantState>> in_;
};

}  // namespace ncport::ir::transform
