// The program as IR: what all other checks start from.
#include <fmt/format.h>

#include "base/text_buffer.h"
#include "ir/dump.h"
#include "ir/parse_dump.h"
#include "ir/verify.h"
#include "tests/random/direction_checks.h"
#include "tests/random/runs.h"

namespace ncport::tests::random {

namespace {

std::string DumpOf(const ir::Module& module) {
  TextBuffer out;
  ir::Dump(module, out);
  return std::string(out.View());
}

bool HasAlarm(const ir::Module& module) {
  for (const ir::Program& program : module.programs.All()) {
    for (const ir::BlockId block : program.blocks) {
      for (const ir::WordId word : module.blocks[block].words) {
        if (module.words[word].op == ir::WordOp::kAlarm) return true;
      }
    }
  }
  return false;
}

}  // namespace

Finding CheckIr(const Subject& subject, const Direction& /*direction*/) {
  const ir::Module& module = *subject.module;
  if (const auto violation = ir::FindViolation(module, {.names_resolved = true, .structure_built = true})) {
    return {Verdict::kFails, "verify", *violation, {}};
  }
  const std::string dump = DumpOf(module);
  diag::Sink sink;
  const Result<ir::Module> parsed = ir::ParseDump(dump, sink);
  if (!parsed.Ok()) return {Verdict::kFails, "parse dump", TextOf(sink), dump};
  const std::string again = DumpOf(parsed.Value());
  if (again != dump) return {Verdict::kFails, "dump again", FirstDifference(dump, again), dump};

  const SkipSets skips = SkipSetsOf(module);
  for (std::uint32_t i = 0; i < skips.count; ++i) {
    Run first;
    RunProgram(subject, skips.sets[i], first);
    const bool alarmed = first.outcome == exec::Outcome::kAlarmed && HasAlarm(module) &&
                         first.text.find("ALARM 65") != std::string::npos;
    if (first.outcome != exec::Outcome::kEnded && !alarmed) {
      return {Verdict::kFails, "run, " + first.code,
              fmt::format("outcome {}\n{}{}", static_cast<int>(first.outcome), first.findings, first.text), dump};
    }
    Run second;
    RunProgram(subject, skips.sets[i], second);
    if (first.text != second.text)
      return {Verdict::kFails, "run twice", FirstDifference(first.text, second.text), dump};
    Subject read = subject;
    read.module = &parsed.Value();
    RunProgram(read, skips.sets[i], second);
    if (first.text != second.text)
      return {Verdict::kFails, "run of dump", FirstDifference(first.text, second.text), dump};
  }
  return {};
}

}  // namespace ncport::tests::random
