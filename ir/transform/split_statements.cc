#include "ir/transform/split_statements.h"

#include <vector>

#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

enum class Statement : std::uint8_t { kMacro, kWords, kFlow };

Statement KindOf(const Word& word) {
  switch (word.op) {
    case WordOp::kAssign:
    case WordOp::kAssignList:
    case WordOp::kMessage:
    case WordOp::kPrint:
    case WordOp::kAlarm:
    case WordOp::kPreprocessStop:
    case WordOp::kWorkpiece:
    case WordOp::kDefine:
    case WordOp::kVerbatim:
      return Statement::kMacro;
    case WordOp::kJump:
    case WordOp::kSwitch:
    case WordOp::kCall:
    case WordOp::kModalCall:
    case WordOp::kRepeatPart:
      return Statement::kFlow;
    default:
      return IsStructureMark(word.op) ? Statement::kFlow : Statement::kWords;
  }
}

/// Does evaluating `value` read what `place` writes? Places reached by an index count as the whole array, space or
/// system variable.
bool Reads(const Module& module, ExprId value, ExprId place) {
  if (!value.Valid()) return false;
  const Expr& target = module.exprs[place];
  bool reads = false;
  VisitReads(module, value, [&](ExprId id) {
    const Expr& read = module.exprs[id];
    const auto space_of = [&](const Expr& expr) { return expr.op == ExprOp::kCellAt ? expr.b : expr.a; };
    const bool read_cell = read.op == ExprOp::kCell || read.op == ExprOp::kCellAt;
    const bool target_cell = target.op == ExprOp::kCell || target.op == ExprOp::kCellAt;
    if (read_cell != target_cell) return;
    if (read_cell) {
      const bool same_number = read.op == ExprOp::kCell && target.op == ExprOp::kCell ? read.b == target.b : true;
      reads = reads || (space_of(read) == space_of(target) && same_number);
    } else {
      reads = reads || ((read.op == ExprOp::kSystem) == (target.op == ExprOp::kSystem) && read.a == target.a);
    }
  });
  return reads;
}

/// The place that the word writes, of lists the first element or the array that they fill.
ExprId PlaceOf(const Module& module, const Word& word) {
  if (word.op == WordOp::kAssign) return word.Extra<ExprId>();
  if (word.op == WordOp::kAssignList) return module.assign_lists[word.Extra<AssignListId>()].place;
  return {};
}

}  // namespace

void SplitStatements(Module& module, ProgramId program) {
  ProgramEditor editor(module, program, "split_statements");
  ExprBuilder make(module);
  for (const BlockId id : module.programs[program].blocks) {
    const Block block = module.blocks[id];
    std::vector<Word> all;
    std::size_t macros = 0, words = 0, flows = 0;
    bool conditional = false;
    for (const WordId word : block.words) {
      all.push_back(module.words[word]);
      const Statement kind = KindOf(all.back());
      (kind == Statement::kMacro ? macros : kind == Statement::kFlow ? flows : words) += 1;
      conditional = conditional || all.back().op == WordOp::kWhen || all.back().op == WordOp::kSkipRest;
    }
    if (conditional || macros + (words > 0 ? 1U : 0U) + flows <= 1) continue;
    // The block itself becomes the last statement; the others go in front of it and take its marks along.
    std::vector<std::vector<Word>> statements;
    std::vector<Word> nc, flow, last;
    for (std::size_t i = 0; i < all.size(); ++i) {
      Word word = all[i];
      const Statement kind = KindOf(word);
      if (kind == Statement::kMacro) {
        statements.push_back({word});
        continue;
      }
      if (word.value.Valid()) {
        bool changed_later = false;
        for (std::size_t later = i + 1; later < all.size(); ++later) {
          const ExprId place = PlaceOf(module, all[later]);
          changed_later = changed_later || (place.Valid() && Reads(module, word.value, place));
        }
        if (changed_later) {
          const VariableId held = NewLocal(module, program, "HELD", module.exprs[word.value].type);
          statements.push_back({MakeAssignment(make.Variable(held), word.value)});
          word.value = make.Variable(held);
        }
      }
      // What ends the program waits for the calls of its block.
      const bool ends = flows > 0 && word.phase == Phase::kLast;
      (kind == Statement::kFlow ? flow : ends ? last : nc).push_back(word);
    }
    if (!nc.empty()) statements.push_back(nc);
    for (const Word& word : flow) statements.push_back({word});
    if (!last.empty()) statements.push_back(last);
    for (const std::vector<Word>& statement : statements) editor.PutInFront(id, statement, {.comments = true});
    editor.Remove(id);
  }
  editor.Apply();
}

}  // namespace ncport::ir::transform
