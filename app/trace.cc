#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

#include "app/ncport.h"
#include "app/pipeline.h"
#include "dialects/machine.h"
#include "exec/trace_text.h"

namespace ncport {
namespace {

/// Hands events to the trace, and reports an alarm that ends the run with its place and the calls that led there.
class AlarmReporter final : public exec::EventSink {
 public:
  AlarmReporter(exec::EventSink& trace, const ir::Module& module, diag::Sink& findings)
      : trace_(trace), module_(module), findings_(findings) {}

  bool OnEvent(const exec::Event& event) override {
    if (event.kind == exec::EventKind::kAlarm) Report(event);
    return trace_.OnEvent(event);
  }

 private:
  void Report(const exec::Event& event) {
    const auto place = [this](ir::BlockId block) {
      return block.Valid() ? module_.RangeOf(module_.blocks[block]) : SourceRange{};
    };
    diag::Diagnostic& finding = findings_.Report(
        diag::Code::kProgramAlarm, place(event.block),
        fmt::format("{}{}{}", event.code, event.code.empty() || event.text.empty() ? "" : " ", event.text));
    if (event.frames == nullptr) return;
    for (std::uint32_t level = event.frames->depth; level-- > 0;) {
      const ir::BlockId call = event.frames->call_blocks[level];
      if (call.Valid()) finding.notes.push_back({place(call), "called from here"});
    }
  }

  exec::EventSink& trace_;
  const ir::Module& module_;
  diag::Sink& findings_;
};

}  // namespace

Status Trace(Context& context, std::vector<Input> inputs, const TraceOptions& options, OutputSink& output) {
  app::ProgramSet set;
  NCPORT_TRY(app::ReadSet(context, std::move(inputs), options, app::ProfileNeed::kGuess, set));
  NCPORT_TRY_ASSIGN(exec::RunOptions run, app::RunOptionsFor(context, set, options));
  run.report_variables = options.variables;
  const bool json = options.format == TraceFormat::kJson;
  exec::TraceWriter writer(output, set.module, json ? exec::TraceFormat::kJson : exec::TraceFormat::kText);
  AlarmReporter events(writer, set.module, context.findings);
  exec::NoEnvironment environment;
  const exec::RunResult result =
      exec::Run(set.module, dialects::MachineFor(set.profile), run, environment, events, context.findings);
  const Status written = writer.Finish();
  if (result.outcome != exec::Outcome::kEnded) return Failure{};
  return context.findings.HasErrors() ? Failure{} : written;
}

}  // namespace ncport
