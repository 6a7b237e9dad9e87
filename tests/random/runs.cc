#include "tests/random/runs.h"

#include <fmt/format.h>

#include "base/diag/codes.h"
#include "exec/environment.h"
#include "exec/trace_text.h"

namespace ncport::tests::random {

namespace {

/// Events kept for comparison and written as text.
class Recorder final : public exec::EventSink {
 public:
  Recorder(const ir::Module& module, Run& run) : module_(module), run_(run) {}

  bool OnEvent(const exec::Event& event) override {
    exec::AppendTraceLine(buffer_, event, module_);
    return run_.trace.OnEvent(event);
  }
  void Finish() { run_.text = std::string(buffer_.View()); }

 private:
  const ir::Module& module_;
  Run& run_;
  TextBuffer buffer_;
};

}  // namespace

std::string TextOf(const diag::Sink& sink) {
  std::string text;
  for (const diag::Diagnostic& finding : sink.All()) {
    text += fmt::format("{} line {}: {}{}\n", diag::InfoOf(finding.code).number, finding.at.line, finding.message,
                        finding.help.empty() ? "" : " (" + finding.help + ")");
  }
  return text;
}

std::string FirstError(const diag::Sink& sink) {
  for (const diag::Diagnostic& finding : sink.All()) {
    if (finding.severity == diag::Severity::kError) return std::string(diag::InfoOf(finding.code).number);
  }
  return {};
}

void RunProgram(const Subject& subject, std::uint16_t skip_levels, Run& run) {
  exec::RunOptions options;
  options.entry = subject.main;
  options.skip_levels = skip_levels;
  options.max_blocks = subject.max_blocks;
  options.report_variables = false;
  exec::NoEnvironment environment;
  diag::Sink sink;
  run.trace.Clear();
  Recorder recorder(*subject.module, run);
  run.outcome = exec::Run(*subject.module, *subject.machine, options, environment, recorder, sink).outcome;
  recorder.Finish();
  run.findings = TextOf(sink);
  run.code = FirstError(sink);
  if (run.outcome == exec::Outcome::kAlarmed)
    run.code = run.trace.Events().empty() ? "alarm without its event"
                                          : fmt::format("alarm {}", static_cast<int>(run.trace.Events().back().alarm));
}

SkipSets SkipSetsOf(const ir::Module& module) {
  SkipSets sets;
  for (const ir::Block& block : module.blocks.All()) {
    if (block.skip_level == ir::Block::kNoSkip) continue;
    sets.sets[1] = 0x3FF;
    sets.count = 2;
    break;
  }
  return sets;
}

namespace {

struct LinePair {
  std::size_t number = 0;  // 0: no difference
  std::string_view a, b;
};

LinePair FirstDifferentLines(std::string_view a, std::string_view b) {
  for (std::size_t line = 1; !a.empty() || !b.empty(); ++line) {
    const LinePair pair{line, a.substr(0, a.find('\n')), b.substr(0, b.find('\n'))};
    if (pair.a != pair.b) return pair;
    a.remove_prefix(std::min(a.size(), pair.a.size() + 1));
    b.remove_prefix(std::min(b.size(), pair.b.size() + 1));
  }
  return {};
}

std::string_view FirstWord(std::string_view line) { return line.substr(0, line.find(' ')); }

}  // namespace

std::string FirstDifference(std::string_view a, std::string_view b) {
  const LinePair pair = FirstDifferentLines(a, b);
  return pair.number == 0 ? "no difference" : fmt::format("line {}:\n  {}\n  {}\n", pair.number, pair.a, pair.b);
}

std::string KindOfText(std::string_view what) {
  std::string kind(what.substr(0, what.find_first_of("0123456789-")));
  return kind.substr(0, 90);
}

std::string KindOfDifference(std::string_view a, std::string_view b) {
  const LinePair pair = FirstDifferentLines(a, b);
  return fmt::format("{}/{}", FirstWord(pair.a), FirstWord(pair.b));
}

}  // namespace ncport::tests::random
