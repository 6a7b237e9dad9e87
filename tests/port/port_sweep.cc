// ncport_port_sweep BINARY SOURCE [--list]: SINUMERIK programs on controls of the Fanuc family.
//   - every behaviour vector translates to each target, and source and output do the same; or it is refused by a
//   finding
//     that names the place. Never a difference, never output that cannot be compared, never a crash. What is refused
//     stands in refused.txt with the codes of its findings; that list may only shrink;
//   - the samples port with EQUAL, loops and calls kept, and in at most one and a half times the blocks.
// --list prints the lines of refused.txt as they are now.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/process.h"
#include "tests/tools/vectors.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

struct Sample {
  std::string folder;
  std::vector<std::string> files;  // that it is written in
  std::string from;
  std::vector<std::string> targets;
  std::vector<std::string> holds;  // in each output
};

class Sweep {
 public:
  Sweep(std::string binary, fs::path root) : binary_(std::move(binary)), root_(std::move(root)) {}
  int Run(bool list);

 private:
  struct Outcome {
    bool equal = false;
    std::string codes;  // of errors, ascending, joined by commas
    ProcessResult process;
  };
  Outcome Translate(const std::vector<std::string>& arguments) const;
  void Fail(const std::string& what, const std::string& detail = {}) {
    ++failures_;
    std::printf("FAIL %s\n%s", what.c_str(), detail.empty() ? "" : (Tail(detail, 12) + "\n").c_str());
  }
  void Vectors(bool list);
  void Port(const Sample& sample);

  std::string binary_;
  fs::path root_;
  int failures_ = 0, passed_ = 0;
};

Sweep::Outcome Sweep::Translate(const std::vector<std::string>& arguments) const {
  std::vector<std::string> command{binary_, "translate"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Outcome outcome;
  outcome.process = RunProcess(command);
  const std::string& text = outcome.process.errors;
  outcome.equal = outcome.process.exit_code == 0 && text.find("EQUAL") != std::string::npos;
  std::set<std::string> codes;
  static constexpr std::string_view kError = "error[";
  for (std::size_t at = text.find(kError); at != std::string::npos; at = text.find(kError, at + 1))
    codes.insert(text.substr(at + kError.size(), 6));
  for (const std::string& code : codes) outcome.codes += (outcome.codes.empty() ? "" : ",") + code;
  return outcome;
}

void Sweep::Vectors(bool list) {
  const fs::path list_path = root_ / "tests/port/refused.txt";
  std::map<std::string, std::string> refused;
  std::istringstream lines(ReadFileOrDie(list_path.string()));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t end = line.rfind(' ');
    refused[line.substr(0, end)] = line.substr(end + 1);
  }
  std::size_t equal = 0, all = 0;
  const std::string integrex = (root_ / "samples/turning_cycle/integrex_old.toml").string();
  const std::pair<std::string, std::string> targets[] = {{"fanuc-mill", "fanuc-mill"},
                                                         {"fanuc-lathe-a", "fanuc-lathe-a"},
                                                         {"fanuc-lathe-b", "fanuc-lathe-b"},
                                                         {"mazak-qtn", (root_ / "tests/port/qtn.toml").string()},
                                                         {"mazak-integrex-old", integrex}};
  for (const Vector& vector : ListVectors(root_ / "tests/vectors")) {
    if (vector.language != "sinumerik") continue;
    for (const auto& [name, profile] : targets) {
      const ScratchFolder scratch;
      std::vector<std::string> arguments{vector.program.string(), "--to", profile, "--verify", "--runs", "40", "-o",
                                         scratch.Path()};
      for (std::size_t i = 0; i + 1 < vector.options.size(); ++i) {
        if (vector.options[i] == "--from") arguments.insert(arguments.end(), {"--from", vector.options[i + 1]});
      }
      const Outcome outcome = Translate(arguments);
      const std::string key = name + " " + vector.program.stem().string();
      ++all;
      equal += outcome.equal ? 1U : 0U;
      if (list) {
        if (!outcome.equal) std::printf("%s %s\n", key.c_str(), outcome.codes.c_str());
        continue;
      }
      const auto known = refused.find(key);
      if (outcome.equal) {
        if (known != refused.end()) Fail(key + " ports now: take it out of refused.txt");
      } else if (!outcome.process.Clean() || outcome.process.exit_code != 1 || outcome.codes.empty()) {
        Fail(key + " ended with code " + std::to_string(outcome.process.exit_code), outcome.process.errors);
      } else if (outcome.codes.find("NC7") != std::string::npos) {
        Fail(key + " does not do the same", outcome.process.errors);
      } else if (known == refused.end()) {
        Fail(key + " is refused and was not before: " + outcome.codes, outcome.process.errors);
      } else if (known->second != outcome.codes) {
        Fail(key + " is refused by " + outcome.codes + ", refused.txt says " + known->second, outcome.process.errors);
      }
      if (known != refused.end()) refused.erase(known);
    }
  }
  if (list) return;
  for (const auto& [key, codes] : refused) Fail("refused.txt names no vector: " + key);
  passed_ += static_cast<int>(equal);
  std::printf("%zu of %zu translations of vectors do the same, the others are refused\n", equal, all);
}

