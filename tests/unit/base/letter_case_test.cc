#include "base/letter_case.h"

#include <doctest/doctest.h>

namespace ncport {
namespace {

TEST_CASE("only the letters A to Z have a case") {
  CHECK(UpperOf("az@[`{ 09_\xE4") == "AZ@[`{ 09_\xE4");
  CHECK(LowerOf("AZ@[`{ 09_\xC4") == "az@[`{ 09_\xC4");
  for (int byte = 0; byte < 256; ++byte) {
    const char c = static_cast<char>(byte);
    const bool capital = c >= 'A' && c <= 'Z', small = c >= 'a' && c <= 'z';
    CHECK((Upper(c) == c) == !small);
    CHECK((Lower(c) == c) == !capital);
    if (small) CHECK(Lower(Upper(c)) == c);
  }
}

TEST_CASE("texts are the same whatever the case of their letters") {
  CHECK(EqualIgnoringCase("Cycle81", "CYCLE81"));
  CHECK(EqualIgnoringCase("", ""));
  CHECK_FALSE(EqualIgnoringCase("CYCLE8", "CYCLE81"));
  CHECK_FALSE(EqualIgnoringCase("a@", "A`"));  // 0x40 and 0x60 differ by the bit that makes letters small
}

}  // namespace
}  // namespace ncport
