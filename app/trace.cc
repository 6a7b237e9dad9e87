#include "app/ncport.h"
#include "app/pipeline.h"
#include "dialects/machine.h"
#include "exec/trace_text.h"

namespace ncport {

Status Trace(Context& context, const std::vector<Input>& inputs, const TraceOptions& options, OutputSink& output) {
  app::ProgramSet set;
  NCPORT_TRY(app::ReadSet(context, inputs, options, app::ProfileNeed::kGuess, set));
  NCPORT_TRY_ASSIGN(exec::RunOptions run, app::RunOptionsFor(context, set, options));
  run.report_variables = options.variables;
  const bool json = options.format == TraceFormat::kJson;
  exec::TraceWriter writer(output, set.module, json ? exec::TraceFormat::kJson : exec::TraceFormat::kText);
  exec::NoEnvironment environment;
  const exec::RunResult result =
      exec::Run(set.module, dialects::MachineFor(set.profile), run, environment, writer, context.findings);
  const Status written = writer.Finish();
  if (result.outcome != exec::Outcome::kEnded) return Failure{};
  return context.findings.HasErrors() ? Failure{} : written;
}

}  // namespace ncport
