#include "prove/verify.h"

#include <doctest/doctest.h>

#include <functional>
#include <regex>
#include <string>
#include <string_view>

#include "ir/parse_dump.h"

namespace ncport::prove {
namespace {

/// What a translation writes at its head, so that it relies on no mode of the machine.
constexpr std::string_view kModes =
    "  @m:0 : motion linear; plane xy; distance absolute; units mm; feed-mode per-minute; comp off\n";

ir::Module Parsed(std::string_view blocks) {
  diag::Sink sink;
  const std::string cells = std::regex_replace(std::string(blocks), std::regex("\\b([RQ])\\["), "cell:real $1[");
  Result<ir::Module> module = ir::ParseDump(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nspace Q 0..99 real kept all zero\nprogram M main @m:0\n" +
          (blocks.starts_with("  @m:0 ") ? std::string() : std::string(kModes)) + cells + "  @m:99 : program-end #30\n",
      sink);
  REQUIRE_MESSAGE(module.Ok(), (sink.Empty() ? "" : sink.All().front().message));
  return std::move(*module);
}

struct Pair {
  ir::Machine machine;
  ir::Module source, target;
  VerifyOptions options;
  std::vector<BoundInput> inputs;
  diag::Sink sink;

  Pair(std::string_view source_blocks, std::string_view target_blocks)
      : source(Parsed(source_blocks)), target(Parsed(target_blocks)) {
    machine.start.motion = ir::Motion::kLinear;
    machine.start.plane = ir::Plane::kXY;
    machine.start.distance = ir::Distance::kAbsolute;
    machine.start.units = ir::Units::kMm;
    machine.start.feed_mode = ir::FeedMode::kPerMinute;
    machine.start.comp = ir::CutterComp::kOff;
    machine.feed_needed = false;
    options.runs = 40;
  }
  explicit Pair(std::string_view both) : Pair(both, both) {}
  /// R1 of both sides, from `low` to `high`.
  Pair& Vary(double low, double high) {
    BoundInput bound;
    bound.input.name = "R1";
    bound.input.low = low;
    bound.input.high = high;
    InputPlace place;
    place.space = ir::SpaceId{0U};
    place.cell = 1;
    bound.source = bound.target = {place};
    inputs.push_back(bound);
    return *this;
  }
  Verification Run() {
    Side a, b;
    a.module = &source;
    b.module = &target;
    a.machine = b.machine = &machine;
    a.entry = b.entry = ir::ProgramId{0U};
    return Verify(a, b, inputs, options, sink);
  }
};

TEST_CASE("verify: a program against itself shows no difference, over as many sets as asked for") {
  const Verification same = Pair("  @m:1 : axis X = R[1]; feed = 100\n  @m:2 : axis X = 5\n").Vary(0, 100).Run();
  CHECK(same.compared);
  CHECK_FALSE(same.difference.has_value());
  CHECK(same.sets_counted == 40);
  CHECK(same.sets_run == 40);
  CHECK(same.events_compared > 80);
}

TEST_CASE("verify: without inputs one run is all there is") {
  const Verification same = Pair("  @m:1 : axis X = 1\n  @m:2 : axis X = 5\n").Run();
  CHECK(same.compared);
  CHECK(same.sets_counted == 1);
}

TEST_CASE("verify: a difference that one value of many shows is found, with the set that shows it") {
  Pair pair(
      "  @m:1 : axis X = R[1]\n",
      "  @m:1 link +2 : if = gt:bool(R[1], 90)\n  @m:2 : assign R[1] = add:real(R[1], 1)\n  @m:3 link -2 : end-if\n"
      "  @m:4 : axis X = R[1]\n");
  const Verification differs = pair.Vary(0, 100).Run();
  CHECK_FALSE(differs.compared);
  REQUIRE(differs.difference.has_value());
  REQUIRE(differs.difference_set.size() == 1);
  CHECK(differs.difference_set[0] > 90);
  CHECK(differs.difference_start == "clean start");
}

TEST_CASE("verify: a branch of the source that no set takes leaves the pair uncompared, unless it is listed") {
  const std::string blocks =
      "  @m:1 link +2 : if = gt:bool(R[1], 500)\n  @m:2 : axis X = 7\n  @m:3 link -2 : end-if\n  @m:4 : axis X = "
      "R[1]\n";
  const Verification open = Pair(blocks).Vary(0, 100).Run();
  CHECK_FALSE(open.compared);
  CHECK_FALSE(open.difference.has_value());
  REQUIRE(open.open_branches.size() == 1);
  CHECK(open.open_branches[0].taken);
  CHECK(open.branches == 2);
  CHECK(open.branches_taken == 1);
  CHECK(open.not_compared.find("never taken") != std::string::npos);
  Pair listed(blocks);
  listed.options.listed_branches = {listed.source.programs[ir::ProgramId{0U}].blocks[1]};
  const Verification accepted = listed.Vary(0, 100).Run();
  CHECK(accepted.compared);
  CHECK(accepted.branches_listed == 1);
}

TEST_CASE("verify: sets that both sides refuse before motion agree and do not count") {
  const std::string blocks =
      "  @m:1 link +2 : if = gt:bool(R[1], 50)\n  @m:2 : alarm stops = 65000\n  @m:3 link -2 : end-if\n"
      "  @m:4 : axis X = R[1]\n";
  const Verification some = Pair(blocks).Vary(0, 100).Run();
  CHECK(some.compared);
  CHECK(some.alarms_agreed > 0);
  CHECK(some.sets_counted == 40);
  // All of them: nothing was compared.
  const Verification all = Pair(blocks).Vary(60, 100).Run();
  CHECK_FALSE(all.compared);
  CHECK(all.not_compared.find("moved before an alarm") != std::string::npos);
}

TEST_CASE("verify: blocks behind an alarm that no run comes past were not compared") {
  const Verification stopped =
      Pair("  @m:1 : axis X = 1\n  @m:2 : assign R[2] = div:real(1, 0)\n  @m:3 : axis X = 2\n").Run();
  CHECK_FALSE(stopped.compared);
  REQUIRE(stopped.stops.size() == 1);
  CHECK(stopped.not_compared.find("past an alarm") != std::string::npos);
}

TEST_CASE("verify: a target that relies on what memory happens to hold is found by a poisoned start") {
  Pair pair("  @m:1 : axis X = 1\n  @m:2 : axis X = 2\n", "  @m:1 : axis X = 1\n  @m:2 : axis X = add:real(2, Q[7])\n");
  CHECK(pair.Run().compared);  // garbage is put where the options say
  pair.options.garbage = {ir::SpaceId{1U}};
  const Verification differs = pair.Run();
  REQUIRE(differs.difference.has_value());
  CHECK(differs.difference_start == "poisoned start");
}

TEST_CASE("verify: a target that relies on the distance mode at its start is found by a poisoned start") {
  const std::string modes = "  @m:0 : motion linear; plane xy; units mm; feed-mode per-minute; comp off";
  const std::string relies = modes + "; axis X = 1\n  @m:2 : axis X = 2\n";
  const std::string sets = modes + "; distance absolute; axis X = 1\n  @m:2 : axis X = 2\n";
  CHECK(Pair(relies, sets).Run().compared);
  CHECK_FALSE(Pair(sets, relies).Run().compared);
  Pair without(sets, relies);
  without.options.poison_distance = false;  // a target that has no words for it
  CHECK(without.Run().compared);
}

TEST_CASE("verify: blocks that may be skipped are compared skipped as well") {
  const std::string source = "  @m:1 : axis X = 1\n  @m:2 skip 1 : axis X = 5\n  @m:3 : axis X = 9\n";
  CHECK(Pair(source).Run().compared);
  const Verification differs = Pair(source, "  @m:1 : axis X = 1\n  @m:2 : axis X = 5\n  @m:3 : axis X = 9\n").Run();
  REQUIRE(differs.difference.has_value());
  CHECK(differs.difference_start.find("skip levels") != std::string::npos);
  // The first level of the target may be another number.
  Pair shifted(source, "  @m:1 : axis X = 1\n  @m:2 skip 0 : axis X = 5\n  @m:3 : axis X = 9\n");
  shifted.options.target_skip_shift = -1;
  CHECK(shifted.Run().compared);
}

TEST_CASE("verify: final values of variables that outlive the program agree") {
  Pair pair("  @m:1 : axis X = 1\n  @m:2 : assign R[2] = 7\n", "  @m:1 : axis X = 1\n  @m:2 : assign R[2] = 8\n");
  CHECK(pair.Run().compared);
  pair.options.final_values = {{"R2", "R2"}};
  const Verification differs = pair.Run();
  REQUIRE(differs.difference.has_value());
  CHECK(differs.difference->what.find("R2 ends as 7") != std::string::npos);
}

TEST_CASE("verify: a run that cannot go on is no agreement") {
  // An increment from an unknown position: the source says so in its findings, the target in the reason.
  Pair source("  @m:1 : axis X incremental = 1\n", "  @m:1 : axis X = 1\n");
  const Verification broken = source.Run();
  CHECK_FALSE(broken.compared);
  CHECK(broken.not_compared.find("a run of the source could not go on") != std::string::npos);
  CHECK_FALSE(source.sink.Empty());
  Pair target("  @m:1 : axis X = 1\n", "  @m:1 : axis X incremental = 1\n");
  const Verification other = target.Run();
  CHECK_FALSE(other.compared);
  CHECK(other.not_compared.find("a run of the target could not go on") != std::string::npos);
  CHECK(target.sink.Empty());
}

TEST_CASE("verify: an endless source ends at the limit") {
  Pair pair("  @m:1 label L : axis X = 1\n  @m:2 : jump backward label L\n");
  pair.options.max_blocks = 1000;
  const Verification endless = pair.Run();
  CHECK_FALSE(endless.compared);
  CHECK_FALSE(endless.difference.has_value());
}

TEST_CASE("verify: sets are aimed at whole quotients, where one layer more or less is decided") {
  Pair pair("  @m:1 : assign R[2] = call:real truncate(div:real(R[1], 0.7))\n  @m:2 : axis X = R[2]\n");
  const Verification aimed = pair.Vary(1, 50).Run();
  CHECK(aimed.compared);
  CHECK(aimed.exact_multiples > 0);
}

TEST_CASE("verify: the same seed draws the same sets") {
  const auto run = [](std::uint64_t seed) {
    Pair pair("  @m:1 : axis X = R[1]\n",
              "  @m:1 link +2 : if = gt:bool(R[1], 80)\n  @m:2 : axis X = 1\n"
              "  @m:3 link -2 : end-if\n  @m:4 : axis X = R[1]\n");
    pair.options.seed = seed;
    return pair.Vary(0, 100).Run().difference_set;
  };
  CHECK(run(3) == run(3));
}

TEST_CASE("few values in all: every set is run, and that is enough") {
  Pair pair("  @m:1 : axis X = R[1]; feed = 100\n");
  pair.Vary(0, 6);
  Verification real = pair.Run();
  CHECK(real.sets_counted == 40);  // a REAL has more values than its ends
  pair.inputs[0].input.integer = true;
  Verification whole = pair.Run();
  CHECK(whole.compared);
  CHECK(whole.sets_counted == 7);
  CHECK(whole.sets_run == 7);

  // A difference at one value of them is found for sure.
  Pair other("  @m:1 : axis X = R[1]; feed = 100\n",
             "  @m:1 : jump forward label L = ne:bool(R[1], 4:real)\n"
             "  @m:2 : axis X = 99; feed = 100\n"
             "  @m:3 label L : axis X = R[1]; feed = 100\n");
  other.Vary(0, 150);
  other.options.runs = 200;
  other.inputs[0].input.integer = true;
  CHECK(other.Run().difference);

  // Without a declared end, and with more sets than runs, the least number of runs stays.
  Pair open("  @m:1 : axis X = R[1]; feed = 100\n");
  open.Vary(0, 6);
  open.inputs[0].input.integer = true;
  open.inputs[0].input.high.reset();
  open.options.runs = 5;
  CHECK_FALSE(open.Run().compared);
}

}  // namespace
}  // namespace ncport::prove
