#include "tests/tools/vectors.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/tools/process.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

std::string FirstLine(const std::string& text, const std::string& start) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(start)) return line;
  }
  return {};
}

std::vector<std::string> OptionsFor(const Vector& vector) {
  if (vector.language == "fanuc") {
    static const std::map<std::string, std::string> profiles = {{"(MILL)", "fanuc-mill"},
                                                                {"(LATHE-A)", "fanuc-lathe-a"},
                                                                {"(LATHE-B)", "fanuc-lathe-b"},
                                                                {"(MAZAK)", "mazak-mill"},
                                                                {"(HAAS)", "haas-mill"}};
    const std::string& text = vector.program_text;
    const std::size_t open = text.find('(');
    const std::size_t close = text.find(')', open);
    const auto found = profiles.find(close == std::string::npos ? "" : text.substr(open, close - open + 1));
    if (found == profiles.end()) return {};
    return {"--from", found->second, "--start", "X0Y0Z0"};
  }
  if (vector.language == "sinumerik") {
    const bool lathe = vector.program_text.find("DIAMON") != std::string::npos;
    return {"--from", lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill"};
  }
  if (vector.language == "num") {
    const std::string config = FirstLine(vector.expected_text, "# config:");
    if (config.empty()) return {"--from", "num-mill"};
    if (config == "# config: turning, X diameter") return {"--from", "num-lathe"};
  }
  return {};
}

}  // namespace

bool Vector::ExpectsAlarm() const { return !FirstLine(expected_text, "ALARM ").empty(); }

std::vector<Vector> ListVectors(const fs::path& folder, std::set<std::string>* unknown_open) {
  std::set<std::string> open;
  std::istringstream lines(ReadFileOrDie((folder / "open.txt").string()));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != '#') open.insert(line);
  }
  std::vector<Vector> vectors;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".expected") continue;
    Vector vector;
    for (const auto& other : fs::directory_iterator(entry.path().parent_path())) {
      if (other.path().stem() == entry.path().stem() && other.path().extension() != ".expected")
        vector.program = other.path();
    }
    vector.language = entry.path().parent_path().filename().string();
    vector.name = vector.language + "/" + vector.program.filename().string();
    vector.program_text = ReadFileOrDie(vector.program.string());
    vector.expected_text = ReadFileOrDie(entry.path().string());
    vector.options = OptionsFor(vector);
    vector.mill = vector.options.size() > 1 && vector.options[1].find("mill") != std::string::npos;
    vector.open = open.erase(vector.name) != 0;
    vectors.push_back(std::move(vector));
  }
  std::sort(vectors.begin(), vectors.end(), [](const Vector& a, const Vector& b) { return a.name < b.name; });
  if (unknown_open != nullptr) *unknown_open = open;
  return vectors;
}

}  // namespace ncport::tests
