// What values variables and cells can have where, by abstract interpretation over the flow graphs and through calls.
//
// Sound: every value of every run lies in its interval, also of runs that an operator or an unknown caller starts with
// other values, as far as the analysis says that it reached a result. Calls are followed with the values of each call
// (a context); a program that nothing calls starts with unknown arguments and cells. Conditions narrow what they test.
// Results are handed out block by block: a rule is an observer.
#pragma once

#include <cstdint>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/interval.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

/// One way into a program.
struct CallContext {
  ProgramId program;
  const CallContext* caller = nullptr;  // none: a start, or several callers at once
  CallId call;                          // that leads here
  BlockId block;                        // of the caller
  bool open = false;                    // arguments are not known: nothing calls the program, or too many do
  bool modal = false;                   // runs after blocks of motion
};

struct RangeSite {
  const CallContext* context = nullptr;
  BlockId block;
  WordId word;
};

/// Values at the place of a site.
class RangeLookup {
 public:
  RangeLookup() = default;
  RangeLookup(const RangeLookup&) = delete;
  RangeLookup& operator=(const RangeLookup&) = delete;
  virtual ~RangeLookup() = default;
  [[nodiscard]] virtual Interval ValueOf(VariableId variable) const = 0;
  [[nodiscard]] virtual Interval ValueOf(SpaceId space, std::uint32_t cell) const = 0;
  /// Value of any expression, without telling the observer.
  [[nodiscard]] virtual Interval Evaluate(ExprId expr) = 0;
};

/// Takes the results: every reached block of every context once, in the order of the text, when values stand.
class RangeObserver {
 public:
  RangeObserver() = default;
  RangeObserver(const RangeObserver&) = delete;
  RangeObserver& operator=(const RangeObserver&) = delete;
  virtual ~RangeObserver() = default;

  /// An operation or function with these operands (vacant ones as the language reads them). `values` explains them.
  virtual void Operation(const RangeSite&, ExprId, const Interval* /*operands*/, std::size_t /*count*/, RangeLookup&) {}
  /// `value` is converted to `type` where it is written to a variable, or by a Convert node (`expr`).
  virtual void Conversion(const RangeSite&, ExprId /*expr*/, Type, const Interval& /*value*/, RangeLookup&) {}
  /// An index of dimension `dimension` (from 0) of an array with `size` elements there; kListEnd: the last element that
  /// a list of values fills, of all `size` elements of the array.
  static constexpr std::uint32_t kListEnd = 0xFFFFU;
  virtual void Index(const RangeSite&, ExprId /*element*/, std::uint32_t /*dimension*/, const Interval&,
                     std::uint32_t /*size*/, RangeLookup&) {}
  /// A value that is written to a place, after its conversion.
  virtual void Write(const RangeSite&, ExprId /*place*/, const Interval&) {}
  /// Condition of IF, WHILE, UNTIL, a jump or a word: what it can be.
  virtual void Condition(const RangeSite&, ExprId, const Interval& /*truth*/) {}
  /// FOR before its first pass.
  virtual void CountedLoop(const RangeSite&, const Interval& /*start*/, const Interval& /*end*/,
                           const Interval& /*step*/) {}
  virtual void Block(const RangeSite&, RangeLookup&) {}
  /// A word that control comes to in its turn (site.word), before it acts.
  virtual void WordTurn(const RangeSite&, RangeLookup&) {}
  /// The end of a main program, a return or the end of the text.
  virtual void Exit(const RangeSite&, RangeLookup&) {}
  /// All contexts of one start were handed out; they end with it.
  virtual void StartDone() {}
};

/// What is promised of a parameter whatever the caller ([ranges] of the project).
struct DeclaredRange {
  VariableId parameter;
  double low = 0, high = 0;
};

/// The same of a cell: what it holds where a run starts in `program`, in any program if that is none.
struct DeclaredCell {
  ProgramId program;
  SpaceId space;
  std::uint32_t cell = 0;
  double low = 0, high = 0;
};

struct RangeOptions {
  std::vector<DeclaredRange> declared;
  std::vector<DeclaredCell> declared_cells;
  std::uint32_t contexts_per_program = 24;  // more calls of one program are taken together
  std::uint64_t steps_per_block = 200;  // budget; beyond it calls are taken together, beyond it again nothing is said
};

struct RangeStatistics {
  std::uint64_t steps = 0;  // blocks evaluated
  std::uint32_t contexts = 0;
  std::uint32_t given_up = 0;  // starts without a result
};

/// True if an Alarm word with such a number ends the run, whichever of the numbers it is.
bool StopsAlways(const Word& alarm, const Interval& number, const Machine& machine);

/// `graphs` and `calls` of the same module; names resolved, structure built. Library programs are followed, not
/// started.
RangeStatistics FindValueRanges(const Module& module, const Machine& machine, const FlowGraphs& graphs,
                                const CallGraph& calls, const RangeOptions& options, RangeObserver& observer);

}  // namespace ncport::ir::analysis
