// Random numbers that are the same on every machine and compiler: a failure is known by its seed alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace ncport::tests::random {

class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : state_(seed) {}

  /// 64 random bits (SplitMix64).
  std::uint64_t Bits() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  /// 0 .. count - 1; count > 0.
  std::uint32_t Below(std::uint32_t count) { return static_cast<std::uint32_t>(((Bits() >> 32U) * count) >> 32U); }
  /// first .. last, both included.
  std::int64_t Between(std::int64_t first, std::int64_t last) {
    return first + static_cast<std::int64_t>(Bits() % (static_cast<std::uint64_t>(last - first) + 1));
  }
  bool Percent(std::uint32_t chance) { return Below(100) < chance; }

  template <class T, std::size_t kCount>
  const T& Pick(const T (&items)[kCount]) {
    return items[Below(kCount)];
  }
  template <class Container>
  const auto& PickFrom(const Container& items) {
    return items[Below(static_cast<std::uint32_t>(items.size()))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace ncport::tests::random
