#include "base/string_pool.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace ncport {

TEST_CASE("the empty string is id 0 of a new pool") {
  const StringPool pool;
  CHECK(pool.Size() == 1);
  CHECK(pool.Find("") == StringId{0});
  CHECK(pool.View(StringId{0}).empty());
}

TEST_CASE("equal strings have one id, others differ") {
  StringPool pool;
  const StringId a = pool.Intern("RALL");
  CHECK(pool.Intern("RALL") == a);
  CHECK(pool.Intern("rall") != a);
  CHECK(pool.Intern(std::string_view("RALL\0", 5)) != a);
  CHECK(pool.View(a) == "RALL");
  CHECK_FALSE(pool.Find("RALLY").Valid());
}

TEST_CASE("views stay where they are while the pool grows, moves and takes long strings") {
  StringPool pool;
  std::vector<std::string> names;
  std::vector<std::string_view> views;
  for (int i = 0; i < 50000; ++i) {
    names.push_back("name" + std::to_string(i));
    if (i % 1000 == 0) names.back().append(40000, 'x');
    views.push_back(pool.View(pool.Intern(names.back())));
  }
  const StringPool moved = std::move(pool);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const StringId id = moved.Find(names[i]);
    REQUIRE(id == StringId{i + 1});
    CHECK(moved.View(id).data() == views[i].data());
    CHECK(views[i] == names[i]);
  }
}

TEST_CASE("a copy has the same ids and its own memory") {
  StringPool pool;
  const StringId id = pool.Intern("TOOL");
  StringPool copy;
  copy.Intern("other");
  copy = pool;
  CHECK(copy.Find("TOOL") == id);
  CHECK_FALSE(copy.Find("other").Valid());
  CHECK(copy.View(id).data() != pool.View(id).data());
}

}  // namespace ncport
