#include "ir/analysis/tool_change.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir::analysis {
namespace {

ToolChange Of(bool tool_word_changes, bool edges, std::initializer_list<WordOp> words) {
  Module module;
  ExprBuilder e(module);
  ProgramBuilder program(module, "MAIN");
  for (const WordOp op : words) {
    if (op == WordOp::kToolChange) {
      program.Block().Add(op).Finish();
    } else {
      program.Block().Add(op, e.Number("6")).Finish();
    }
  }
  program.Finish();
  Machine machine;
  machine.tool_word_changes = tool_word_changes;
  machine.tool_activates_edge = edges;
  return WhenToolsChange(module, machine);
}

TEST_CASE("the machine says which word changes the tool; without any change word it is assumed to be T") {
  CHECK(Of(true, true, {WordOp::kTool}) == ToolChange::kAtToolWord);
  CHECK(Of(true, true, {WordOp::kTool, WordOp::kToolChange}) == ToolChange::kAtToolWord);
  CHECK(Of(false, true, {WordOp::kTool, WordOp::kToolChange}) == ToolChange::kAtChangeWord);
  CHECK(Of(false, true, {WordOp::kTool}) == ToolChange::kAssumedAtToolWord);
  CHECK(Of(false, true, {WordOp::kTool, WordOp::kComputedM}) == ToolChange::kAtChangeWord);
  CHECK(Of(false, true, {}) == ToolChange::kAtChangeWord);
  CHECK(Of(false, false, {WordOp::kTool}) == ToolChange::kAtChangeWord);
}

}  // namespace
}  // namespace ncport::ir::analysis
