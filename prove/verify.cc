#include "prove/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "prove/stage.h"

namespace ncport::prove {

namespace {

bool IsBranch(const ir::Module& module, const ir::Block& block) {
  const auto is_literal = [&](ir::ExprId id) {
    while (module.exprs[id].op == ir::ExprOp::kConvert || module.exprs[id].op == ir::ExprOp::kGroup)
      id = ir::ExprId{module.exprs[id].a};
    return module.exprs[id].op == ir::ExprOp::kLiteral;
  };
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module.words[id];
    switch (word.op) {
      case ir::WordOp::kIf:
      case ir::WordOp::kWhile:
      case ir::WordOp::kUntil:
      case ir::WordOp::kWhen:
        return !is_literal(word.value);
      case ir::WordOp::kFor:
        // Whether it runs at all is a branch; with literal bounds nothing is open.
        return !is_literal(word.value) || !is_literal(module.fors[word.Extra<ir::ForId>()].end);
      case ir::WordOp::kJump:
        if (word.value.Valid()) return true;
        break;
      default:
        break;
    }
  }
  return false;
}

class Verifier {
 public:
  Verifier(const Side& source, const Side& target, const std::vector<BoundInput>& inputs, const VerifyOptions& options,
           diag::Sink& sink)
      : options_(options),
        sink_(sink),
        source_(source, inputs, true),
        target_(target, inputs, false),
        sets_(InputsOf(inputs), options.seed),
        random_(options.seed ^ 0xA5A5A5A5U) {}

  Verification Run();

 private:
  static std::vector<Input> InputsOf(const std::vector<BoundInput>& bound) {
    std::vector<Input> inputs;
    for (const BoundInput& input : bound) inputs.push_back(input.input);
    return inputs;
  }
  /// Runs one set; false: stop, something differs or cannot run.
  bool RunSet(const ParameterSet& set);
  bool ComparePair(const ParameterSet& set, std::uint16_t skip_levels, std::string_view start,
                   exec::Coverage* coverage);
  bool CompareFinalValues(const ParameterSet& set, std::string_view start);
  bool AimAtMultiples(const ParameterSet& set);
  void TryOddValues();
  void CollectSkipLevels();
  void CountBranches();
  void CountStops();
  [[nodiscard]] bool Done() const { return result_.difference.has_value() || !result_.not_compared.empty(); }

