#include <vector>

#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::ExprId;
using ir::ExprOp;
using ir::VariableId;
using ir::WordOp;

/// How often each variable stands anywhere, and how often only as the place of an assignment.
struct Uses {
  std::vector<std::uint32_t> all, written;
};

Uses CountUses(const ir::Module& module) {
  Uses uses;
  uses.all.resize(module.variables.Size());
  uses.written.resize(module.variables.Size());
  const auto count = [&](ExprId id, std::vector<std::uint32_t>& counts) {
    if (!id.Valid()) return;
    const ir::Expr& expr = module.exprs[id];
    if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) ++counts[expr.a];
  };
  for (const ExprId id : module.exprs.Ids()) count(id, uses.all);
  for (const ir::Word& word : module.words.All()) {
    if (word.op == WordOp::kAssign) count(word.Extra<ExprId>(), uses.written);
  }
  for (const ir::AssignList& list : module.assign_lists.All()) count(list.place, uses.written);
  return uses;
}

}  // namespace

void CheckUnusedNames(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const Uses uses = CountUses(module);
  for (const VariableId id : module.variables.Ids()) {
    const ir::Variable& variable = module.variables[id];
    const bool parameter = variable.scope == ir::Scope::kParameter;
    const bool shared = variable.scope == ir::Scope::kChannel || variable.scope == ir::Scope::kGlobal ||
                        (variable.scope == ir::Scope::kProgram && subject.machine.program_variables_visible);
    if (shared || !variable.owner.Valid() || module.programs[variable.owner].library) continue;
    if (uses.all[id.value] > uses.written[id.value]) continue;
    const std::string_view name = module.View(variable.name);
    if (subject.InRefusedBlock(variable.owner, name) || subject.NearRefusedWord(variable.owner, name)) continue;
    const std::string_view kind = parameter ? "parameter" : "variable";
    const bool set = uses.all[id.value] != 0;
    if (set && variable.by_reference) continue;  // the caller reads it
    sink.Report(diag::Code::kUnusedName, subject.PlaceOf(variable), kind, name).help =
        set         ? "it is set, but nothing reads it"
        : parameter ? "callers may pass a value for it, and it has no effect"
                    : "take it out, or look for its misspelling";
  }
}

}  // namespace ncport::check
