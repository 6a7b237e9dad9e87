#include "ir/expr_places.h"

#include <doctest/doctest.h>

#include "ir/module.h"

namespace ncport::ir {
namespace {

ExprId At(std::size_t id) { return ExprId{id}; }

TEST_CASE("ir places: expressions without an entry have none") {
  ExprPlaces places;
  places.Add(At(1), {4, 2});
  places.Add(At(2), {});
  places.Add(At(5), {9, 1});
  CHECK(places.All().size() == 2);
  CHECK(places.Of(At(1)).begin == 4);
  CHECK(places.Of(At(5)).begin == 9);
  for (const std::size_t none : {0U, 2U, 3U, 6U}) CHECK(places.Of(At(none)).length == 0);
  CHECK(places.Of(ExprId{}).length == 0);
}

TEST_CASE("ir places: set gives and replaces, truncate forgets") {
  ExprPlaces places;
  places.Add(At(1), {4, 2});
  places.Add(At(5), {9, 1});
  places.Set(At(5), {7, 3});
  places.Set(At(3), {6, 1});
  CHECK(places.Of(At(5)).length == 3);
  CHECK(places.Of(At(3)).begin == 6);
  CHECK(places.All()[1].expr == At(3));
  places.Truncate(4);
  CHECK(places.Of(At(5)).length == 0);
  CHECK(places.Of(At(3)).begin == 6);
}

TEST_CASE("ir places: the number of a word stands where the word stands") {
  Module module;
  Word word;
  word.begin = 3;
  word.length = 5;
  word.value = module.AddExpr(Expr{});
  Block block;
  block.words = {module.words.Add(word).value, 1};
  const SourceRange range = module.RangeOf(block, word.value);
  CHECK(range.begin == 3);
  CHECK(range.end == 8);
  CHECK(module.RangeOf(block, module.AddExpr(Expr{})).end == 0);
}

}  // namespace
}  // namespace ncport::ir
