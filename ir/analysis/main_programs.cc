#include "ir/analysis/main_programs.h"

#include "ir/block_words.h"

namespace ncport::ir::analysis {

bool StartsAsMain(const Module& module, ProgramId program) {
  const Program& record = module.programs[program];
  if (record.kind != ProgramKind::kMain) return false;
  bool returns = false;
  for (const BlockId id : record.blocks) {
    if (HasWord(module, module.blocks[id], WordOp::kProgramEnd)) return true;
    returns = returns || HasWord(module, module.blocks[id], WordOp::kReturn);
  }
  return !returns;
}

}  // namespace ncport::ir::analysis
