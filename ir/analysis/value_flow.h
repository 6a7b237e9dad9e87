// The fixed point over the flow graph of one program for one way into it.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ir/analysis/cfg.h"
#include "ir/analysis/value_transfer.h"

namespace ncport::ir::analysis {

/// Where values of one program are kept: at blocks that several ways lead to.
struct FlowPlan {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  FlowPlan(const Module& module, const Cfg& graph);

  std::vector<std::uint32_t> heads;      // per block: its index among the heads, or kNone
  std::vector<std::uint32_t> positions;  // of the heads, ascending
  /// Who comes to this block while a repeated part ends before it goes on there as well.
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> part_ends;
  bool opaque = false;
};

struct Context : CallContext {
  ValueState entry;
  ValueState exit;
  std::vector<ValueState> in;  // per head
  bool shared_references = false;
  bool keeps_locals = false;
  bool active = false;
  std::uint32_t runs = 0;
};

/// What a call does to the values of its caller; implemented by the analysis of a whole start.
class CallHandler {
 public:
  CallHandler() = default;
  CallHandler(const CallHandler&) = delete;
  CallHandler& operator=(const CallHandler&) = delete;
  virtual ~CallHandler() = default;
  /// `transfer` works on the state before the call and is left on the state behind it. `enter`: the callee is analysed;
  /// else only its known results are used.
  virtual void Through(Context& caller, const Call& call, CallId id, bool modal, ValueTransfer& transfer,
                       bool enter) = 0;
};

class ValueFlow {
 public:
  struct Budget {
    std::uint64_t steps = 0;
    std::uint64_t most = 0;
    [[nodiscard]] bool Spent() const { return steps > most; }
  };

  ValueFlow(const Module& module, const Machine& machine, const SlotMap& slots, const Cfg& graph, const FlowPlan& plan,
            CallHandler& calls, Budget& budget);

  /// Fills in and exit of the context from its entry.
  void Solve(Context& context);
  /// Hands the results to the observer.
  void Replay(Context& context, RangeObserver& observer);

 private:
  enum class Mode : std::uint8_t { kGrow, kShrink, kReplay };
  /// States of the ways out of a block.
  struct Ways {
    ValueState fall;     // to the next block
    ValueState escaped;  // to the next block, past words that did not run
    ValueState taken;    // jumps and arms
    ValueState off;      // a condition of a structure does not hold; FOR is through
    ValueState left;     // end words, loop ends
    ValueState again;    // next pass of FOR
    ValueState part;     // into a repeated part
  };

  void Chain(Context& context, std::uint32_t position, ValueState start);
  void Step(Context& context, BlockId id, Ways& ways);
  /// The next word: values are those of its turn.
  void Turn(BlockId block, WordId word);
  void Word(Context& context, const Block& block, const ir::Word& word, Ways& ways);
  void FlowWord(Context& context, const Block& block, const ir::Word& word, Ways& ways);
  void Loop(const Block& opening, bool first, Ways& ways);
  void Conditional(const ir::Word& word, ValueState& yes, ValueState& no);
  void Leave(Context& context, BlockId id, Ways& ways);
  void Go(Context& context, std::uint32_t from, std::uint32_t to, const ValueState& state);
  void GoOne(std::uint32_t from, std::uint32_t to, const ValueState& state);
  void Exit(Context& context, const ValueState& state);
  void Grow(Context& context);
  void Shrink(Context& context);
  void Opaque(Context& context);
  [[nodiscard]] Interval Widened(const Interval& old, const Interval& now, bool far) const;

  const Module& module_;
  const Machine& machine_;
  const SlotMap& slots_;
  const Cfg& graph_;
  const FlowPlan& plan_;
  CallHandler& calls_;
  Budget& budget_;
  ValueTransfer transfer_;
  Mode mode_ = Mode::kGrow;
  std::vector<ValueState>* in_ = nullptr;
  std::vector<std::uint16_t> visits_;
  std::vector<std::uint8_t> waiting_;  // heads to look at again
  std::vector<std::uint32_t> queue_;   // a heap of positions, the first of the text on top
  ValueState exit_;
};

}  // namespace ncport::ir::analysis
