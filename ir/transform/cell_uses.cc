#include "ir/transform/cell_uses.h"

#include "ir/transform/rewrite_exprs.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

bool NamesVariable(const Expr& expr) { return expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement; }

}  // namespace

CellUses::CellUses(Module& module, bool modal_keeps_locals) {
  for (const ProgramId program : module.programs.Ids()) {
    FindNames(module, program);
    for (const BlockId block : module.programs[program].blocks) {
      for (const WordId id : module.blocks[block].words)
        FindWords(module, module.words[id], program, modal_keeps_locals);
    }
  }
}

void CellUses::FindNames(Module& module, ProgramId program) {
  RewriteProgram(module, program, [&](Module&, ExprId id) {
    const Expr& expr = module.exprs[id];
    if (expr.op == ExprOp::kCell) {
      cells[expr.a].insert(expr.b);
      cells_of[program.value].insert(Key(expr.a, expr.b));
    }
    if (expr.op == ExprOp::kCellAt) {
      indexed_spaces.insert(expr.b);
      spaces_of[program.value].insert(expr.b);
    }
    if (NamesVariable(expr)) {
      variables.insert(expr.a);
      const ProgramId owner = module.variables[VariableId{std::size_t{expr.a}}].owner;
      if (owner.Valid() && owner != program) seen_elsewhere.insert(expr.a);
    }
    return id;
  });
}

void CellUses::FindWords(const Module& module, const Word& word, ProgramId program, bool modal_keeps_locals) {
  if (word.op == WordOp::kFeed && word.value.Valid()) {
    const Expr& value = module.exprs[word.value];
    if (value.op == ExprOp::kVariable && module.variables[VariableId{value.a}].scope == Scope::kParameter)
      feeds.insert(value.a);
  }
  if (word.op == WordOp::kModalCall && word.Extra<CallId>().Valid() && modal_keeps_locals &&
      module.calls[word.Extra<CallId>()].program.Valid())
    modal.insert(module.calls[word.Extra<CallId>()].program.value);
  VisitWordExprs(module, word, [&](ExprId root, bool place) {
    const Expr& expr = module.exprs[root];
    if (place && NamesVariable(expr)) written[program.value].insert(expr.a);
  });
  if (word.op == WordOp::kCall || word.op == WordOp::kModalCall) FindReferences(module, word, program);
}

/// What a call takes by reference its program may write.
void CellUses::FindReferences(const Module& module, const Word& word, ProgramId program) {
  if (!word.Extra<CallId>().Valid()) return;
  const Call& call = module.calls[word.Extra<CallId>()];
  if (!call.program.Valid()) return;
  const IdRange<VariableId> parameters = module.programs[call.program].parameters;
  for (const ArgId arg_id : call.args) {
    const Arg& arg = module.args[arg_id];
    if (arg.letter != 0 || !arg.value.Valid() || arg.position >= parameters.count) continue;
    const Expr& given = module.exprs[arg.value];
    if (NamesVariable(given) && module.variables[parameters[arg.position]].by_reference)
      written[program.value].insert(given.a);
  }
}

}  // namespace ncport::ir::transform
