// ncport_random: makes random programs and checks them in all directions. Failing ones are made small and shown.
//
//   ncport_random [--count N] [--seed S] [--direction NAME]... [--weights frame=0,case=5] [--show] [--no-shrink]
//   [--table]
//
// The last line counts the checks: "N passed, N failed". Exit 1 if one failed or more than a tenth were refused.
#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_buffer.h"
#include "dialects/machine.h"
#include "dialects/registry.h"
#include "ir/dump.h"
#include "tests/random/census.h"
#include "tests/random/checks.h"
#include "tests/random/generator.h"
#include "tests/random/refusals.h"
#include "tests/random/shop.h"
#include "tests/random/shrink.h"

namespace ncport::tests::random {

namespace {

struct Arguments {
  std::uint64_t count = 100;
  std::uint64_t seed = 1;
  std::vector<std::string> directions;
  std::string weights;
  bool show = false;
  bool shrink = true;
  bool table = true;
};

bool ParseNumber(std::string_view text, std::uint64_t& value) {
  return std::from_chars(text.data(), text.data() + text.size(), value).ptr == text.data() + text.size() &&
         !text.empty();
}

bool ParseArguments(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name == "--show") {
      arguments.show = true;
    } else if (name == "--no-shrink") {
      arguments.shrink = false;
    } else if (name == "--no-table") {
      arguments.table = false;
    } else if (i + 1 < argc && name == "--count" && ParseNumber(argv[i + 1], arguments.count)) {
      ++i;
    } else if (i + 1 < argc && name == "--seed" && ParseNumber(argv[i + 1], arguments.seed)) {
      ++i;
    } else if (i + 1 < argc && name == "--direction" && FindDirection(argv[i + 1]) != nullptr) {
      arguments.directions.emplace_back(argv[++i]);
    } else if (i + 1 < argc && name == "--weights") {
      arguments.weights = argv[++i];
    } else {
      fmt::print(stderr,
                 "wrong argument: {}\nusage: ncport_random [--count N] [--seed S] [--direction NAME]... [--weights "
                 "FEATURE=N,...]\n"
                 "                     [--show] [--no-shrink] [--no-table]\ndirections:\n",
                 name);
      for (const Direction& direction : Directions())
        fmt::print(stderr, "  {:<22} {}\n", direction.name, direction.title);
      return false;
    }
  }
  return true;
}

struct Tally {
  std::uint64_t agrees = 0, refused = 0, fails = 0, no_program = 0;
  [[nodiscard]] std::uint64_t Checked() const { return agrees + refused + fails; }
};

/// A direction ready to be checked, on mills and lathes.
struct Prepared {
  const Direction* direction = nullptr;
  dialects::Profile profiles[2];  // of mill and lathe
  ir::Machine machines[2];
  dialects::Profile targets[2];
  dialects::Config configs[2];
  Weights weights[2];
  Tally tally;

  [[nodiscard]] Subject SubjectOf(const ir::Module& module, ir::ProgramId main, bool lathe) const {
    const std::size_t i = lathe ? 1 : 0;
    return {&module, main, &profiles[i], &machines[i], &targets[i], &configs[i]};
  }
};

std::string ShrinkAndShow(const Prepared& prepared, const Sample& sample, bool lathe, const Finding& finding) {
  const auto subject_of = [&](const ir::Module& module) { return prepared.SubjectOf(module, sample.main, lathe); };
  const ir::Module small = Shrink(sample.module, [&](const ir::Module& module) {
    const Finding other = prepared.direction->check(subject_of(module), *prepared.direction);
    return other.verdict == finding.verdict && other.stage == finding.stage;
  });
  const Finding shown = prepared.direction->check(subject_of(small), *prepared.direction);
  TextBuffer dump;
  ir::Dump(small, dump, {.places = false, .spellings = false});
  return fmt::format("--- shrunk from {} to {}\n{}\n{}\n--- IR\n{}", SizeOf(sample.module), SizeOf(small), shown.text,
                     shown.artefact, dump.View());
}

/// More than a tenth; of few programs chance may bring a little more (three standard deviations).
bool IsTooMuch(std::uint64_t refused, std::uint64_t checked) {
  constexpr std::uint64_t kFew = 500;
  const auto all = static_cast<double>(checked);
  const double chance = checked < kFew ? 3 * std::sqrt(all * 0.1 * 0.9) : 0;
  return static_cast<double>(refused) > 0.1 * all + chance;
}

/// A feature of --weights that the direction's language does not have; null: there is none.
const char* Missing(const Direction& direction, const Weights& weights) {
  for (std::size_t i = 0; i < kFeatures; ++i) {
    const auto feature = static_cast<Feature>(i);
    if (weights.Of(feature) != 0 && !Exists(feature, direction.flavour)) return NameOf(feature).data();
  }
  return nullptr;
}