/// Lines that hold words: no blank lines, no comments alone, no marks of the file.
std::size_t Blocks(const std::string& text, bool target) {
  std::size_t count = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    const char c = line[first];
    if (c == ';' || c == '(' || c == '%') continue;
    if (target && c == 'O') continue;
    // Guards of missing letters are not counted.
    if (target && (line.find("EQ #0]GOTO9") != std::string::npos || line.find("*MISSING") != std::string::npos))
      continue;
    ++count;
  }
  return count;
}

void Sweep::Port(const Sample& sample) {
  const fs::path folder = root_ / "samples" / sample.folder;
  std::size_t source_blocks = 0;
  for (const std::string& file : sample.files) source_blocks += Blocks(ReadFileOrDie((folder / file).string()), false);
  for (const std::string& target : sample.targets) {
    const std::string name = sample.folder + " to " + target;
    const ScratchFolder scratch;
    const bool own = target.find(".toml") != std::string::npos;
    const Outcome outcome =
        Translate({(folder / "main.mpf").string(), "-I", folder.string(), "--config", (folder / "ncport.toml").string(),
                   "--from", sample.from, "--to", own ? (folder / target).string() : target, "--verify", "--runs",
                   "100", "-o", scratch.Path()});
    if (!outcome.equal) {
      Fail(name, outcome.process.errors);
      continue;
    }
    std::string text;
    for (const auto& entry : fs::directory_iterator(scratch.Path())) text += ReadFileOrDie(entry.path().string());
    for (const std::string& part : sample.holds) {
      if (text.find(part) == std::string::npos) Fail(name + ": no " + part + " in the output", text);
    }
    const std::size_t blocks = Blocks(text, true);
    if (blocks * 2 > source_blocks * 3)
      Fail(name + ": " + std::to_string(blocks) + " blocks from " + std::to_string(source_blocks));
    std::printf("%s: equal, %zu blocks from %zu\n", name.c_str(), blocks, source_blocks);
    ++passed_;
  }
}

int Sweep::Run(bool list) {
  Vectors(list);
  if (list) return 0;
  const std::vector<std::string> mills{"fanuc-mill", "mazak-mill", "haas-mill"};
  Port({"bolt_circle",
        {"main.mpf", "round_pocket.spf", "bolt_circle.spf"},
        "sinumerik-840d-mill",
        mills,
        {"G65 P", "WHILE["}});
  Port({"r_parameters",
        {"main.mpf", "l1.spf", "l2.spf"},
        "sinumerik-840d-mill",
        mills,
        {"M98 P1", "M98 P2", "IF[#103 LE 360]"}});
  Port({"turning_cycle",
        {"main.mpf", "turning_cycle.spf"},
        "sinumerik-840d-lathe",
        {"qtn.toml", "integrex.toml", "integrex_old.toml"},
        {"G65 P4001", "IF["}});
  std::printf("%d passed, %d failed\n", passed_, failures_);
  return failures_ == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  return ncport::tests::Sweep(argv[1], argv[2]).Run(argc > 3 && std::strcmp(argv[3], "--list") == 0);
}
