#include "backends/iso/flat_numbers.h"

#include <doctest/doctest.h>

#include <string>

namespace ncport::backends::iso {
namespace {

std::string Word(char letter, std::int64_t increments, int decimals) {
  TextBuffer out;
  AppendWord(out, letter, increments, decimals);
  return std::string(out.View());
}

TEST_CASE("a product is rounded once, from its exact value") {
  CHECK(RoundToIncrements(1.0004, 1000) == 1000);
  CHECK(RoundToIncrements(1.0006, 1000) == 1001);
  CHECK(RoundToIncrements(-1.0006, 1000) == -1001);
  // 1.0005 is below the tie as a double, though its product with 1000 is 1000.5 in double.
  CHECK(RoundToIncrements(1.0005, 1000) == 1000);
  CHECK(RoundToIncrements(-1.0005, 1000) == -1000);
  // Exact ties go away from zero.
  CHECK(RoundToIncrements(0.5, 1) == 1);
  CHECK(RoundToIncrements(-0.5, 1) == -1);
  CHECK(RoundToIncrements(0.0625, 1000) == 63);
  // Just below a half: adding 0.5 first would give 1.
  CHECK(RoundToIncrements(0.49999999999999994, 1) == 0);
}

TEST_CASE("words have a point and no trailing zeros") {
  CHECK(Word('X', 10000, 3) == "X10.");
  CHECK(Word('X', 10500, 3) == "X10.5");
  CHECK(Word('Z', -5, 3) == "Z-0.005");
  CHECK(Word('Z', 0, 3) == "Z0.");
  CHECK(Word('I', 123456789, 4) == "I12345.6789");
  CHECK(Word('I', 7, 0) == "I7.");
}

}  // namespace
}  // namespace ncport::backends::iso
