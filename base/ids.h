// Typed indices into stores. An id is 32 bits, survives growth of its store, and prints well in dumps.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace ncport {

/// Index of one record in the store of its kind. Default: no record.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::uint32_t value = kNone;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}

  [[nodiscard]] constexpr bool Valid() const { return value != kNone; }
  constexpr auto operator<=>(const Id&) const = default;
};

/// Consecutive records of one store: [begin, begin + count).
template <class IdType>
struct IdRange {
  std::uint32_t begin = 0;
  std::uint32_t count = 0;

  struct Iterator {
    std::uint32_t value;
    constexpr IdType operator*() const { return IdType{value}; }
    constexpr Iterator& operator++() {
      ++value;
      return *this;
    }
    constexpr bool operator==(const Iterator&) const = default;
  };

  [[nodiscard]] constexpr bool Empty() const { return count == 0; }
  [[nodiscard]] constexpr IdType operator[](std::uint32_t index) const { return IdType{begin + index}; }
  constexpr bool operator==(const IdRange&) const = default;
};

template <class IdType>
constexpr typename IdRange<IdType>::Iterator begin(const IdRange<IdType>& range) {
  return {range.begin};
}
template <class IdType>
constexpr typename IdRange<IdType>::Iterator end(const IdRange<IdType>& range) {
  return {range.begin + range.count};
}

}  // namespace ncport
