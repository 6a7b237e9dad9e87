#include "ir/comparison.h"

#include <doctest/doctest.h>

namespace ncport::ir {
namespace {

constexpr ExprOp kAll[] = {ExprOp::kEqual,     ExprOp::kNotEqual, ExprOp::kLess,
                           ExprOp::kLessEqual, ExprOp::kGreater,  ExprOp::kGreaterEqual};

bool Holds(ExprOp op, int a, int b) {
  switch (op) {
    case ExprOp::kEqual:
      return a == b;
    case ExprOp::kNotEqual:
      return a != b;
    case ExprOp::kLess:
      return a < b;
    case ExprOp::kLessEqual:
      return a <= b;
    case ExprOp::kGreater:
      return a > b;
    default:
      return a >= b;
  }
}

TEST_CASE("ir comparison: the negated one holds where it does not, the swapped one with the operands swapped") {
  for (const ExprOp op : kAll) {
    CHECK(IsComparison(op));
    for (int a = 0; a < 3; ++a) {
      CHECK(Holds(Negated(op), a, 1) == !Holds(op, a, 1));
      CHECK(Holds(Swapped(op), 1, a) == Holds(op, a, 1));
    }
  }
  CHECK_FALSE(IsComparison(ExprOp::kAdd));
  CHECK_FALSE(IsComparison(ExprOp::kAnd));
}

}  // namespace
}  // namespace ncport::ir
