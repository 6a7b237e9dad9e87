#include "ir/transform/adapt_expressions.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

struct Fixture {
  Module module;
  ExprBuilder e{module};
  SpaceId space = AddSpace(module, "#", 1, 33);
  ProgramBuilder program{module, "MAIN"};

  /// What stands for `value` afterwards.
  const Expr& Adapted(ExprId value, const AdaptExpressionsConfig& config) {
    program.Block().Assign(e.Cell(space, 9), value).Finish();
    program.Finish();
    AdaptExpressions(module, program.Id(), config);
    const Block& block = module.blocks[module.programs[program.Id()].blocks[0]];
    return module.exprs[module.words[block.words[0]].value];
  }
};

TEST_CASE("under a relative tolerance the difference is compared with 0") {
  AdaptExpressionsConfig config;
  config.relative_comparisons = true;
  Fixture f;
  const Expr& made = f.Adapted(f.e.Binary(ExprOp::kLess, f.e.Cell(f.space, 1), f.e.Number("10")), config);
  CHECK(made.op == ExprOp::kLess);
  CHECK(f.module.exprs[ExprId{made.a}].op == ExprOp::kSubtract);
  CHECK(f.module.exprs[ExprId{made.b}].number == 0);

  Fixture zero;  // nothing but 0 is within a relative step of 0
  const Expr& kept = zero.Adapted(zero.e.Binary(ExprOp::kLess, zero.e.Cell(zero.space, 1), zero.e.Number("0")), config);
  CHECK(zero.module.exprs[ExprId{kept.a}].op == ExprOp::kCell);
}

TEST_CASE("what a target has stays") {
  Fixture f;
  const ExprId away = f.e.Function(Function::kRoundAway, {f.e.Cell(f.space, 1)});
  const Expr& made = f.Adapted(away, {});
  CHECK(made.op == ExprOp::kFunction);
  CHECK(made.a == static_cast<std::uint32_t>(Function::kRoundAway));
}

TEST_CASE("MOD of rounded operands rounds them by itself") {
  AdaptExpressionsConfig config;
  config.modulo_rounds_operands = false;
  Fixture f;
  const Expr& made =
      f.Adapted(f.e.Binary(ExprOp::kModulo, f.e.Cell(f.space, 1), f.e.Number("3"), Expr::kOperandsToInt), config);
  CHECK((made.flags & Expr::kOperandsToInt) == 0);
  CHECK(f.module.exprs[ExprId{made.a}].op == ExprOp::kFunction);
  CHECK(f.module.exprs[ExprId{made.b}].op == ExprOp::kLiteral);
}

}  // namespace
}  // namespace ncport::ir::transform
