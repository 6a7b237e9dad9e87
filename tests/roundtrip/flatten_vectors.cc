// ncport_flatten_vectors BINARY SOURCE: each passing vector of a language with a flat form, mills and lathes, is
// flattened, and the flat program read back as iso must do what the vector does. A vector that flatten refuses, that
// ends in an alarm, or that turns more than once around (flat blocks have one turn each) is not given; at least 80 %
// must be. Fanuc controls start in G54: a program that selects no work offset must get that word before its first
// motion (contracts section 6).
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/tools/process.h"
#include "tests/tools/trace_compare.h"
#include "tests/tools/vectors.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastShare = 0.8;

/// Takes the first work offset away when it stands before the first motion; its line, or empty.
std::string TakeFirstOffset(Trace& trace) {
  for (auto event = trace.events.begin(); event != trace.events.end() && !event->IsMove(); ++event) {
    if (event->kind != "WCS") continue;
    std::string line = event->line;
    trace.events.erase(event);
    return line;
  }
  return {};
}

bool SelectsBeforeMoving(const Trace& trace) {
  Trace copy = trace;
  return !TakeFirstOffset(copy).empty();
}

bool Moves(const Trace& trace) {
  for (const TraceEvent& event : trace.events) {
    if (event.IsMove()) return true;
  }
  return false;
}

struct Verdict {
  bool given = false;
  std::string text;  // given: what is wrong, empty = nothing; else why it was not given
};

Verdict Ask(const std::string& binary, const Vector& vector, const std::string& flat) {
  const auto run = [&](const char* command, const std::vector<std::string>& more) {
    std::vector<std::string> all = {binary, command, vector.program.string()};
    all.insert(all.end(), vector.options.begin(), vector.options.end());
    all.insert(all.end(), more.begin(), more.end());
    return RunProcess(all);
  };
  const std::string target = vector.mill ? "iso-mill" : "iso-lathe";
  ParsedTrace source = ParseTrace(run("trace", {}).output);
  if (!source.error.empty()) return {true, source.error};
  for (const TraceEvent& event : source.trace.events) {
    if (event.turns != 0) return {false, "turns more than once"};
  }
  std::error_code ignored;
  fs::remove(flat, ignored);
  const ProcessResult flattened = run("flatten", {"--to", target, "-o", flat});
  if (flattened.exit_code != 0) {
    const std::size_t at = flattened.errors.find("error[");
    const std::string first = flattened.errors.substr(at == std::string::npos ? 0 : at);
    return {false, "flatten refuses it: " + first.substr(0, first.find('\n'))};
  }
  const ProcessResult back = RunProcess({binary, "trace", flat, "--from", target});
  ParsedTrace again = ParseTrace(back.output);
  if (back.exit_code != 0 || !again.error.empty())
    return {true, "the flat program does not run: " + again.error + "\n" + Tail(back.errors, 4)};
  if (vector.language == "fanuc" && Moves(source.trace) && !SelectsBeforeMoving(source.trace)) {
    if (const std::string line = TakeFirstOffset(again.trace); line != "WCS 54")
      return {true, "the source starts in G54, the flat program in \"" + line + "\""};
  }
  FlatAllowance allowance;
  allowance.diameter_words = !vector.mill;
  return {true, CompareWithFlat(source.trace, again.trace, allowance).value_or("")};
}

int Main(const std::string& binary, const fs::path& source) {
  const ScratchFolder folder;
  int all = 0, given = 0, failed = 0;
  for (const Vector& vector : ListVectors(source / "tests/vectors")) {
    if (vector.open || vector.options.empty() || vector.ExpectsAlarm()) continue;
    ++all;
    const Verdict verdict = Ask(binary, vector, folder.File("flat.nc"));
    if (!verdict.given) {
      std::printf("not given: %s: %s\n", vector.name.c_str(), verdict.text.c_str());
      continue;
    }
    ++given;
    if (verdict.text.empty()) continue;
    ++failed;
    std::printf("FAILED %s\n%s\n", vector.name.c_str(), verdict.text.c_str());
  }
  std::printf("%d of %d vectors went to flat blocks and back (at least %.0f %% must); %d failed\n", given, all,
              100 * kLeastShare, failed);
  return failed == 0 && all > 0 && given >= kLeastShare * all ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: ncport_flatten_vectors BINARY SOURCE\n");
    return 2;
  }
  return ncport::tests::Main(argv[1], argv[2]);
}
