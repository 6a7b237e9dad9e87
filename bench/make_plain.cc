// Writes plain blocks, `N10 G1 X12.345 Y-6.789 Z-0.500 F1200.000`, as a CAM system would: the input of bench/run.
// The same arguments give the same text on every machine, so that figures can be compared.
//
//   make_plain [MEGABYTES [SEED]] > plain.mpf      default: 50 MB, seed 1
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace {

// Thousandths of a millimetre (or of mm/min) with exactly three decimals.
void AppendThousandths(std::string& out, std::int64_t value) {
  if (value < 0) {
    out += '-';
    value = -value;
  }
  out += std::to_string(value / 1000);
  const std::string decimals = std::to_string(1000 + value % 1000);
  out += '.';
  out.append(decimals, 1);
}

// One coordinate that wanders in small steps between its limits, in thousandths of a millimetre.
struct Walk {
  std::int64_t position;
  std::int64_t lowest;
  std::int64_t highest;

  std::int64_t Next(std::mt19937_64& random) {
    const auto step = static_cast<std::int64_t>(random() % 2001) - 1000;
    position += step;
    if (position < lowest || position > highest) position -= 2 * step;
    return position;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t megabytes = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 50;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  if (megabytes == 0 || argc > 3) {
    std::fprintf(stderr, "usage: make_plain [MEGABYTES [SEED]] > plain.mpf\n");
    return 2;
  }

  std::mt19937_64 random{seed};
  Walk x{0, -200000, 200000};
  Walk y{0, -200000, 200000};
  Walk z{0, -50000, 50000};
  constexpr std::size_t kBuffer = std::size_t{1} << 16;
  std::string text;
  text.reserve(kBuffer + 128);
  std::uint64_t written = 0;
  for (std::uint64_t number = 10; written + text.size() < megabytes * 1000000; number += 10) {
    text += 'N';
    text += std::to_string(number % 100000000);
    text += " G1 X";
    AppendThousandths(text, x.Next(random));
    text += " Y";
    AppendThousandths(text, y.Next(random));
    text += " Z";
    AppendThousandths(text, z.Next(random));
    text += " F";
    AppendThousandths(text, 100000 + static_cast<std::int64_t>(random() % 1900001));
    text += '\n';
    if (text.size() > kBuffer) {
      written += text.size();
      if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) return 1;
      text.clear();
    }
  }
  text += "M30\n";
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? 0 : 1;
}
