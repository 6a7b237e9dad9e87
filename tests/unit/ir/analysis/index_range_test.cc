#include "ir/analysis/index_range.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir::analysis {
namespace {

TEST_CASE("an index is bounded by its own text or not at all") {
  Module module;
  ExprBuilder e(module);
  const SpaceId space = AddSpace(module, "#", 1, 33, Type::kNumber, StartValue::kVacant);
  const ExprId cell = e.Cell(space, 1);
  const auto mod = [&](ExprId a, const char* b) {
    return e.Binary(ExprOp::kModulo, a, e.Number(b), Expr::kOperandsToInt);
  };
  const auto add = [&](const char* a, ExprId b) { return e.Binary(ExprOp::kAdd, e.Number(a), b); };

  const auto positive = IndexRangeOf(module, add("110", mod(e.Function(Function::kAbs, {cell}), "3")));
  REQUIRE(positive);
  CHECK(positive->first == 110);
  CHECK(positive->last == 112);
  const auto signed_rest = IndexRangeOf(module, add("110", mod(cell, "3")));
  REQUIRE(signed_rest);
  CHECK(signed_rest->first == 108);
  CHECK(signed_rest->last == 112);
  const auto literal = IndexRangeOf(module, e.Unary(ExprOp::kGroup, e.Number("500.4")));
  REQUIRE(literal);
  CHECK(literal->first == 500);
  CHECK(literal->last == 500);

  CHECK_FALSE(IndexRangeOf(module, cell));
  CHECK_FALSE(IndexRangeOf(module, add("100", cell)));
  CHECK_FALSE(IndexRangeOf(module, mod(cell, "3")));  // may be below 0
  CHECK_FALSE(IndexRangeOf(module, e.Binary(ExprOp::kDivide, e.Number("100"), mod(cell, "3"))));
}

}  // namespace
}  // namespace ncport::ir::analysis
