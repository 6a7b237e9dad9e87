#include "ir/transform/conditions.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

/// Truth of comparisons `R(n) <> 0` under an assignment of the cells: bit n = R(n) is not 0.
struct Fixture {
  Module module;
  ExprBuilder e{module};
  SpaceId space = AddSpace(module, "R", 0, 99);
  ExprId Is(std::uint32_t number) { return e.Binary(ExprOp::kNotEqual, e.Cell(space, number), e.Number("0")); }

  bool Holds(ExprId id, unsigned bits) const {
    const Expr& expr = module.exprs[id];
    const std::uint32_t cell = module.exprs[ExprId{expr.a}].b;
    const bool not_zero = (bits >> cell & 1U) != 0;
    return expr.op == ExprOp::kNotEqual ? not_zero : !not_zero;
  }
  bool Truth(ExprId id, unsigned bits) const {
    const Expr& expr = module.exprs[id];
    switch (expr.op) {
      case ExprOp::kAnd:
        return Truth(ExprId{expr.a}, bits) && Truth(ExprId{expr.b}, bits);
      case ExprOp::kOr:
        return Truth(ExprId{expr.a}, bits) || Truth(ExprId{expr.b}, bits);
      case ExprOp::kNot:
        return !Truth(ExprId{expr.a}, bits);
      case ExprOp::kGroup:
        return Truth(ExprId{expr.a}, bits);
      default:
        return Holds(id, bits);
    }
  }
  /// Does the chain reach the target?
  bool Jumps(const std::vector<ConditionalJump>& chain, unsigned bits) const {
    std::size_t at = 0;
    while (at < chain.size()) {
      const ConditionalJump& step = chain[at];
      if (step.condition.Valid() && !Holds(step.condition, bits)) {
        ++at;
        continue;
      }
      if (step.to == ConditionalJump::kTarget) return true;
      REQUIRE(step.to > static_cast<std::int32_t>(at));
      at = static_cast<std::size_t>(step.to);
    }
    return false;
  }
};

TEST_CASE("a chain jumps exactly when the condition has the wanted truth value") {
  Fixture f;
  using enum ExprOp;
  const auto b = [&](ExprOp op, ExprId x, ExprId y) { return f.e.Binary(op, x, y); };
  const auto no = [&](ExprId x) { return f.e.Unary(kNot, f.e.Unary(kGroup, x)); };
  const ExprId conditions[] = {
      f.Is(0),
      b(kAnd, f.Is(0), f.Is(1)),
      b(kOr, f.Is(0), f.Is(1)),
      no(b(kAnd, f.Is(0), f.Is(1))),
      b(kOr, b(kAnd, f.Is(0), f.Is(1)), f.Is(2)),
      b(kAnd, b(kOr, f.Is(0), f.Is(1)), b(kOr, f.Is(2), no(f.Is(3)))),
      no(b(kOr, b(kAnd, f.Is(0), no(f.Is(1))), b(kAnd, no(f.Is(2)), f.Is(3)))),
      b(kAnd, b(kAnd, b(kOr, b(kAnd, f.Is(0), f.Is(1)), f.Is(2)), f.Is(3)), no(f.Is(0))),
  };
  for (const ExprId condition : conditions) {
    for (const bool sense : {true, false}) {
      const std::vector<ConditionalJump> chain = JumpsFor(f.module, condition, sense);
      for (unsigned bits = 0; bits < 16; ++bits) {
        CAPTURE(bits);
        CHECK(f.Jumps(chain, bits) == (f.Truth(condition, bits) == sense));
      }
    }
  }
}

TEST_CASE("a number as a condition is compared with 0") {
  Fixture f;
  const std::vector<ConditionalJump> chain = JumpsFor(f.module, f.e.Cell(f.space, 5), true);
  REQUIRE(chain.size() == 1);
  CHECK(f.module.exprs[chain[0].condition].op == ExprOp::kNotEqual);
  CHECK(JumpsFor(f.module, f.e.Literal(0, Type::kBool), true).empty());
  const std::vector<ConditionalJump> always = JumpsFor(f.module, f.e.Literal(1, Type::kBool), true);
  REQUIRE(always.size() == 1);
  CHECK_FALSE(always[0].condition.Valid());
}

TEST_CASE("truth values inside a comparison are no plain comparison") {
  Fixture f;
  CHECK(IsPlainComparison(f.module, f.Is(0)));
  const ExprId trap = f.e.Binary(ExprOp::kEqual, f.e.Binary(ExprOp::kAnd, f.Is(0), f.Is(1)), f.e.Number("1"));
  CHECK_FALSE(IsPlainComparison(f.module, trap));
  CHECK_FALSE(IsPlainComparison(f.module, f.e.Binary(ExprOp::kAnd, f.Is(0), f.Is(1))));
}

}  // namespace
}  // namespace ncport::ir::transform
