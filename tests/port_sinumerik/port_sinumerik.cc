// ncport_port_sinumerik BINARY SOURCE [--list]: every behaviour vector of the Fanuc family, and the sample, to
// SINUMERIK. Source and output do the same, or a finding names the place of what has no form; refused.txt lists those
// with the codes of their findings, and may only shrink. Never a difference, never output that cannot be read back.
// A vector has no inputs, so a branch that its one run does not take is no failure here.
// --list prints the lines of refused.txt as they are now.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/process.h"
#include "tests/tools/vectors.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

class Sweep {
 public:
  Sweep(std::string binary, fs::path root) : binary_(std::move(binary)), root_(std::move(root)) {}
  int Run(bool list);

 private:
  struct Outcome {
    bool same = false;
    std::string codes;  // of errors, ascending, joined by commas
    ProcessResult process;
  };
  [[nodiscard]] Outcome Translate(const fs::path& program, const std::string& from) const;
  void Fail(const std::string& what, const std::string& detail = {}) {
    ++failures_;
    std::printf("FAIL %s\n%s", what.c_str(), detail.empty() ? "" : (Tail(detail, 12) + "\n").c_str());
  }

  std::string binary_;
  fs::path root_;
  int failures_ = 0;
};

Sweep::Outcome Sweep::Translate(const fs::path& program, const std::string& from) const {
  const ScratchFolder scratch;
  const bool lathe = from.find("lathe") != std::string::npos;
  Outcome outcome;
  outcome.process =
      RunProcess({binary_, "translate", program.string(), "--from", from, "--to",
                  lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill", "--verify", "-o", scratch.Path()});
  const std::string& text = outcome.process.errors;
  std::set<std::string> codes;
  static constexpr std::string_view kError = "error[";
  for (std::size_t at = text.find(kError); at != std::string::npos; at = text.find(kError, at + 1))
    codes.insert(text.substr(at + kError.size(), 6));
  for (const std::string& code : codes) outcome.codes += (outcome.codes.empty() ? "" : ",") + code;
  const bool equal = outcome.process.exit_code == 0 && text.find("EQUAL") != std::string::npos;
  const bool open = outcome.codes == "NC7002" && text.find("branches were never taken") != std::string::npos;
  // A program that every set ends by an alarm before it moves does the same where the alarms agree: a difference would
  // be NC7001.
  const bool alarms = outcome.codes == "NC7002" && text.find("moved before an alarm") != std::string::npos;
  outcome.same = equal || open || alarms;
  return outcome;
}

int Sweep::Run(bool list) {
  const fs::path list_path = root_ / "tests/port_sinumerik/refused.txt";
  std::map<std::string, std::string> refused;
  std::istringstream lines(ReadFileOrDie(list_path.string()));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t end = line.rfind(' ');
    refused[line.substr(0, end)] = line.substr(end + 1);
  }
  std::size_t same = 0, all = 0;
  for (const Vector& vector : ListVectors(root_ / "tests/vectors")) {
    if (vector.language != "fanuc") continue;
    std::string from = "fanuc-mill";
    for (std::size_t i = 0; i + 1 < vector.options.size(); ++i) {
      if (vector.options[i] == "--from") from = vector.options[i + 1];
    }
    const Outcome outcome = Translate(vector.program, from);
    const std::string key = vector.program.stem().string();
    ++all;
    same += outcome.same ? 1U : 0U;
    if (list) {
      if (!outcome.same) std::printf("%s %s\n", key.c_str(), outcome.codes.c_str());
      continue;
    }
    const auto known = refused.find(key);
    if (outcome.same) {
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
  if (list) return 0;
  for (const auto& [key, codes] : refused) Fail("refused.txt names no vector: " + key);
  const Outcome sample = Translate(root_ / "samples/bolt_circle_macro/bolt_circle.nc", "fanuc-mill");
  if (sample.process.exit_code != 0 || !sample.same) Fail("samples/bolt_circle_macro", sample.process.errors);
  std::printf("%zu of %zu vectors do the same, the others are refused; %d failed\n", same, all, failures_);
  return failures_ == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  return ncport::tests::Sweep(argv[1], argv[2]).Run(argc > 3 && std::strcmp(argv[3], "--list") == 0);
}
