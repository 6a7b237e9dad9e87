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
  if (input.boolean) return value != 0 ? 1 : 0;
  if (input.integer) value = std::round(value);
  if (input.low) value = std::max(value, input.integer ? std::ceil(*input.low) : *input.low);
  if (input.high) value = std::min(value, input.integer ? std::floor(*input.high) : *input.high);
  return value;
}

double ParameterSource::Draw(const Input& input) {
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

ParameterSet ParameterSource::Next() {
  ParameterSet set;
  set.reserve(inputs_.size());
  const std::uint64_t turn = drawn_++;
  for (const Input& input : inputs_)
    set.push_back(turn == 0 && !input.seen.empty() ? Fit(input, input.seen.front()) : Draw(input));
  // Boundaries: each input at its lowest and highest value once, the others at random.
  if (turn > 0 && turn <= inputs_.size() * 2) {
    const std::size_t index = (turn - 1) / 2;
    const Input& input = inputs_[index];
    const std::optional<double> bound = turn % 2 == 1 ? input.low : input.high;
    if (bound) set[index] = Fit(input, *bound);
  }
  return set;
}

std::optional<ParameterSet> ParameterSource::With(const ParameterSet& set, std::size_t index, double value) const {
  const Input& input = inputs_[index];
  if (!std::isfinite(value) || Fit(input, value) != value) return std::nullopt;
  ParameterSet changed = set;
  changed[index] = value;
  return changed;
}

}  // namespace ncport::prove
