// ncport_port_sinumerik BINARY SOURCE [--list]: every behaviour vector of the Fanuc family, and the sample, to
// SINUMERIK. Source and output do the same, or a finding names the place of what has no form: refused_sinumerik.txt.
// A vector has no inputs, so a branch that its one run does not take is no failure here.
// --list prints the lines of refused_sinumerik.txt as they are now.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/port/port_checks.h"
#include "tests/tools/process.h"
#include "tests/tools/vectors.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

Translated ToSinumerik(const std::string& binary, const fs::path& program, const std::string& from) {
  const ScratchFolder scratch;
  const bool lathe = from.find("lathe") != std::string::npos;
  return Translate(binary, {program.string(), "--from", from, "--to",
                            lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill", "--verify", "-o", scratch.Path()});
}

bool Same(const Translated& outcome) {
  const std::string& text = outcome.process.errors;
  const bool open = outcome.codes == "NC7002" && text.find("branches were never taken") != std::string::npos;
  // A program that every set ends by an alarm before it moves does the same where the alarms agree: a difference would
  // be NC7001.
  const bool alarms = outcome.codes == "NC7002" && text.find("moved before an alarm") != std::string::npos;
  return outcome.equal || open || alarms;
}

int Run(const std::string& binary, const fs::path& root, bool list) {
  PortChecks checks(root / "tests/port/refused_sinumerik.txt", list);
  for (const Vector& vector : ListVectors(root / "tests/vectors")) {
    if (vector.language != "fanuc") continue;
    std::string from = "fanuc-mill";
    for (std::size_t i = 0; i + 1 < vector.options.size(); ++i) {
      if (vector.options[i] == "--from") from = vector.options[i + 1];
    }
    const Translated outcome = ToSinumerik(binary, vector.program, from);
    checks.Judge(vector.program.stem().string(), outcome, Same(outcome));
  }
  if (list) return 0;
  checks.CloseList();
  const Translated sample = ToSinumerik(binary, root / "samples/bolt_circle_macro/bolt_circle.nc", "fanuc-mill");
  if (sample.process.exit_code != 0 || !Same(sample)) checks.Fail("samples/bolt_circle_macro", sample.process.errors);
  std::printf("%zu of %zu vectors do the same, the others are refused; %d failed\n", checks.Same(), checks.All(),
              checks.Failures());
  return checks.Failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  return ncport::tests::Run(argv[1], argv[2], argc > 3 && std::strcmp(argv[3], "--list") == 0);
}
