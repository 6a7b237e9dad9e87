#include "prove/parameter_sets.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

namespace ncport::prove {
namespace {

Input Between(const char* name, double low, double high) {
  Input input;
  input.name = name;
  input.low = low;
  input.high = high;
  return input;
}

/// The inputs of the turning cycle in samples/: its ranges decide how many layers a run has.
std::vector<Input> TurningCycle() {
  std::vector<Input> inputs{Between("EXTD", 20, 300), Between("INTD", 5, 0), Between("RALL", 0.2, 9.7),
                            Between("FALLX", 0, 1)};
  inputs[1].high.reset();
  inputs[1].high_of = RelatedEnd{0, -1};
  return inputs;
}

TEST_CASE("an end of a range that is another input holds in every set") {
  ParameterSource source(TurningCycle(), 1);
  bool at_the_end = false;
  for (int i = 0; i < 2000; ++i) {
    const ParameterSet set = source.Next();
    CHECK(set[1] >= 5);
    CHECK(set[1] <= set[0] - 1);
    at_the_end = at_the_end || set[1] == set[0] - 1;
  }
  CHECK(at_the_end);
}

TEST_CASE("a changed value must keep the ranges of the others") {
  ParameterSource source(TurningCycle(), 1);
  const ParameterSet set{100, 50, 2, 0};
  CHECK(source.With(set, 1, 99).has_value());
  CHECK_FALSE(source.With(set, 1, 99.5).has_value());
  CHECK(source.With(set, 0, 51).has_value());
  CHECK_FALSE(source.With(set, 0, 50.5).has_value());
}

TEST_CASE("no layer, one, seven and a hundred and more layers occur, dividing evenly or not") {
  ParameterSource source(TurningCycle(), 1);
  std::set<int> layers;
  bool many = false, even = false, uneven = false;
  for (int i = 0; i < 1000; ++i) {
    const ParameterSet set = source.Next();
    const double allowance = std::max(0.0, (set[0] - set[1]) / 2 - set[3]);
    const double whole = std::trunc(allowance / set[2]);
    const bool divides = allowance - whole * set[2] == 0;
    const int count = static_cast<int>(whole) + (divides ? 0 : 1);
    layers.insert(count);
    many = many || count >= 100;
    if (count > 0) (divides ? even : uneven) = true;
  }
  CHECK(layers.contains(0));
  CHECK(layers.contains(1));
  CHECK(layers.contains(7));
  CHECK(many);
  CHECK(even);
  CHECK(uneven);
}

TEST_CASE("a range that is empty in some draws is drawn again") {
  std::vector<Input> inputs{Between("A", 0, 10), Between("B", 5, 0)};
  inputs[1].high.reset();
  inputs[1].high_of = RelatedEnd{0, 0};
  ParameterSource source(inputs, 7);
  for (int i = 0; i < 200; ++i) {
    const ParameterSet set = source.Next();
    CHECK(set[0] >= 5);
    CHECK(set[1] <= set[0]);
  }
}

TEST_CASE("an input that may miss does so in some sets, and its neighbours keep their values") {
  Input angle;
  angle.name = "O9100.A";
  angle.seen = {15};
  angle.may_miss = true;
  Input depth = Between("O9100.Z", -20, -1);
  depth.high_of = RelatedEnd{0, -16};
  depth.high.reset();
  ParameterSource source({angle, depth}, 7);
  CHECK(source.Next()[0] != kMissing);
  int missing = 0;
  for (int i = 0; i < 400; ++i) {
    const ParameterSet set = source.Next();
    CHECK(set[1] >= -20);
    if (set[0] != kMissing) continue;
    ++missing;
    CHECK(!source.With(set, 0, 5));
  }
  CHECK(missing > 50);
  CHECK(missing < 200);
}

TEST_CASE("odd sets change the sign of inputs without a range, or make them 0") {
  Input radius;
  radius.name = "O9100.R";
  radius.seen = {35};
  ParameterSource source({radius, Between("O9100.F", 100, 200)}, 3);
  bool zero = false, negative = false;
  for (int i = 0; i < 100; ++i) {
    const auto set = source.NextOdd();
    REQUIRE(set);
    CHECK((*set)[0] <= 0);
    CHECK((*set)[1] >= 100);
    zero = zero || (*set)[0] == 0;
    negative = negative || (*set)[0] < 0;
  }
  CHECK(zero);
  CHECK(negative);
  ParameterSource declared({Between("O9100.F", 100, 200)}, 3);
  CHECK(!declared.NextOdd());
}

}  // namespace
}  // namespace ncport::prove
