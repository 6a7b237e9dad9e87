// Which drilling cycle is in force at each block, and with which data (part of expand_cycles.h).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// What holds at a place: the cycle, and an expression for each of its data (a literal, or a local).
struct Drilling {
  static constexpr std::uint32_t kUnset = 0xFFFFFFFFU;
  static constexpr std::uint32_t kOpen = 0xFFFFFFFEU;     // not one on every way
  static constexpr std::uint32_t kCallers = 0xFFFFFFFDU;  // of the cycle: none, or one of a caller that is not known
  static constexpr auto kNoCycle = static_cast<std::uint32_t>(Cycle::kNone);
  enum Field : std::uint8_t { kLevel, kDepth, kStep, kDwell, kFields };

  enum class Start : std::uint8_t { kNone, kTaken, kOpen };

  std::uint32_t cycle = kNoCycle;
  std::uint32_t fields[kFields] = {kUnset, kUnset, kUnset, kUnset};
  Start start = Start::kNone;                     // kTaken: a local holds the level at which the cycle began
  bool low = false;                               // the tool may stand at the level of a hole, on some way at least
  bool rigid = false;                             // taps are rigid, on some way at least
  SpindleState spindle = SpindleState::kUnknown;  // of the main spindle, if it is one on all ways
  bool operator==(const Drilling&) const = default;
};

/// The cycle makes holes that this pass can write.
bool IsHole(std::uint32_t cycle);

/// What a block says about holes.
struct DrillingWords {
  std::uint32_t cycle = Drilling::kUnset;
  bool motion = false, level = false;
  bool rigid = false;                          // the word for rigid tapping
  const Word* values[Drilling::kFields] = {};  // as written
  const Word* repeats = nullptr;
  std::vector<Word> place;  // axis words but the depth
  bool geometry = false;    // a place or a depth

  /// Other words of a block move or wait, and no data of it are stored (fanuc-8.7).
  [[nodiscard]] bool Drills() const { return geometry || values[Drilling::kLevel] != nullptr; }
};

class DrillingFlow {
 public:
  /// Makes locals for data that no literal gives. `analyses`: of the module as it is.
  DrillingFlow(Module& module, const analysis::FlowAnalyses& analyses)
      : module_(module), analyses_(analyses), make_(module), locals_(module.programs.Size()) {}

  void Run();
  /// On arrival at the block; null: no run gets there.
  [[nodiscard]] const Drilling* Before(BlockId block) const { return flow_->Before(block); }
  /// The cycle asks for this field.
  static bool Uses(std::uint32_t cycle, std::uint8_t field);
  /// What the main spindle does at the hole of the block.
  [[nodiscard]] SpindleState SpindleAt(BlockId id) const;

  [[nodiscard]] DrillingWords WordsOf(BlockId id, std::uint8_t normal, bool in_cycle) const;
  /// Data of the block as expressions; `assigns`: what must be computed in front of it, a place and its value each,
  /// without value the position at which the cycle begins.
  void Store(ProgramId program, const DrillingWords& parts, bool incremental, Drilling& state,
             std::vector<std::pair<ExprId, ExprId>>* assigns);
  /// The local that holds the level at which a cycle begins.
  ExprId Initial(ProgramId program);
  /// A field of the state as a number; none: it has to be worked out, or is not there.
  [[nodiscard]] std::optional<double> LiteralOf(ExprId id) const;

  // The client of ForwardFlow.
  using State = Drilling;
  [[nodiscard]] State Entry(ProgramId program) const;
  [[nodiscard]] State Unknown(ProgramId) const { return {.cycle = Drilling::kOpen, .low = true}; }
  bool Join(BlockId, State& into, const State& from) const;
  void Transfer(ProgramId program, BlockId id, State& state);
  /// Locals do not travel, nor do cycles: a call under one is refused where it stands. A modal call may run under one;
  /// then moves of its program are.
  [[nodiscard]] std::optional<State> Into(const analysis::CallSite&, analysis::CallMoment moment,
                                          const State& at) const;
  [[nodiscard]] State Back(const analysis::CallSite&, const State& at, const State& exit) const;

 private:
  /// Fields to hold in locals; false: there are no more of them.
  bool HoldMore();
  void Turn(BlockId id, Drilling& state, bool drills, bool behind) const;
  ExprId Local(ProgramId program, std::uint8_t field);

  Module& module_;
  const analysis::FlowAnalyses& analyses_;
  ExprBuilder make_;
  std::optional<analysis::ForwardFlow<DrillingFlow>> flow_;
  struct Locals {
    ExprId fields[Drilling::kFields], initial;
    bool held[Drilling::kFields] = {};  // ways with different numbers meet: a local holds all of them
  };
  std::vector<Locals> locals_;  // per program
};

}  // namespace ncport::ir::transform