  const VerifyOptions& options_;
  diag::Sink& sink_;
  Stage source_, target_;
  ParameterSource sets_;
  Random random_;
  std::set<ParameterSet> seen_;
  std::vector<std::uint16_t> skip_levels_;  // each level alone, then all
  std::vector<std::uint8_t> covered_;
  std::set<std::uint32_t> alarm_blocks_;  // of the source, where a clean run ended in an alarm that nobody wrote
  RecordedTrace source_trace_, target_trace_;
  exec::Coverage coverage_;
  bool moved_ = false, alarmed_ = false;  // of the last clean run
  Verification result_;
};

void Verifier::CollectSkipLevels() {
  std::uint16_t levels = 0;
  for (const ir::Block& block : source_.Module().blocks.All()) {
    if (block.skip_level != ir::Block::kNoSkip) levels = static_cast<std::uint16_t>(levels | (1U << block.skip_level));
  }
  for (std::uint8_t level = 0; level < 16; ++level) {
    if (levels >> level & 1U) skip_levels_.push_back(static_cast<std::uint16_t>(1U << level));
  }
  if (skip_levels_.size() > 1) skip_levels_.push_back(levels);
}

bool Verifier::CompareFinalValues(const ParameterSet& set, std::string_view start) {
  const auto value_of = [](const RecordedTrace& trace, std::string_view name) -> std::string_view {
    for (const exec::Event& event : trace.Events()) {
      if (event.kind == exec::EventKind::kSetVariable && event.text == name) return event.code;
    }
    return {};
  };
  for (const auto& [source_name, target_name] : options_.final_values) {
    const std::string_view a = value_of(source_trace_, source_name);
    const std::string_view b = value_of(target_trace_, target_name);
    if (a.empty() && b.empty()) continue;
    const double x = a.empty() ? 0 : std::strtod(std::string(a).c_str(), nullptr);
    const double y = b.empty() ? 0 : std::strtod(std::string(b).c_str(), nullptr);
    if (std::fabs(x - y) <= 1e-6 * std::max({1.0, std::fabs(x), std::fabs(y)})) continue;
    result_.difference = Difference{fmt::format("{} ends as {}, {} as {}", source_name, a, target_name, b), {}, {}};
    result_.difference_set = set;
    result_.difference_start = start;
    return false;
  }
  return true;
}

bool Verifier::ComparePair(const ParameterSet& set, std::uint16_t skip_levels, std::string_view start,
                           exec::Coverage* coverage) {
  const exec::Outcome a = source_.Run(skip_levels, options_.max_blocks, source_trace_, sink_, coverage);
  diag::Sink target_sink;
  const int shift = options_.target_skip_shift;
  const auto target_levels =
      static_cast<std::uint16_t>(shift >= 0 ? skip_levels << shift : skip_levels >> -shift);  // `/` is the first level
  const exec::Outcome b = target_.Run(target_levels, options_.max_blocks, target_trace_, target_sink, nullptr);
  const auto broken = [](exec::Outcome outcome) {
    return outcome != exec::Outcome::kEnded && outcome != exec::Outcome::kAlarmed;
  };
  if (broken(a) || broken(b)) {
    result_.not_compared = fmt::format("a run of the {} could not go on ({})", broken(a) ? "source" : "target", start);
    if (!broken(a) && !target_sink.All().empty()) {
      const diag::Diagnostic& finding = target_sink.All().front();
      result_.not_compared += fmt::format(": line {}: {}", finding.at.line, finding.message);
    }
    return false;
  }
  Comparison comparison = Compare(source_trace_, target_trace_, options_.compare, target_.StartOffset());
  result_.events_compared += comparison.events_compared;
  result_.spindle_moved_across_rapid += comparison.spindle_moved_across_rapid;
  result_.centers_moved += comparison.centers_moved;
  result_.longest_trace = std::max(result_.longest_trace, source_trace_.Events().size());
  alarmed_ = comparison.source_alarmed_before_motion;
  if (a == exec::Outcome::kAlarmed && !source_trace_.Events().empty()) {
    const exec::Event& last = source_trace_.Events().back();
    if (last.kind == exec::EventKind::kAlarm && last.alarm != ir::AlarmClass::kUser && last.block.Valid())
      alarm_blocks_.insert(last.block.value);
  }
  moved_ = std::any_of(source_trace_.Events().begin(), source_trace_.Events().end(),
                       [](const exec::Event& event) { return IsMotion(event.kind); });
  if (comparison.difference) {
    result_.difference = std::move(comparison.difference);
    result_.difference_set = set;
    result_.difference_start = start;
    return false;
  }
  return a != exec::Outcome::kEnded || CompareFinalValues(set, start);
}

bool Verifier::RunSet(const ParameterSet& set) {
  source_.Set(set);
  target_.Set(set);
  coverage_.quotients.clear();
  coverage_.blocks.assign(source_.Module().blocks.Size(), 0);
  if (!ComparePair(set, 0, "clean start", &coverage_)) return false;
  for (std::size_t i = 0; i < coverage_.blocks.size(); ++i)
    covered_[i] = static_cast<std::uint8_t>(covered_[i] | coverage_.blocks[i]);
  ++result_.sets_run;
  if (alarmed_) {
    ++result_.alarms_agreed;
  } else {
    ++result_.sets_counted;
  }
  const std::vector<exec::Quotient> quotients = coverage_.quotients;
  for (const std::uint16_t levels : skip_levels_) {
    coverage_.blocks.assign(source_.Module().blocks.Size(), 0);
    if (!ComparePair(set, levels, fmt::format("skip levels {:#x} on", levels), &coverage_)) return false;
    for (std::size_t i = 0; i < coverage_.blocks.size(); ++i)
      covered_[i] = static_cast<std::uint8_t>(covered_[i] | coverage_.blocks[i]);
  }
  target_.Poison(random_, options_);
  const bool same = ComparePair(set, 0, "poisoned start", nullptr);
  target_.Unpoison();
  coverage_.quotients = quotients;
  return same;
}

/// Changes one input so that a quotient of the last run becomes whole: numerator and denominator are taken as linear in
/// it, which two runs tell.
bool Verifier::AimAtMultiples(const ParameterSet& set) {
  const std::vector<exec::Quotient> first = coverage_.quotients;
  if (first.empty() || sets_.Inputs().empty()) return true;
  const exec::Quotient aim = first[random_.Below(first.size())];
  const std::size_t index = random_.Below(set.size());
  if (sets_.Inputs()[index].integer || set[index] == kMissing) return true;
  const double step = std::max(0.5, std::fabs(set[index]) / 16);
  const std::optional<ParameterSet> moved = sets_.With(set, index, set[index] + step);
  if (!moved) return true;
  const auto quotient_of = [&](const ParameterSet& values) -> std::optional<exec::Quotient> {
    source_.Set(values);
    coverage_.quotients.clear();
    diag::Sink quiet;
    source_.Run(0, options_.max_blocks, source_trace_, quiet, &coverage_);
    for (const exec::Quotient& quotient : coverage_.quotients) {
      if (quotient.expr == aim.expr) return quotient;
    }
    return std::nullopt;
  };
  const std::optional<exec::Quotient> there = quotient_of(*moved);
  if (!there) return true;
  const double numerator_slope = (there->numerator - aim.numerator) / step;
  const double denominator_slope = (there->denominator - aim.denominator) / step;
  const double whole = std::round(aim.numerator / aim.denominator) + static_cast<double>(random_.Below(3));
  const double slope = numerator_slope - whole * denominator_slope;
  if (slope == 0 || !std::isfinite(whole)) return true;
  const double value = set[index] + (whole * aim.denominator - aim.numerator) / slope;
  const std::optional<ParameterSet> exact = sets_.With(set, index, std::round(value * 1e6) / 1e6);
  if (!exact || !seen_.insert(*exact).second) return true;
  const std::optional<exec::Quotient> reached = quotient_of(*exact);
  const bool hit = reached && std::fabs(reached->numerator - std::round(reached->numerator / reached->denominator) *
                                                                 reached->denominator) < 1e-9;
  if (hit) ++result_.exact_multiples;
  return RunSet(*exact);
}

/// Ways that no set took so far may be those that refuse a value: values that no call gives are tried. A set with which
/// the source goes on for ever says nothing.
void Verifier::TryOddValues() {
  constexpr int kTries = 200;
  constexpr std::uint64_t kBlocks = 200'000;
  for (int i = 0; i < kTries && !Done() && !result_.open_branches.empty(); ++i) {
    const std::optional<ParameterSet> set = sets_.NextOdd();
    if (!set) return;
    if (!seen_.insert(*set).second) continue;
    source_.Set(*set);
    diag::Sink quiet;
    const exec::Outcome outcome = source_.Run(0, kBlocks, source_trace_, quiet, nullptr);
    if (outcome != exec::Outcome::kEnded && outcome != exec::Outcome::kAlarmed) continue;
    if (!RunSet(*set)) return;
    CountBranches();
  }
}

void Verifier::CountBranches() {
  result_.branches = result_.branches_taken = result_.branches_listed = 0;
  result_.open_branches.clear();
  const ir::Module& module = source_.Module();
  for (const ir::Program& program : module.programs.All()) {
    if (program.library) continue;  // a cycle that ncport brings along is no part of the source
    for (const ir::BlockId id : program.blocks) {
      const ir::Block& block = module.blocks[id];
      const std::uint8_t bits = covered_[id.value];
      if ((bits & 1U) == 0 || !IsBranch(module, block)) continue;  // not reached: the branch before it is the open one
      const bool listed = std::find(options_.listed_branches.begin(), options_.listed_branches.end(), id) !=
                          options_.listed_branches.end();
      for (const bool taken : {true, false}) {
        ++result_.branches;
        if ((bits & (taken ? 2U : 4U)) != 0) {
          ++result_.branches_taken;
        } else if (listed) {
          ++result_.branches_listed;
        } else {
          result_.open_branches.push_back({id, taken});
        }
      }
    }
  }
}

/// Alarms that no run came past: the blocks behind them were never compared.
void Verifier::CountStops() {
  result_.stops.clear();
  const ir::Module& module = source_.Module();
  const auto does = [&](const ir::Block& block, auto holds) {
    for (const ir::WordId word : block.words) {
      if (holds(module.words[word].op)) return true;
    }
    return false;
  };
  const auto ends = [](ir::WordOp op) { return op == ir::WordOp::kProgramEnd || op == ir::WordOp::kReturn; };
  for (const ir::Program& program : module.programs.All()) {
    if (program.library) continue;
    for (const ir::BlockId id : program.blocks) {
      const ir::Block& block = module.blocks[id];
      // Behind a jump that finds no target stands nothing that it would have come to.
      if (!alarm_blocks_.contains(id.value) || does(block, [](ir::WordOp op) { return op == ir::WordOp::kJump; }))
        continue;
      for (std::uint32_t next = id.value + 1; next < program.blocks.begin + program.blocks.count; ++next) {
        const ir::Block& behind = module.blocks[ir::BlockId{next}];
        if (behind.words.Empty()) continue;
        if (covered_[next] == 0 && !does(behind, ends)) result_.stops.push_back(id);
        break;
      }
    }
  }
}

Verification Verifier::Run() {
  CollectSkipLevels();
  covered_.assign(source_.Module().blocks.Size(), 0);
  const bool inputs = !sets_.Inputs().empty();
  const std::uint64_t tries = inputs ? std::uint64_t{options_.runs} * 4 + 64 : 1;
  // Where the inputs have few values in all, each set is run, and there are no others.
  std::optional<std::vector<ParameterSet>> all;
  if (inputs) all = sets_.All(options_.runs);
  if (all) {
    for (const ParameterSet& set : *all) {
      seen_.insert(set);
      if (!RunSet(set)) break;
    }
  }
  for (std::uint64_t i = 0; !all && i < tries && result_.sets_counted < (inputs ? options_.runs : 1); ++i) {
    const ParameterSet set = sets_.Next();
    if (!seen_.insert(set).second) continue;
    if (!RunSet(set)) break;
    if (inputs && i % 4 == 3 && result_.sets_counted < options_.runs && !AimAtMultiples(set)) break;
  }
  CountBranches();
  if (!Done() && inputs) TryOddValues();
  if (Done()) return std::move(result_);
  CountStops();
  if (inputs && result_.sets_counted < (all ? 1 : options_.least_runs)) {
    result_.not_compared = fmt::format("only {} of {} parameter sets moved before an alarm; {} are needed",
                                       result_.sets_counted, result_.sets_run, all ? 1 : options_.least_runs);
  } else if (inputs && !result_.open_branches.empty()) {
    // Without inputs all runs are one: a way that it does not take is never taken.
    result_.not_compared =
        fmt::format("{} of {} branches were never taken", result_.open_branches.size(), result_.branches);
  }
  if (result_.not_compared.empty() && !result_.stops.empty())
    result_.not_compared = "no run comes past an alarm of the source: what stands behind it was not compared";
  result_.compared = result_.not_compared.empty();
  return std::move(result_);
}

}  // namespace

Verification Verify(const Side& source, const Side& target, const std::vector<BoundInput>& inputs,
                    const VerifyOptions& options, diag::Sink& sink) {
  return Verifier(source, target, inputs, options, sink).Run();
}

}  // namespace ncport::prove
