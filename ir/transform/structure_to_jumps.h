// Rewrites IF, FOR, LOOP, REPEAT .. UNTIL and CASE as jumps to block numbers, for targets that have only WHILE and
// jumps. WHILE stays while its condition is one comparison and the target's loops may nest so deep. AND and OR in
// conditions become several jumps: targets disagree on what they mean between conditions.
//
// Afterwards every Jump has a plain comparison or none as its condition and goes to a block number that stands once in
// its program, so that no search rule matters (doubled labels: sinumerik-6.1, fanuc-6.2).
#pragma once

#include <cstdint>

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir::transform {

struct StructureToJumpsConfig {
  std::uint32_t loop_depth = 3;      // WHILE loops that the target nests; 0 = it has none
  std::uint32_t first_number = 100;  // of blocks that get a number because a jump goes there
  std::uint32_t step = 10;
  std::uint32_t last_number = 9999;  // largest N of the target
  bool ignore_case = true;           // of labels in the source
};

/// Changes one program. A construct that has no such form is a finding (NC6xxx) at its place; returns false then.
bool StructureToJumps(Module& module, ProgramId program, const StructureToJumpsConfig& config, diag::Sink& sink);

}  // namespace ncport::ir::transform
