#include "ir/never_alarms.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir {
namespace {

TEST_CASE("sums, products and comparisons of variables never alarm, divisions and functions may, wherever they stand") {
  Module module;
  ExprBuilder make(module);
  const ExprId number = make.Literal(2);
  const ExprId sum = make.Binary(ExprOp::kAdd, number, make.Number("1.5"));
  const ExprId test = make.Binary(ExprOp::kLess, sum, make.Binary(ExprOp::kMultiply, number, sum));
  CHECK(NeverAlarms(module, test));
  CHECK(NeverAlarms(module, make.Unary(ExprOp::kNot, test)));
  const ExprId quotient = make.Binary(ExprOp::kDivide, number, sum);
  CHECK_FALSE(NeverAlarms(module, quotient));
  CHECK_FALSE(NeverAlarms(module, make.Binary(ExprOp::kAdd, number, quotient)));
  CHECK_FALSE(NeverAlarms(module, make.Binary(ExprOp::kAnd, quotient, test)));
  CHECK_FALSE(NeverAlarms(module, make.Function(Function::kSqrt, {number})));
}

TEST_CASE("operations that the caller names count as harmless, what they hold is looked at all the same") {
  Module module;
  ExprBuilder make(module);
  const ExprId number = make.Literal(2);
  const ExprId joined = make.Binary(ExprOp::kConcat, number, number);
  constexpr ExprOp kJoins[] = {ExprOp::kConcat};
  CHECK_FALSE(NeverAlarms(module, joined));
  CHECK(NeverAlarms(module, joined, kJoins));
  const ExprId quotient = make.Binary(ExprOp::kDivide, number, number);
  CHECK_FALSE(NeverAlarms(module, make.Binary(ExprOp::kConcat, number, quotient), kJoins));
}

}  // namespace
}  // namespace ncport::ir
