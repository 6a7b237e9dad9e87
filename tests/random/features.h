// What random programs are made of, and how often: each target language can be given the subset that it has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ncport::tests::random {

/// The language whose meaning the random IR has: which values, comparisons and calls there are.
enum class Flavour : std::uint8_t { kSinumerik, kFanuc };

enum class Feature : std::uint8_t {
#define NCPORT_FEATURE(Name, text, kind, sinumerik, fanuc) k##Name,
#include "tests/random/features.def"
};
inline constexpr std::size_t kFeatures = static_cast<std::size_t>(Feature::kComputedTarget) + 1;

std::string_view NameOf(Feature feature);
/// The programs of this language can have it.
bool Exists(Feature feature, Flavour flavour);
/// True for features that are drawn against each other; else the weight is a percentage.
bool IsStatement(Feature feature);

struct Weights {
  std::array<std::uint16_t, kFeatures> values{};

  static Weights For(Flavour flavour);
  [[nodiscard]] std::uint16_t Of(Feature feature) const { return values[static_cast<std::size_t>(feature)]; }
  void Set(Feature feature, std::uint16_t weight) { values[static_cast<std::size_t>(feature)] = weight; }
  /// "frame=0,case=5". False and the wrong part in `wrong` if it cannot be read.
  bool Parse(std::string_view text, std::string& wrong);
};

}  // namespace ncport::tests::random
