#include "backends/iso/flat_numbers.h"

#include <charconv>

namespace ncport::backends::iso {
namespace {

constexpr std::int64_t kPowers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};

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
  const auto scale = static_cast<std::uint64_t>(kPowers[decimals]);
  std::uint64_t fraction = magnitude % scale;
  p = std::to_chars(p, p + 20, magnitude / scale).ptr;
  *p++ = '.';
  for (std::uint64_t unit = scale / 10; fraction != 0; unit /= 10) {
    *p++ = static_cast<char>('0' + fraction / unit);
    fraction %= unit;
  }
  out.SetEnd(p);
}

}  // namespace ncport::backends::iso
