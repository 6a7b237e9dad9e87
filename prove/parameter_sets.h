// Values for the arguments and start cells of a program: from declared ranges, from the calls seen, at their
// boundaries, and at exact multiples, where a layer more or less is decided.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ir/nodes.h"

namespace ncport::prove {

/// Stands in a set for an input that is not given: an argument that the call leaves out.
inline constexpr double kMissing = -std::numeric_limits<double>::infinity();

/// An end of a range that depends on another input: its value and a number.
struct RelatedEnd {
  std::size_t input = 0;
  double added = 0;
};

/// One input that comparison varies.
struct Input {
  std::string name;                           // "TURNING_CYCLE.EXTD", "R10"
  std::optional<double> low, high;            // declared range, both included
  std::optional<RelatedEnd> low_of, high_of;  // instead of `low`, `high`
  std::vector<double> seen;                   // values that calls give
  bool integer = false;                       // INT, BOOL
  bool boolean = false;
  bool may_miss = false;  // sets without it are drawn too
};

/// One value for each input, in their order.
using ParameterSet = std::vector<double>;

/// splitmix64: the same sets for the same seed on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t Next();
  /// From [0, bound).
  std::uint64_t Below(std::uint64_t bound) { return bound == 0 ? 0 : Next() % bound; }
  /// From [low, high].
  double Between(double low, double high);

 private:
  std::uint64_t state_;
};

/// Draws sets one after the other. The first is that of the calls seen, then the boundaries one by one, then random
/// ones: some with the digits of a drawing (halves, tenths), some with thousandths.
class ParameterSource {
 public:
  ParameterSource(std::vector<Input> inputs, std::uint64_t seed);

  ParameterSet Next();
  /// All sets that there are, where every input takes few values (whole numbers between declared ends, BOOL): those of
  /// the calls seen first. None: more than `most`, or an input without ends of its own.
  [[nodiscard]] std::optional<std::vector<ParameterSet>> All(std::size_t most) const;
  /// A set in which one input without a declared range is 0, or has the other sign than the calls give it: what
  /// programs refuse. None: all inputs have ranges.
  std::optional<ParameterSet> NextOdd();
  /// `set` with the input `index` changed to `value`, as that input takes it; none: outside of its range.
  [[nodiscard]] std::optional<ParameterSet> With(const ParameterSet& set, std::size_t index, double value) const;
  [[nodiscard]] const std::vector<Input>& Inputs() const { return inputs_; }

 private:
  [[nodiscard]] ParameterSet DrawSet();
  [[nodiscard]] double Draw(const Input& input);
  /// The input with the ends that others give it in `set`.
  [[nodiscard]] Input Bounded(std::size_t index, const ParameterSet& set) const;
  /// Brings inputs whose ends are others into their ranges; false: a range is empty.
  bool Relate(ParameterSet& set);
  [[nodiscard]] static double Fit(const Input& input, double value);

  std::vector<Input> inputs_;
  Random random_;
  std::uint64_t drawn_ = 0;
};

}  // namespace ncport::prove
