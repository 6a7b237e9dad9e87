// ncport_vectors BINARY FOLDER [PART OF A NAME]: runs every vector of FOLDER through `ncport trace --vars` and compares
// as README.md and contracts section 6 say. open.txt names the vectors that do not pass yet: each of them must end in
// an error that has a place in the program (or names the language), never in a trace that could be taken for right.
// Prints the share per language.
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/tools/process.h"
#include "tests/tools/trace_compare.h"
#include "tests/tools/vectors.h"

namespace ncport::tests {
namespace {

struct Outcome {
  bool passes = false;
  bool refused = false;  // ended in an error with a place: a good answer for an open vector
  std::string why;       // what was different, or what the program said
};

Outcome RunVector(const std::string& binary, const Vector& vector) {
  if (vector.options.empty()) return {.why = "README.md has no profile and start state for it"};
  std::vector<std::string> arguments = {binary, "trace", vector.program.string(), "--vars"};
  arguments.insert(arguments.end(), vector.options.begin(), vector.options.end());
  const ProcessResult run = RunProcess(arguments);
  if (!run.started) return {.why = "the program does not start: " + binary};
  if (!run.Clean() || run.exit_code == 70) {
    return {.why = "ended by " +
                   std::string(run.timed_out ? "the time limit" : "code " + std::to_string(run.exit_code)) + "\n" +
                   Tail(run.errors, 5)};
  }
  const ParsedTrace expected = ParseTrace(vector.expected_text);
  if (!expected.error.empty()) return {.why = "the .expected file: " + expected.error};
  const ParsedTrace actual = ParseTrace(run.output);
  if (!actual.error.empty()) return {.why = actual.error};
  const bool has_place = run.errors.find(vector.program.filename().string() + ":") != std::string::npos ||
                         run.errors.find(vector.language) != std::string::npos;
  Outcome outcome;
  outcome.refused = run.exit_code != 0 && run.errors.find("error[NC") != std::string::npos && has_place;
  const auto difference = CompareVector(actual.trace, expected.trace);
  if (difference) {
    outcome.why = *difference + (run.errors.empty() ? "" : "\n" + Tail(run.errors, 8));
  } else if (run.exit_code != (vector.ExpectsAlarm() ? 1 : 0)) {
    outcome.why = "the trace agrees but the exit code is " + std::to_string(run.exit_code) + "\n" + Tail(run.errors, 8);
  } else {
    outcome.passes = true;
  }
  return outcome;
}

int Main(const std::string& binary, const std::string& folder, const std::string& only) {
  std::set<std::string> unknown;
  const std::vector<Vector> vectors = ListVectors(folder, &unknown);
  std::vector<std::string> failures;
  struct Count {
    int total = 0, passed = 0, refused = 0;
  };
  std::map<std::string, Count> counts;
  for (const Vector& vector : vectors) {
    if (vector.name.find(only) == std::string::npos) continue;
    const Outcome outcome = RunVector(binary, vector);
    Count& count = counts[vector.language];
    ++count.total;
    count.passed += outcome.passes ? 1 : 0;
    count.refused += !outcome.passes && outcome.refused ? 1 : 0;
    if (outcome.passes && vector.open)
      failures.push_back(vector.name + "\npasses but is listed in open.txt: take its line out");
    if (!outcome.passes && !vector.open) failures.push_back(vector.name + "\n" + outcome.why);
    if (!outcome.passes && vector.open && !outcome.refused) {
      failures.push_back(vector.name + "\nis open, and is neither right nor refused with a place: a guess\n" +
                         outcome.why);
    }
  }
  for (const auto& [language, count] : counts) {
    std::printf("%-10s %2d of %2d vectors pass, %d are refused with a reason\n", language.c_str(), count.passed,
                count.total, count.refused);
  }
  for (const std::string& name : unknown) failures.push_back(name + "\nis listed in open.txt and does not exist");
  for (const std::string& failure : failures) std::printf("\nFAILED %s\n", failure.c_str());
  if (counts.empty()) std::printf("no vector was found\n");
  return failures.empty() && !counts.empty() ? 0 : 1;
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
