#include "ir/transform/linear_form.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

struct Fixture {
  Module module;
  ExprBuilder e{module};
  SpaceId space = AddSpace(module, "R", 0, 99);
  ExprId R(std::uint32_t number) { return e.Cell(space, number); }
};

TEST_CASE("a step away and back cancels") {
  Fixture f;
  const LinearForm start = FormOf(f.module, f.e.Number("1"));
  const ExprId step = f.e.Binary(ExprOp::kSubtract, f.e.Binary(ExprOp::kAdd, f.R(1), f.R(2)), f.e.Number("1"));
  const ExprId back = f.e.Binary(ExprOp::kSubtract, f.e.Binary(ExprOp::kSubtract, f.e.Number("1"), f.R(1)), f.R(2));
  const LinearForm there = Sum(f.module, start, FormOf(f.module, step));
  CHECK(there.constant == 0);
  CHECK(there.terms.size() == 2);
  const LinearForm again = Sum(f.module, there, FormOf(f.module, back));
  CHECK(again.IsConstant());
  CHECK(again.constant == 1);
}

TEST_CASE("factors reach through brackets, other operations are atoms") {
  Fixture f;
  const ExprId product = f.e.Binary(ExprOp::kMultiply, f.e.Unary(ExprOp::kNegate, f.e.Number("2")),
                                    f.e.Unary(ExprOp::kGroup, f.e.Binary(ExprOp::kAdd, f.R(1), f.e.Number("3"))));
  const LinearForm form = FormOf(f.module, product);
  CHECK(form.constant == -6);
  REQUIRE(form.terms.size() == 1);
  CHECK(form.terms[0].coefficient == -2);
  const LinearForm square = FormOf(f.module, f.e.Binary(ExprOp::kMultiply, f.R(1), f.R(1)));
  REQUIRE(square.terms.size() == 1);
  CHECK(square.terms[0].coefficient == 1);
  // A third is not exact in binary: it stays as the source computed it.
  const LinearForm third = FormOf(f.module, f.e.Binary(ExprOp::kDivide, f.R(1), f.e.Number("3")));
  REQUIRE(third.terms.size() == 1);
  CHECK(f.module.exprs[third.terms[0].atom].op == ExprOp::kDivide);
}

TEST_CASE("sums of decimals stay decimals") {
  Fixture f;
  LinearForm sum;
  for (int i = 0; i < 10; ++i) sum = Sum(f.module, sum, FormOf(f.module, f.e.Number("0.1")));
  CHECK(sum.constant == 1.0);
}

TEST_CASE("different cells are different atoms, equal ones are not") {
  Fixture f;
  CHECK(SameForm(f.module, FormOf(f.module, f.R(1)), FormOf(f.module, f.R(1))));
  CHECK_FALSE(SameForm(f.module, FormOf(f.module, f.R(1)), FormOf(f.module, f.R(2))));
  CHECK_FALSE(
      SameForm(f.module, FormOf(f.module, f.e.CellAt(f.space, f.R(1))), FormOf(f.module, f.e.CellAt(f.space, f.R(2)))));
}

TEST_CASE("the expression of a form starts with what adds") {
  Fixture f;
  LinearForm form;
  form.constant = -1;
  form.terms = {{f.R(1), -2}, {f.R(2), 1}};
  const ExprId expr = ExprOf(f.module, form);
  const Expr& minus_one = f.module.exprs[expr];
  CHECK(minus_one.op == ExprOp::kSubtract);
  const Expr& difference = f.module.exprs[ExprId{minus_one.a}];
  CHECK(difference.op == ExprOp::kSubtract);
  CHECK(f.module.exprs[ExprId{difference.a}].b == 2);
  CHECK(SameForm(f.module, FormOf(f.module, expr), form));
}

}  // namespace
}  // namespace ncport::ir::transform
