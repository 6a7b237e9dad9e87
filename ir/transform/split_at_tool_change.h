// Splits called programs at their tool changes, for machines whose macros must not call tools: the part before, the
// tool words, and the part behind become two programs, and the words stand between their calls in the caller. Only on
// the straight path of the program: a tool change inside a loop, a branch, under a jump, or behind a block that may end
// the program is refused, and one in a program that nothing calls.
#pragma once

#include <vector>

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// A program that was split: its parts in order, the first being the program itself.
struct SplitProgram {
  ProgramId whole;
  std::vector<ProgramId> parts;
};

struct SplitResult {
  bool ok = false;
  std::vector<SplitProgram> programs;
};

/// Run after SaveToRestores and SplitStatements. Parameters exist in each part, definitions that it needs too; a
/// variable that one part sets and another reads, and arguments that could differ when they are passed again, are
/// refused (NC6xxx at the tool words).
SplitResult SplitAtToolChange(Module& module, diag::Sink& sink);

}  // namespace ncport::ir::transform