int RunAll(const Arguments& arguments) {
  std::vector<Prepared> prepared;
  for (const Direction& direction : Directions()) {
    bool wanted = arguments.directions.empty();
    for (const std::string& name : arguments.directions) wanted = wanted || name == direction.name;
    if (!wanted) continue;
    Prepared next;
    next.direction = &direction;
    next.profiles[0] = AnsweredProfile(direction.mill);
    next.profiles[1] = AnsweredProfile(direction.lathe);
    for (int i = 0; i < 2; ++i) {
      next.machines[i] = dialects::MachineFor(next.profiles[i]);
      const std::string_view target = i == 0 ? direction.target_mill : direction.target_lathe;
      if (target.empty()) continue;
      next.targets[i] = AnsweredProfile(target);
      next.configs[i] = ShopDataFor(next.targets[i]);
    }
    for (int i = 0; i < 2; ++i) {
      next.weights[i] = Weights::For(direction.flavour);
      std::string wrong;
      if (!next.weights[i].Parse(direction.without[i], wrong) || !next.weights[i].Parse(arguments.weights, wrong)) {
        fmt::print(stderr, "unknown weight: {}\n", wrong);
        return 2;
      }
      if (const char* const missing = Missing(direction, next.weights[i]); missing != nullptr) {
        fmt::print(stderr, "{}: programs of this direction have no {}; choose others with --direction\n",
                   direction.name, missing);
        return 2;
      }
    }
    prepared.push_back(std::move(next));
  }

  Census census;
  std::map<std::string, std::uint64_t> refusals;
  std::set<std::string> unlisted;  // each is a failure
  for (std::uint64_t i = 0; i < arguments.count; ++i) {
    const std::uint64_t seed = arguments.seed + i;
    const bool lathe = seed % 3 == 0;
    for (Prepared& next : prepared) {
      Options options;
      options.flavour = next.direction->flavour;
      options.profile = &next.profiles[lathe ? 1 : 0];
      options.weights = next.weights[seed % 2];
      const Sample sample = Generate(seed, options);
      if (&next == prepared.data()) census.Add(sample.module);
      const Finding finding = next.direction->check(next.SubjectOf(sample.module, sample.main, lathe), *next.direction);
      if (arguments.show) {
        TextBuffer dump;
        ir::Dump(sample.module, dump, {.places = false, .spellings = false});
        fmt::print("{}\n{}\n{}\n", finding.text, finding.artefact, dump.View());
      }
      switch (finding.verdict) {
        case Verdict::kAgrees:
          ++next.tally.agrees;
          break;
        case Verdict::kNoProgram:
          ++next.tally.no_program;
          break;
        case Verdict::kRefused:
          ++next.tally.refused;
          ++refusals[fmt::format("{} {}", next.direction->name, finding.stage)];
          if (!IsListed(finding.stage) && unlisted.insert(finding.stage).second) {
            fmt::print("seed {}, {}: tests/refusals.txt does not list the refusal: {}\n{}\n", seed,
                       next.direction->name, finding.stage, finding.text);
          }
          break;
        case Verdict::kFails:
          ++next.tally.fails;
          fmt::print("seed {}, {} ({}): {} fails\n{}\n", seed, next.direction->name, lathe ? "lathe" : "mill",
                     finding.stage, finding.text);
          if (arguments.shrink && next.tally.fails <= 3)
            fmt::print("{}\n", ShrinkAndShow(next, sample, lathe, finding));
          break;
      }
    }
  }

  if (arguments.table) {
    TextBuffer table;
    census.Print(table);
    fmt::print("\n{}", table.View());
  }
  std::uint64_t passed = 0, failed = unlisted.size();
  fmt::print("\n{:<24}{:>10}{:>10}{:>10}{:>10}\n", "direction", "agree", "refused", "fail", "none");
  for (const Prepared& next : prepared) {
    const Tally& tally = next.tally;
    fmt::print("{:<24}{:>10}{:>10}{:>10}{:>10}\n", next.direction->name, tally.agrees, tally.refused, tally.fails,
               tally.no_program);
    passed += tally.agrees + tally.refused;
    failed += tally.fails;
    if (IsTooMuch(tally.refused, tally.Checked())) {
      fmt::print("{}: more than a tenth is refused\n", next.direction->name);
      ++failed;
    }
  }
  for (const auto& [reason, count] : refusals) fmt::print("refused {:>8} {}\n", count, reason);
  fmt::print("{} passed, {} failed\n", passed, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace

}  // namespace ncport::tests::random

int main(int argc, char** argv) {
  ncport::tests::random::Arguments arguments;
  if (!ncport::tests::random::ParseArguments(argc, argv, arguments)) return 2;
  return ncport::tests::random::RunAll(arguments);
}
