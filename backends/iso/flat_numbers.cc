#include "backends/iso/flat_numbers.h"

#include <charconv>

namespace ncport::backends::iso {
namespace {

constexpr std::int64_t kPowers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};

struct Parts {
  std::uint64_t whole;
  std::uint32_t fraction;
};

/// Increments as a number before and one behind the point. A division by a constant is a multiplication, so each number
/// of decimals has its own.
template <std::uint64_t kScale>
Parts SplitBy(std::uint64_t magnitude) {
  return {magnitude / kScale, static_cast<std::uint32_t>(magnitude % kScale)};
}
Parts Split(std::uint64_t magnitude, int decimals) {
  switch (decimals) {
    case 0:
      return {magnitude, 0};
    case 1:
      return SplitBy<10>(magnitude);
    case 2:
      return SplitBy<100>(magnitude);
    case 3:
      return SplitBy<1000>(magnitude);
    case 4:
      return SplitBy<10000>(magnitude);
    case 5:
      return SplitBy<100000>(magnitude);
    case 6:
      return SplitBy<1000000>(magnitude);
    default: {
      const auto scale = static_cast<std::uint64_t>(kPowers[decimals]);
      return {magnitude / scale, static_cast<std::uint32_t>(magnitude % scale)};
    }
  }
}

}  // namespace

double ScaleOf(int decimals) { return static_cast<double>(kPowers[decimals]); }

void AppendWord(TextBuffer& out, char letter, std::int64_t increments, int decimals) {
  constexpr std::size_t kLongest = 32;
  char* p = out.Reserve(kLongest);
  *p++ = letter;
  auto magnitude = static_cast<std::uint64_t>(increments);
  if (increments < 0) {
    *p++ = '-';
    magnitude = 0 - magnitude;
  }
  const Parts parts = Split(magnitude, decimals);
  p = std::to_chars(p, p + 20, parts.whole).ptr;
  *p++ = '.';
  if (parts.fraction != 0) {
    std::uint32_t rest = parts.fraction;
    for (int i = decimals; i-- > 0; rest /= 10) p[i] = static_cast<char>('0' + rest % 10);
    p += decimals;
    while (p[-1] == '0') --p;
  }
  out.SetEnd(p);
}

}  // namespace ncport::backends::iso
