#include "prove/parameter_sets.h"

#include <algorithm>
#include <cmath>

namespace ncport::prove {

std::uint64_t Random::Next() {
  state_ += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

double Random::Between(double low, double high) {
  const double unit = static_cast<double>(Next() >> 11U) / 9007199254740992.0;  // 2^53
  return low + (high - low) * unit;
}

ParameterSource::ParameterSource(std::vector<Input> inputs, std::uint64_t seed)
    : inputs_(std::move(inputs)), random_(seed) {}

double ParameterSource::Fit(const Input& input, double value) {
  if (value == kMissing) return value;
  if (input.boolean) return value != 0 ? 1 : 0;
  if (input.integer) value = std::round(value);
  if (input.low) value = std::max(value, input.integer ? std::ceil(*input.low) : *input.low);
  if (input.high) value = std::min(value, input.integer ? std::floor(*input.high) : *input.high);
  return value;
}

double ParameterSource::Draw(const Input& input) {
  if (input.may_miss && random_.Below(4) == 0) return kMissing;
  if (input.boolean) return static_cast<double>(random_.Below(2));
  const std::uint64_t kind = random_.Below(8);
  if (kind == 0 && !input.seen.empty()) return input.seen[random_.Below(input.seen.size())];
  double value = 0;
  if (input.low && input.high) {
    value = random_.Between(*input.low, *input.high);
  } else if (!input.seen.empty()) {
    // Without a declared range: near what a call gave, the sign kept.
    value = input.seen[random_.Below(input.seen.size())] * random_.Between(0.25, 2.0);
  } else {
    value = random_.Between(0.1, 20);
  }
  if (input.integer) return Fit(input, value);
  // The digits of a drawing divide evenly more often than random ones.
  static constexpr double kGrid[] = {5, 1, 0.5, 0.25, 0.1, 0.01, 0.001, 0.001};
  const double grid = kGrid[random_.Below(std::size(kGrid))];
  return Fit(input, std::round(value / grid) * grid);
}

Input ParameterSource::Bounded(std::size_t index, const ParameterSet& set) const {
  Input input = inputs_[index];
  const auto end = [&](const RelatedEnd& related) -> std::optional<double> {
    if (set[related.input] == kMissing) return std::nullopt;
    return set[related.input] + related.added;
  };
  if (input.low_of) input.low = end(*input.low_of);
  if (input.high_of) input.high = end(*input.high_of);
  return input;
}

bool ParameterSource::Relate(ParameterSet& set) {
  // Ends may lead through several inputs; a circle of them is left as an empty range.
  for (std::size_t round = 0; round <= inputs_.size(); ++round) {
    bool changed = false;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (!inputs_[i].low_of && !inputs_[i].high_of) continue;
      const Input input = Bounded(i, set);
      if (input.low && input.high && *input.low > *input.high) return false;
      if (Fit(input, set[i]) == set[i]) continue;
      // Drawn anew, so that the ends do not gather all that lay outside.
      set[i] = input.low && input.high ? Draw(input) : Fit(input, set[i]);
      changed = true;
    }
    if (!changed) return true;
  }
  return false;
}

ParameterSet ParameterSource::DrawSet() {
  ParameterSet set;
  set.reserve(inputs_.size());
  const std::uint64_t turn = drawn_++;
  for (const Input& input : inputs_)
    set.push_back(turn == 0 && !input.seen.empty() ? Fit(input, input.seen.front()) : Draw(input));
  // Boundaries: each input at its lowest and highest value once, the others at random.
  if (turn > 0 && turn <= inputs_.size() * 2) {
    const std::size_t index = (turn - 1) / 2;
    const Input input = Bounded(index, set);
    const std::optional<double> bound = turn % 2 == 1 ? input.low : input.high;
    if (bound) set[index] = Fit(input, *bound);
  }
  return set;
}

ParameterSet ParameterSource::Next() {
  constexpr int kTries = 100;  // an empty range of one draw is not empty in most others
  ParameterSet set = DrawSet();
  for (int i = 0; i < kTries && !Relate(set); ++i) set = DrawSet();
  return set;
}

std::optional<std::vector<ParameterSet>> ParameterSource::All(std::size_t most) const {
  std::vector<ParameterSet> sets(1);
  for (const Input& input : inputs_) {
    if (input.low_of || input.high_of) return std::nullopt;
    const bool ends = input.low && input.high;
    if (!input.boolean && !(ends && (input.integer || *input.low == *input.high))) return std::nullopt;
    const double first = input.boolean ? 0 : input.integer ? std::ceil(*input.low) : *input.low;
    const double last = input.boolean ? 1 : input.integer ? std::floor(*input.high) : *input.high;
    if (!(last - first < static_cast<double>(most))) return std::nullopt;
    std::vector<double> values;
    for (double value = first; value <= last; ++value) values.push_back(value);
    if (input.may_miss) values.push_back(kMissing);
    const auto seen = input.seen.empty() ? values.end() : std::find(values.begin(), values.end(), input.seen.front());
    if (seen != values.end()) std::rotate(values.begin(), seen, seen + 1);
    if (values.size() * sets.size() > most) return std::nullopt;
    std::vector<ParameterSet> longer;
    for (const ParameterSet& set : sets) {
      for (const double value : values) {
        longer.push_back(set);
        longer.back().push_back(value);
      }
    }
    sets = std::move(longer);
  }
  return sets;
}

std::optional<ParameterSet> ParameterSource::NextOdd() {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Input& input = inputs_[i];
    if (!input.boolean && !input.low && !input.high && !input.low_of && !input.high_of) open.push_back(i);
  }
  if (open.empty()) return std::nullopt;
  ParameterSet set = Next();
  double& value = set[open[random_.Below(open.size())]];
  value = value == kMissing || random_.Below(2) == 0 ? 0 : -value;
  return set;
}

std::optional<ParameterSet> ParameterSource::With(const ParameterSet& set, std::size_t index, double value) const {
  if (set[index] == kMissing) return std::nullopt;
  ParameterSet changed = set;
  changed[index] = value;
  if (!std::isfinite(value) || Fit(Bounded(index, changed), value) != value) return std::nullopt;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const bool related = (inputs_[i].low_of && inputs_[i].low_of->input == index) ||
                         (inputs_[i].high_of && inputs_[i].high_of->input == index);
    if (related && Fit(Bounded(i, changed), changed[i]) != changed[i]) return std::nullopt;
  }
  return changed;
}

}  // namespace ncport::prove
