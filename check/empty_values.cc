// Reads of numbered variables that hold nothing on every way there.
#include <set>

#include "check/places.h"
#include "check/rules.h"
#include "ir/analysis/vacancy.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;
using ir::analysis::Vacancy;

class EmptyValues {
 public:
  EmptyValues(const Subject& subject, diag::Sink& sink)
      : module_(subject.module),
        subject_(subject),
        vacancy_(subject.module, subject.machine, subject.graphs, subject.calls, {}),
        sink_(sink) {}

  void Run() {
    for (const ir::ProgramId program : module_.programs.Ids()) {
      if (module_.programs[program].library || subject_.graphs.Of(program).Opaque()) continue;
      told_.clear();
      for (const BlockId id : module_.programs[program].blocks) {
        const ir::Block& block = module_.blocks[id];
        const Vacancy::State* before = vacancy_.Before(id);
        if (before == nullptr || (block.flags & ir::Block::kRefused) != 0) continue;
        Vacancy::State state = *before;
        for (const ir::WordId word : block.words) {
          Look(block, module_.words[word], state);
          vacancy_.ThroughWord(program, id, word, state);
        }
      }
    }
  }

 private:
  void Look(const ir::Block& block, const ir::Word& word, const Vacancy::State& state) {
    // Copies and arguments hand emptiness on, which programs do on purpose.
    const bool hands_on = word.op == WordOp::kAssign || word.op == WordOp::kCall || word.op == WordOp::kModalCall;
    ForExpressions(module_, word, [&](ExprId value) {
      if (!hands_on || !vacancy_.IndexOf(value)) Find(block, value, state);
    });
  }

  void Find(const ir::Block& block, ExprId id, const Vacancy::State& state) {
    const Expr& expr = module_.exprs[id];
    if (IsTest(expr)) return;
    const auto index = expr.op == ExprOp::kCell ? vacancy_.IndexOf(id) : std::nullopt;
    if (index && state[*index] == Vacancy::kEmpty && told_.insert(*index).second) {
      sink_.Report(diag::Code::kVacantValue, module_.RangeOf(block, id), NameOfPlace(module_, expr)).help =
          "no way here gives it a value: arithmetic takes 0, and a word with it is left out";
    }
    ForOperands(module_, expr, [&](ExprId operand) { Find(block, operand, state); });
  }

  /// `#1 EQ #0` asks for emptiness.
  [[nodiscard]] bool IsTest(const Expr& expr) const {
    if (expr.op != ExprOp::kEqual && expr.op != ExprOp::kNotEqual) return false;
    const auto empty = [&](std::uint32_t side) {
      return module_.exprs[vacancy_.Bare(ExprId{std::size_t{side}})].op == ExprOp::kVacant;
    };
    return empty(expr.a) || empty(expr.b);
  }

  const ir::Module& module_;
  const Subject& subject_;
  Vacancy vacancy_;
  diag::Sink& sink_;
  std::set<std::size_t> told_;  // once a program each
};

}  // namespace

void CheckEmptyValues(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const auto starts_empty = [&](const Expr& expr) {
    if (expr.op != ExprOp::kCell) return false;
    const ir::Space& space = module.spaces[ir::SpaceId{std::size_t{expr.a}}];
    return space.type == ir::Type::kNumber && space.start == ir::StartValue::kVacant;
  };
  bool any = false;
  for (const Expr& expr : module.exprs.All()) any = any || starts_empty(expr);
  if (!any) return;
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (module.programs[program].kind == ir::ProgramKind::kMain && !subject.IsMain(program)) return;
  }
  EmptyValues(subject, sink).Run();
}

}  // namespace ncport::check
