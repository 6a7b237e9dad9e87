#include "backends/translate.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "app/comparison.h"
#include "app/envelope.h"
#include "app/ncport.h"
#include "app/pipeline.h"
#include "app/source_map_json.h"
#include "app/stops.h"
#include "app/translate_report.h"
#include "app/translation_header.h"
#include "dialects/machine.h"
#include "exec/run.h"

namespace ncport {
namespace {

/// The first difference, at its source block.
void ReportDifference(Context& context, const app::ProgramSet& set, const prove::Verification& verification,
                      const std::vector<prove::Input>& inputs) {
  const prove::Difference& difference = *verification.difference;
  SourceRange at;
  if (difference.source_block.Valid() && difference.source_block.value < set.module.blocks.Size()) {
    at = set.module.RangeOf(set.module.blocks[difference.source_block]);
  }
  auto& finding = context.findings.Report(diag::Code::kTraceDiffers, at, difference.what);
  std::string values;
  for (std::size_t i = 0; i < inputs.size() && i < verification.difference_set.size(); ++i) {
    const double value = verification.difference_set[i];
    values += fmt::format("{}{}", i == 0 ? "" : " ", inputs[i].name);
    values += value == prove::kMissing ? " missing" : fmt::format("={:g}", value);
  }
  finding.notes.push_back({SourceRange{}, fmt::format("with {} ({})", values.empty() ? "no inputs" : values,
                                                      verification.difference_start)});
}

void ReportNotCompared(Context& context, const app::ProgramSet& set, const prove::Verification& verification) {
  auto& finding = context.findings.Report(diag::Code::kNotCompared, SourceRange{}, verification.not_compared);
  for (const prove::Branch& branch : verification.open_branches) {
    finding.notes.push_back({set.module.RangeOf(set.module.blocks[branch.block]),
                             branch.taken ? "this condition never held" : "this condition always held"});
  }
  for (const ir::BlockId block : verification.stops)
    finding.notes.push_back({set.module.RangeOf(set.module.blocks[block]), "the alarm comes here"});
  if (verification.stops.empty())
    finding.help = "declare what the arguments may be in [ranges] of ncport.toml, or give more sets with --runs";
}

/// How far the source goes with each tool, as its own calls run it. Empty when it cannot run to its end: a value that
/// only the machine knows.
std::vector<app::ReportEnvelope> EnvelopesOf(Context& context, const app::ProgramSet& set, const ir::Machine& machine,
                                             const dialects::Config& config, const TranslateOptions& options) {
  Context quiet;
  Result<exec::RunOptions> run = app::RunOptionsFor(quiet, set, options);
  if (!run.Ok()) return {};
  app::Envelopes envelopes(set.module, nullptr);
  exec::NoEnvironment environment;
  const exec::RunResult result = exec::Run(set.module, machine, *run, environment, envelopes, quiet.findings);
  if (result.outcome != exec::Outcome::kEnded) return {};
  return envelopes.Result(context.files, &config);
}

}  // namespace

Status Translate(Context& context, std::vector<Input> inputs, const TranslateOptions& options,
                 TranslateResult& result) {
  app::ProgramSet set;
  NCPORT_TRY(app::ReadSet(context, std::move(inputs), options, app::ProfileNeed::kNamed, set));
  std::string target_name = options.to;
  if (target_name.empty() && options.config != nullptr) target_name = options.config->to.value_or("");
  if (target_name.empty()) {
    context.findings.Report(diag::Code::kNoProfile, SourceRange{}, "the output").help = "name the target with --to";
    return Failure{};
  }
  NCPORT_TRY_ASSIGN(const dialects::Profile target,
                    dialects::LoadProfile(target_name, context.files, context.findings));
  const ir::Machine machine = dialects::MachineFor(set.profile);
  dialects::Config config = options.config != nullptr ? options.config->For(target_name) : dialects::Config{};
  NCPORT_TRY_ASSIGN(const exec::RunOptions run, app::RunOptionsFor(context, set, options));
  app::TakeCall(run, set, config);
  backends::Translation translation;
  const ir::Module source = set.module;
  const backends::TranslateInput input{&source, &set.profile, &machine, &target, &config, options.keep_increments};
  const bool raised = options.stop_at_unsupported ? app::RaiseWithStops(context, input, translation, set.module)
                                                  : backends::Raise(input, translation, context.findings);
  if (!raised) return Failure{};
  const bool stopped = context.findings.HasErrors();  // by --unsupported=stop: written all the same
  const std::size_t errors = context.findings.ErrorCount();
  std::vector<backends::OutputFile> files = backends::Print(target, translation, {});

  std::optional<prove::Verification> verification;
  std::vector<prove::Input> varied;
  if (options.verify) {
    const app::ComparisonSetup setup{options.runs, options.seed, options.max_blocks};
    verification =
        app::CompareTranslation(context, set, machine, run, target, translation, files, &config, setup, varied);
    if (verification->difference) ReportDifference(context, set, *verification, varied);
    if (!verification->difference && !verification->compared) ReportNotCompared(context, set, *verification);
    result.summary = app::SummaryOf(*verification, varied);
    if (translation.stopped_blocks != 0)
      result.summary += fmt::format("  NOT COMPLETE: compared as far as the {} blocks that became alarms\n",
                                    translation.stopped_blocks);
  }
  if (context.findings.ErrorCount() != errors) return Failure{};
  const std::vector<backends::ProgramHeader> headers =
      app::HeadersOf(context, set, target, translation, verification ? &*verification : nullptr, varied);
  std::vector<backends::OutputFile> printed = backends::Print(target, translation, headers);
  if (options.report != nullptr) {
    app::Report report = app::TranslateReport(
        {context, set, target, config, translation, printed, verification ? &*verification : nullptr, varied});
    report.envelopes = EnvelopesOf(context, set, machine, config, options);
    context.findings.SortByPlace();
    app::AddFindings(report, context.findings, context.files);
    (void)options.report->Write(app::RenderReport(report, options.report_form));
  }
  for (backends::OutputFile& file : printed) {
    if (options.source_map != nullptr) app::AppendSourceMap(context, translation.module, file, *options.source_map);
    result.files.push_back({std::move(file.name), std::move(file.text)});
  }
  if (stopped) return Failure{};
  return {};
}

}  // namespace ncport
