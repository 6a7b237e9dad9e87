// ncport_judge BINARY RS274 SOURCE: asks rs274, the stand-alone interpreter of LinuxCNC, whether it sees the same
// motions. Each mill sample and each passing mill vector is flattened to iso-mill (five decimals, cutter compensation
// taken out, since rs274 prints the compensated path) and run by rs274; its canonical calls must agree with the trace
// of the source program. All mill samples and at least 80 % of the passing mill vectors must be given to it, and all
// that is given must agree; what is not given is listed with the reason.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/judge/canon.h"
#include "tests/tools/process.h"
#include "tests/tools/trace_compare.h"
#include "tests/tools/vectors.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastShare = 0.8;

struct Case {
  std::string name;
  std::vector<std::string> arguments;  // files and options, the same for trace and flatten
  bool must_be_given = false;          // a sample
};

struct Verdict {
  bool given = false;
  std::string text;  // given: what is different, empty = nothing; else: why it was not given
};

constexpr int kDiedBySignal = 128;  // exit codes from here on, as shells count them

class Judge {
 public:
  Judge(std::string binary, std::string rs274) : binary_(std::move(binary)), rs274_(std::move(rs274)) {
    // Tools without length and radius: what rs274 prints is then what is programmed.
    std::string tools;
    for (int i = 1; i <= 9999; i += i < 100 ? 1 : 9899)
      tools += "T" + std::to_string(i) + " P" + std::to_string(i) + " Z0 D0\n";
    tool_table_ = folder_.Write("tools.tbl", tools);
    profile_ = folder_.Write("judge.toml", "inherits = \"iso-mill\"\ndecimals = 5\n");
  }

  [[nodiscard]] bool IsThere() const { return RunProcess({rs274_, "-g", "/dev/null"}).started; }

  Verdict Ask(const Case& one) {
    const ProcessResult trace_run = Run("trace", one.arguments, {});
    const ParsedTrace trace = ParseTrace(trace_run.output);
    if (!trace.error.empty()) return {true, "trace: " + trace.error};
    if (std::string reason = ReasonNotToAsk(trace.trace); !reason.empty()) return {false, reason};
    if (trace_run.exit_code != 0)
      return {true, "trace ends with code " + std::to_string(trace_run.exit_code) + "\n" + Tail(trace_run.errors, 5)};
    const std::string flat = folder_.File("flat.ngc");
    std::error_code ignored;
    fs::remove(flat, ignored);
    const ProcessResult flat_run = Run("flatten", one.arguments, {"--to", profile_, "-o", flat});
    if (flat_run.exit_code != 0) {
      const std::size_t at = flat_run.errors.find("error[");
      const std::string first = flat_run.errors.substr(at == std::string::npos ? 0 : at);
      return {false, "flatten refuses it: " + first.substr(0, first.find('\n'))};
    }
    const std::string judged = folder_.Write("judged.ngc", WithoutCompensation(ReadFileOrDie(flat)));
    // Two rs274 at a time on one machine now and then kill each other by a signal (seen: SIGBUS): that is no verdict.
    ProcessResult run;
    for (int tries = 0; tries < 3; ++tries) {
      run = RunProcess({rs274_, "-t", tool_table_, "-g", judged}, {}, 60, folder_.Path());
      if (run.exit_code < kDiedBySignal) break;
    }
    if (!run.Clean() || run.exit_code != 0)
      return {true, "rs274 does not take the flat program (code " + std::to_string(run.exit_code) + "):\n" +
                        Tail(run.errors, 4)};
    const ParsedTrace canon = ParseCanon(run.output);
    if (!canon.error.empty()) return {true, canon.error};
    return {true, CompareWithCanon(trace.trace, canon.trace).value_or("")};
  }

 private:
  ProcessResult Run(const char* command, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& more) const {
    std::vector<std::string> all = {binary_, command};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), more.begin(), more.end());
    return RunProcess(all);
  }

  /// The words G40 G41 G42 and D taken out of each block.
  static std::string WithoutCompensation(const std::string& text) {
    static const std::regex words(R"((^|\s)(G4[012]|D\d+)(?=\s|$))");
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);) result += std::regex_replace(line, words, "") + "\n";
    return result;
  }

  std::string binary_, rs274_;
  ScratchFolder folder_;
  std::string tool_table_, profile_;
};

/// Samples that say in their README how they are flattened to iso-mill.
std::vector<Case> MillSamples(const fs::path& source) {
  std::vector<Case> cases;
  for (const auto& entry : fs::directory_iterator(source / "samples")) {
    if (!fs::exists(entry.path() / "README.md")) continue;
    std::istringstream lines(ReadFileOrDie((entry.path() / "README.md").string()));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("ncport flatten ") || line.find("iso-mill") == std::string::npos) continue;
      std::istringstream words(line);
      Case one{"samples/" + entry.path().filename().string(), {}, true};
      std::string word;
      words >> word >> word;
      while (words >> word) {
        if (word == "--to" || word == "-o") {
          words >> word;
          continue;
        }
        one.arguments.push_back(word.starts_with("samples/") ? (source / word).string() : word);
      }
      cases.push_back(one);
    }
  }
  return cases;
}

int Main(const std::string& binary, const std::string& rs274, const fs::path& source) {
  Judge judge(binary, rs274);
  if (!judge.IsThere()) {
    std::printf(
        "rs274 was not found (%s). It is the outside judge of flat programs: an interpreter that ncport had no part "
        "in.\n"
        "It comes with the Debian package linuxcnc-uspace; tools/test installs it. Without it nothing was compared.\n",
        rs274.c_str());
    return 1;
  }
  std::vector<Case> cases = MillSamples(source);
  const std::size_t samples = cases.size();
  for (const Vector& vector : ListVectors(source / "tests/vectors")) {
    if (!vector.mill || vector.open) continue;
    Case one{vector.name, {vector.program.string()}, false};
    one.arguments.insert(one.arguments.end(), vector.options.begin(), vector.options.end());
    cases.push_back(one);
  }
  int given_samples = 0, given_vectors = 0, failed = 0;
  for (const Case& one : cases) {
    const Verdict verdict = judge.Ask(one);
    if (!verdict.given) {
      std::printf("not given: %s: %s\n", one.name.c_str(), verdict.text.c_str());
      failed += one.must_be_given ? 1 : 0;
      continue;
    }
    ++(one.must_be_given ? given_samples : given_vectors);
    if (verdict.text.empty()) continue;
    ++failed;
    std::printf("FAILED %s\n%s\n", one.name.c_str(), verdict.text.c_str());
  }
  const int vectors = static_cast<int>(cases.size() - samples);
  std::printf(
      "rs274 was given %d of %d mill samples and %d of %d passing mill vectors (%.0f %%, at least %.0f %% are needed); "
      "%d failed\n",
      given_samples, static_cast<int>(samples), given_vectors, vectors,
      vectors == 0 ? 100.0 : 100.0 * given_vectors / vectors, 100 * kLeastShare, failed);
  if (samples == 0) std::printf("no sample names iso-mill in its README.md\n");
  return failed == 0 && samples > 0 && given_vectors >= kLeastShare * vectors ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: ncport_judge BINARY RS274 SOURCE\n");
    return 2;
  }
  return ncport::tests::Main(argv[1], argv[2], argv[3]);
}
