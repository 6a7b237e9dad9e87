// Runs a fuzz target over seeds without libFuzzer: PROGRAM PATH... takes files and folders. Each seed is also cut,
// doubled and changed in a fixed way, so that the plain test sees more than well-formed text.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace {

namespace fs = std::filesystem;

constexpr int kChangesPerSeed = 12;

void Feed(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Changed(std::string bytes, std::mt19937& random) {
  if (bytes.empty()) return bytes;
  const auto at = [&] { return random() % bytes.size(); };
  switch (random() % 5) {
    case 0:
      bytes.resize(at());
      break;
    case 1:
      bytes.erase(at(), 1 + random() % 3);
      break;
    case 2:
      bytes[at()] = static_cast<char>(random());
      break;
    case 3:
      bytes.insert(at(), 1, "()[]=;:\"'<>,./*$%#NXGR0\n"[random() % 24]);
      break;
    default: {
      const std::size_t from = at(), length = 1 + random() % 24;
      bytes.insert(at(), bytes.substr(from, length));
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fs::path> seeds;
  for (int i = 1; i < argc; ++i) {
    if (fs::is_regular_file(argv[i])) seeds.emplace_back(argv[i]);
    if (!fs::is_directory(argv[i])) continue;
    for (const auto& entry : fs::recursive_directory_iterator(argv[i])) {
      if (entry.is_regular_file()) seeds.push_back(entry.path());
    }
  }
  std::sort(seeds.begin(), seeds.end());
  std::mt19937 random(7);
  int inputs = 0;
  for (const fs::path& seed : seeds) {
    std::ostringstream text;
    text << std::ifstream(seed, std::ios::binary).rdbuf();
    std::string bytes = text.str();
    Feed(bytes);
    for (int i = 0; i < kChangesPerSeed; ++i) Feed(bytes = Changed(i % 4 == 0 ? text.str() : bytes, random));
    inputs += 1 + kChangesPerSeed;
  }
  std::printf("%zu seeds, %d inputs\n", seeds.size(), inputs);
  return seeds.empty() ? 1 : 0;
}
