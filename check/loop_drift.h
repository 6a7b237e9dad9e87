// Whether the passes of a loop move its test to one side: what a counter does that goes away from its bound.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/diag/sink.h"
#include "check/place_changes.h"
#include "ir/analysis/interval.h"
#include "ir/module.h"

namespace ncport::check {

/// The operands of all sums and differences, over all ways to them.
class SumOperands {
 public:
  void Add(const ir::Module& module, ir::ExprId expr, const ir::analysis::Interval* operands, std::size_t count);
  /// Operand 0 or 1; null: no run comes there.
  [[nodiscard]] const ir::analysis::Interval* Find(ir::ExprId expr, std::size_t operand) const;

 private:
  struct Both {
    ir::analysis::Interval values[2] = {ir::analysis::Interval::None(), ir::analysis::Interval::None()};
  };
  std::unordered_map<std::uint32_t, Both> sums_;
};

/// How the truth of a condition goes on once it is there at the end of a pass. kDrifts: it stays, as values go to one
/// side only. kStill: it stays, as nothing changes what it reads.
enum class Course : std::uint8_t { kOpen, kStill, kDrifts };

/// Blocks of a loop from first to last in the text.
struct LoopBlocks {
  ir::ProgramId program;
  ir::BlockId first, last;
};

class LoopDrift {
 public:
  LoopDrift(const ir::Module& module, const PlaceChanges& changes, const SumOperands& sums, const LoopBlocks& loop)
      : module_(module), changes_(changes), sums_(sums), loop_(loop) {}

  [[nodiscard]] Course Of(ir::ExprId condition, bool truth);
  /// Adds the step behind the last answer kDrifts, and what to do. `never`: the condition is never so.
  void Explain(diag::Diagnostic& finding, bool truth, bool never = false) const;

 private:
  enum class Way : std::uint8_t { kUnknown, kStill, kUp, kDown };

  [[nodiscard]] Way WayOf(ir::ExprId value);
  [[nodiscard]] Way WayOfPlace(ir::ExprId place);
  [[nodiscard]] Way StepOf(const ir::Word& word, const ir::Expr& place) const;
  static Way Turned(Way way);
  static Way Together(Way a, Way b);

  struct Step {
    ir::BlockId block;
    ir::WordId word;
    Way way;
  };

  const ir::Module& module_;
  const PlaceChanges& changes_;
  const SumOperands& sums_;
  LoopBlocks loop_;
  std::vector<Step> steps_;
};

}  // namespace ncport::check
