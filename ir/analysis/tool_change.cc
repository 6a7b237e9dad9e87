#include "ir/analysis/tool_change.h"

namespace ncport::ir::analysis {

ToolChange WhenToolsChange(const Module& module, const Machine& machine) {
  if (machine.tool_word_changes) return ToolChange::kAtToolWord;
  if (!machine.tool_activates_edge) return ToolChange::kAtChangeWord;
  bool tools = false;
  for (const Word& word : module.words.All()) {
    // A computed M function may be the change word.
    if (word.op == WordOp::kToolChange || word.op == WordOp::kComputedM) return ToolChange::kAtChangeWord;
    tools = tools || word.op == WordOp::kTool;
  }
  return tools ? ToolChange::kAssumedAtToolWord : ToolChange::kAtChangeWord;
}

}  // namespace ncport::ir::analysis
