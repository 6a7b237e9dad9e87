#include "base/near_name.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace ncport {
namespace {

const std::vector<std::string_view>& Names() {
  static const std::vector<std::string_view> names{"diameter", "decimals", "units", "rapid"};
  return names;
}

TEST_CASE("a slip finds the name that was meant") {
  CHECK(NearName("diametr", Names()) == "diameter");
  CHECK(NearName("daimeter", Names()) == "diameter");  // swapped neighbours are one edit
  CHECK(NearName("RAPID", Names()) == "rapid");
  CHECK(NearName("unit", Names()) == "units");
}

TEST_CASE("a name far from all finds none") {
  CHECK(NearName("colour", Names()).empty());
  CHECK(NearName("", Names()).empty());
  CHECK(NearName("x", Names()).empty());
  CHECK(NearName(std::string(65, 'd'), Names()).empty());
}

TEST_CASE("the nearest of several wins, the first of equals") {
  const std::vector<std::string_view> names{"loop", "loops", "loo"};
  CHECK(NearName("loops", names) == "loops");
  CHECK(NearName("loo?", names) == "loop");
}

TEST_CASE("of names as near, the one that starts longer alike or whose key lies beside wins") {
  const std::vector<std::string_view> functions{"TAN", "ATAN2"};
  CHECK(NearName("ATAN", functions) == "ATAN2");
  const std::vector<std::string_view> modes{"DIAMOF", "DIAMON"};
  CHECK(NearName("DIAMOM", modes) == "DIAMON");
  CHECK(NearName("DIAMOG", modes) == "DIAMOF");
}

}  // namespace
}  // namespace ncport
