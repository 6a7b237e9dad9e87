// The one evaluator: runs a linked module and hands each event to a sink. Traces, flat programs, comparisons and
// constant checks all use it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/diag/sink.h"
#include "exec/environment.h"
#include "exec/event.h"
#include "exec/value.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::exec {

/// A start value given from outside (`--set`, parameter sets): a variable or a cell of a space.
struct StartValue {
  ir::VariableId variable;  // valid: this variable of `entry` or of the channel
  ir::SpaceId space;        // else: this cell
  std::uint32_t cell = 0;
  Value value;
  std::string text;  // value of a STRING
};

/// An argument of the entry program (`--call`).
struct EntryArgument {
  std::uint16_t position = 0;  // of a parameter, from 0
  char letter = 0;             // of a macro argument; 0 = positional
  Value value;                 // vacant = missing
  std::string text;
};

struct RunOptions {
  ir::ProgramId entry;  // program to run
  std::vector<EntryArgument> arguments;
  bool is_call = false;  // the entry runs as a called program (its end words return)
  std::vector<StartValue> start_values;
  std::uint16_t skip_levels = 0;      // bit n: skip level n is on
  bool start_position_known = false;  // `--start`
  std::uint16_t start_axes = 0;
  double start_position[ir::kMaxAxes] = {};   // mm, degrees; transverse axis as the machine's diameter mode programs it
  bool count_turns = false;                   // CallFrameView::turns of events
  bool report_variables = false;              // `--vars`: SET events after the last one
  std::uint64_t max_blocks = 10'000'000;      // executed blocks (`--max-blocks`)
  std::uint64_t max_text_bytes = 64U << 20U;  // memory of strings
  std::uint64_t max_cells = 1U << 22U;        // memory of variables
};

enum class Outcome : std::uint8_t {
  kEnded,    // program end
  kAlarmed,  // ALARM event was handed out
  kRefused,  // something that cannot be run or known: a finding is in the sink
  kLimit,    // a budget ran out: a finding names the option
  kStopped,  // the sink asked to stop
};

/// One division whose integral part may matter: where a layer more or less is decided.
struct Quotient {
  ir::ExprId expr;  // the DivideInteger, Modulo or Divide node
  double numerator = 0;
  double denominator = 0;
};

/// What a run touched: branch coverage and inputs, for comparisons. Filled when the pointer is given.
struct Coverage {
  static constexpr std::size_t kMaxQuotients = 64;
  std::vector<std::uint8_t> blocks;  // per block: bit 0 = executed, bit 1 = branch taken, bit 2 = branch not taken
  std::vector<std::uint32_t> cells_read_before_written;  // packed space << 24 | cell
  std::vector<Quotient> quotients;  // the first kMaxQuotients DivideInteger, Modulo and Divide nodes evaluated
};

struct RunResult {
  Outcome outcome = Outcome::kEnded;
  std::uint64_t blocks_executed = 0;
  bool moved = false;  // a motion event was handed out
};

/// Runs `options.entry`. The module must be verified and its names resolved. All state is in this call: runs of one
/// module may follow each other, or stand in several threads.
RunResult Run(const ir::Module& module, const ir::Machine& machine, const RunOptions& options, Environment& environment,
              EventSink& events, diag::Sink& sink, Coverage* coverage = nullptr);

}  // namespace ncport::exec
