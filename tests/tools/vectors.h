// The behaviour vectors on disk: which there are, which are open, and how each is started (tests/vectors/README.md).
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace ncport::tests {

struct Vector {
  std::string name;  // "sinumerik/05-real-to-int.mpf"
  std::string language;
  std::filesystem::path program;
  std::string program_text;
  std::string expected_text;
  std::vector<std::string> options;  // of `ncport trace`: profile and start; empty: README.md has no row for it
  bool mill = false;
  bool open = false;  // listed in open.txt

  [[nodiscard]] bool ExpectsAlarm() const;
};

/// All vectors below `folder`, by name. Names of open.txt that no vector has go to `unknown_open`.
std::vector<Vector> ListVectors(const std::filesystem::path& folder, std::set<std::string>* unknown_open = nullptr);

}  // namespace ncport::tests
