// Runs a program and its translation over many parameter sets and compares what the machine would do.
// "Not compared" is a result: too few runs that count, or a branch of the source that no run took.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exec/run.h"
#include "ir/machine.h"
#include "ir/module.h"
#include "prove/compare.h"
#include "prove/parameter_sets.h"

namespace ncport::prove {

/// One side: a resolved module and the machine it runs on. Copied where runs change it.
struct Side {
  const ir::Module* module = nullptr;
  const ir::Machine* machine = nullptr;
  ir::ProgramId entry;
  bool is_call = false;          // the entry is a subprogram that is ported without its callers
  std::uint16_t start_axes = 0;  // axes whose position is known at the start
  double start_position[ir::kMaxAxes] = {};
  ir::ModalState entry_state;  // what the callers of such a subprogram promise ([entry]); other groups are unknown
};

/// Where one input goes in. A place in the arguments of all calls of a program, or a cell at the start.
struct InputPlace {
  ir::ProgramId callee;        // arguments of calls to it (or of the entry itself)
  std::uint16_t position = 0;  // of a parameter from 0; of a letter: the local cell that it fills
  char letter = 0;             // 0 = positional: a missing value is passed as 0
  bool truth = false;          // takes whether the input is given, not its value
  ir::SpaceId space;           // else: this cell at the start
  std::uint32_t cell = 0;
};

struct BoundInput {
  Input input;
  std::vector<InputPlace> source, target;  // every place gets the value
};

struct VerifyOptions {
  std::uint32_t runs = 200;  // parameter sets that count
  std::uint64_t seed = 1;
  std::uint64_t max_blocks = 10'000'000;  // of one run
  std::uint32_t least_runs = 20;
  CompareOptions compare;
  std::vector<ir::BlockId> listed_branches;  // of the source: may stay uncovered, the report names them
  std::vector<ir::SpaceId> garbage;          // spaces of the target that a poisoned start fills with garbage
  int target_skip_shift = 0;                 // skip level n of the source is level n + shift of the target
  bool poison_distance = true;               // the target has words for the distance mode
  std::vector<std::pair<std::string, std::string>> final_values;  // source name, target name, as SET events print them
};

struct Branch {
  ir::BlockId block;
  bool taken = false;  // which way was never gone
};

struct Verification {
  bool compared = false;                 // enough runs, all branches
  std::string not_compared;              // why not, in plain words
  std::optional<Difference> difference;  // the first one, with the set that shows it
  ParameterSet difference_set;
  std::string difference_start;       // "clean start", "poisoned start", "skip level 1 on"
  std::uint32_t sets_run = 0;         // distinct sets
  std::uint32_t sets_counted = 0;     // that moved before any alarm
  std::uint32_t alarms_agreed = 0;    // sets that both sides refuse before motion
  std::uint32_t exact_multiples = 0;  // sets aimed at a whole quotient
  std::uint32_t branches = 0, branches_taken = 0;
  std::uint32_t branches_listed = 0;  // not taken, and listed as such
  std::vector<Branch> open_branches;
  std::vector<ir::BlockId> stops;  // of the source: every run ends here in an alarm, what stands behind was never run
  std::size_t events_compared = 0;
  std::size_t spindle_moved_across_rapid = 0;
  std::size_t centers_moved = 0;
  std::size_t longest_trace = 0;
};

/// Findings of source runs that could not go on (unknown values, limits) are in `sink`; what stops the target is in
/// Verification::not_compared, since its text is no file of the user.
Verification Verify(const Side& source, const Side& target, const std::vector<BoundInput>& inputs,
                    const VerifyOptions& options, diag::Sink& sink);

}  // namespace ncport::prove
