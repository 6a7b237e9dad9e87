// ncport_port_sweep BINARY SOURCE [--list]: SINUMERIK programs on controls of the Fanuc family.
//   - every behaviour vector translates to each target, and source and output do the same; or it is refused by a
//     finding that names the place: refused_fanuc.txt;
//   - the samples port with EQUAL, loops and calls kept, and in at most one and a half times the blocks.
// --list prints the lines of refused_fanuc.txt as they are now.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/port/port_checks.h"
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
  Sweep(std::string binary, fs::path root, bool list)
      : binary_(std::move(binary)),
        root_(std::move(root)),
        list_(list),
        checks_(root_ / "tests/port/refused_fanuc.txt", list) {}
  int Run();

 private:
  void Vectors();
  void Port(const Sample& sample);

  std::string binary_;
  fs::path root_;
  bool list_;
  PortChecks checks_;
  int samples_ = 0;  // that port
};

void Sweep::Vectors() {
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
      const Translated outcome = Translate(binary_, arguments);
      checks_.Judge(name + " " + vector.program.stem().string(), outcome, outcome.equal);
    }
  }
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
    const Translated outcome = Translate(
        binary_, {(folder / "main.mpf").string(), "-I", folder.string(), "--config", (folder / "ncport.toml").string(),
                  "--from", sample.from, "--to", own ? (folder / target).string() : target, "--verify", "--runs", "100",
                  "-o", scratch.Path()});
    if (!outcome.equal) {
      checks_.Fail(name, outcome.process.errors);
      continue;
    }
    std::string text;
    for (const auto& entry : fs::directory_iterator(scratch.Path())) text += ReadFileOrDie(entry.path().string());
    for (const std::string& part : sample.holds) {
      if (text.find(part) == std::string::npos) checks_.Fail(name + ": no " + part + " in the output", text);
    }
    const std::size_t blocks = Blocks(text, true);
    if (blocks * 2 > source_blocks * 3)
      checks_.Fail(name + ": " + std::to_string(blocks) + " blocks from " + std::to_string(source_blocks));
    std::printf("%s: equal, %zu blocks from %zu\n", name.c_str(), blocks, source_blocks);
    ++samples_;
  }
}

int Sweep::Run() {
  Vectors();
  if (list_) return 0;
  checks_.CloseList();
  std::printf("%zu of %zu translations of vectors do the same, the others are refused\n", checks_.Same(),
              checks_.All());
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
  const int passed = static_cast<int>(checks_.Same()) + samples_;
  std::printf("%d passed, %d failed\n", passed, checks_.Failures());
  return checks_.Failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  return ncport::tests::Sweep(argv[1], argv[2], argc > 3 && std::strcmp(argv[3], "--list") == 0).Run();
}
