// ncport_vectors BINARY FOLDER: runs every vector of FOLDER through `ncport trace --vars` and compares as README.md and
// contracts section 6 say. open.txt names the vectors that do not pass yet: each of them must end in an error that has a
// place in the program (or names the language), never in a trace that is taken for right. Prints the share per language.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/process.h"
#include "tests/tools/trace_compare.h"

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

/// Options of `ncport trace` for one vector, by the table of README.md; none: the table has no row for it.
std::vector<std::string> OptionsFor(const std::string& language, const std::string& program, const std::string& expected) {
  if (language == "fanuc") {
    static const std::map<std::string, std::string> profiles = {{"(MILL)", "fanuc-mill"},
                                                                {"(LATHE-A)", "fanuc-lathe-a"},
                                                                {"(LATHE-B)", "fanuc-lathe-b"},
                                                                {"(MAZAK)", "mazak-mill"},
                                                                {"(HAAS)", "haas-mill"}};
    const std::size_t open = program.find('(');
    const std::size_t close = program.find(')', open);
    const auto found = profiles.find(close == std::string::npos ? "" : program.substr(open, close - open + 1));
    if (found == profiles.end()) return {};
    return {"--from", found->second, "--start", "X0Y0Z0"};
  }
  if (language == "sinumerik") {
    const bool lathe = program.find("DIAMON") != std::string::npos;
    return {"--from", lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill"};
  }
  if (language == "num") {
    const std::string config = FirstLine(expected, "# config:");
    if (config.empty()) return {"--from", "num-mill"};
    if (config == "# config: turning, X diameter") return {"--from", "num-lathe"};
  }
  return {};
}

struct Outcome {
  bool passes = false;
  bool refused = false;  // ended in an error with a place: a good answer for an open vector
  std::string why;       // what was different, or what the program said
};

Outcome RunVector(const std::string& binary, const fs::path& program_path, const std::string& language) {
  const std::string program = ReadFileOrDie(program_path.string());
  const std::string expected_text = ReadFileOrDie(fs::path(program_path).replace_extension(".expected").string());
  const std::vector<std::string> options = OptionsFor(language, program, expected_text);
  if (options.empty()) return {.why = "README.md has no profile and start state for it"};
  std::vector<std::string> arguments = {binary, "trace", program_path.string(), "--vars"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProcessResult run = RunProcess(arguments);
  if (!run.started) return {.why = "the program does not start: " + binary};
  if (!run.Clean() || run.exit_code == 70) {
    return {.why = "ended by " + std::string(run.timed_out ? "the time limit" : "code " + std::to_string(run.exit_code)) + "\n" + Tail(run.errors, 5)};
  }
  const std::string place = program_path.filename().string() + ":";
  const bool has_error = run.errors.find("error[NC") != std::string::npos;
  const bool has_place = run.errors.find(place) != std::string::npos || run.errors.find(language) != std::string::npos;
  const ParsedTrace expected = ParseTrace(expected_text);
  if (!expected.error.empty()) return {.why = "the .expected file: " + expected.error};
  const ParsedTrace actual = ParseTrace(run.output);
  if (!actual.error.empty()) return {.why = actual.error};
  const bool alarms = expected_text.find("\nALARM ") != std::string::npos || expected_text.starts_with("ALARM ");
  Outcome outcome;
  outcome.refused = run.exit_code != 0 && has_error && has_place;
  const auto difference = CompareVector(actual.trace, expected.trace);
  if (difference) {
    outcome.why = *difference + (run.errors.empty() ? "" : "\n" + Tail(run.errors, 8));
  } else if (run.exit_code != (alarms ? 1 : 0)) {
    outcome.why = "the trace agrees but the exit code is " + std::to_string(run.exit_code) + "\n" + Tail(run.errors, 8);
  } else {
    outcome.passes = true;
  }
  return outcome;
}

std::set<std::string> ReadOpenList(const fs::path& path) {
  std::set<std::string> open;
  std::istringstream lines(ReadFileOrDie(path.string()));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != '#') open.insert(line);
  }
  return open;
}

int Main(const std::string& binary, const fs::path& folder, const std::string& only) {
  std::set<std::string> open = ReadOpenList(folder / "open.txt");
  std::vector<std::string> failures;
  int total = 0;
  std::vector<fs::path> languages;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) languages.push_back(entry.path());
  }
  std::sort(languages.begin(), languages.end());
  for (const fs::path& language : languages) {
    std::vector<fs::path> programs;
    for (const auto& entry : fs::directory_iterator(language)) {
      if (entry.path().extension() == ".expected") continue;
      programs.push_back(entry.path());
    }
    std::sort(programs.begin(), programs.end());
    int passed = 0, refused = 0;
    for (const fs::path& program : programs) {
      const std::string name = language.filename().string() + "/" + program.filename().string();
      const bool listed = open.erase(name) != 0;
      if (!only.empty() && name.find(only) == std::string::npos) continue;
      ++total;
      const Outcome outcome = RunVector(binary, program, language.filename().string());
      passed += outcome.passes ? 1 : 0;
      refused += !outcome.passes && outcome.refused ? 1 : 0;
      if (outcome.passes && listed) failures.push_back(name + "\npasses but is listed in open.txt: take its line out");
      if (!outcome.passes && !listed) failures.push_back(name + "\n" + outcome.why);
      if (!outcome.passes && listed && !outcome.refused) {
        failures.push_back(name + "\nis open, and is neither right nor refused with a place: a guess\n" + outcome.why);
      }
    }
    std::printf("%-10s %2d of %2d vectors pass, %d are refused with a reason\n", language.filename().c_str(), passed,
                static_cast<int>(programs.size()), refused);
  }
  for (const std::string& name : open) failures.push_back(name + "\nis listed in open.txt and does not exist");
  for (const std::string& failure : failures) std::printf("\nFAILED %s\n", failure.c_str());
  if (total == 0) {
    std::printf("no vector was found\n");
    return 1;
  }
  return failures.empty() ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: ncport_vectors BINARY FOLDER [PART OF A NAME]\n");
    return 2;
  }
  return ncport::tests::Main(argv[1], argv[2], argc == 4 ? argv[3] : "");
}
