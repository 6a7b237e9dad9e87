#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "app/envelope.h"
#include "app/flatten_report.h"
#include "app/ncport.h"
#include "app/pipeline.h"
#include "backends/iso/flat_writer.h"
#include "backends/iso/source_map.h"
#include "dialects/machine.h"
#include "ir/analysis/tool_change.h"

namespace ncport {
namespace {

using backends::iso::FlatListener;

/// Hands each flat block on to those who asked.
class Listeners final : public FlatListener {
 public:
  void Add(FlatListener* listener) { listeners_[count_++] = listener; }
  void OnFlatBlock(std::uint64_t line, std::string_view text, const backends::iso::FlatOrigin& origin) override {
    for (std::size_t i = 0; i < count_; ++i) listeners_[i]->OnFlatBlock(line, text, origin);
  }
  [[nodiscard]] bool Any() const { return count_ != 0; }

 private:
  FlatListener* listeners_[2] = {};
  std::size_t count_ = 0;
};

/// First lines of the output: the source, the machines, and the settings of the run.
std::vector<std::string> Heading(std::string_view name, const FlattenOptions& options, const dialects::Profile& from,
                                 const dialects::Profile& to) {
  name = name.substr(name.rfind('/') + 1);
  std::vector<std::string> lines = {fmt::format("{} from {} to {}, ncport {}", name, from.name, to.name, Version())};
  if (!options.call.empty()) lines.push_back("call " + options.call);
  for (const std::string& set : options.set) lines.push_back("set " + set);
  if (!options.start.empty()) lines.push_back("start " + options.start);
  return lines;
}

/// Lists an assumption on which word changes the tool, at the first tool word.
void ReportToolChange(Context& context, const app::ProgramSet& set, const ir::Machine& machine) {
  using ir::analysis::ToolChange;
  if (ir::analysis::WhenToolsChange(set.module, machine) != ToolChange::kAssumedAtToolWord) return;
  for (const ir::Block& block : set.module.blocks.All()) {
    for (const ir::WordId id : block.words) {
      const ir::Word& word = set.module.words[id];
      if (word.op != ir::WordOp::kTool) continue;
      const SourceRange at = set.module.RangeOf(block, word);
      context.findings.Report(diag::Code::kAssumedToolChange, at, context.files.View(at)).help =
          "where T changes the tool, say so in a profile file: [sinumerik] tool-change = \"t\"";
      return;
    }
  }
}

/// One finding for all rapids that may go another way; the other blocks are notes.
void ReportRapids(Context& context, const app::ProgramSet& set, const dialects::Profile& target,
                  const std::vector<backends::iso::FlatRapid>& rapids) {
  constexpr std::size_t kMostNotes = 20;
  const auto place_of = [&](const backends::iso::FlatRapid& rapid) {
    return rapid.block.Valid() ? set.module.RangeOf(set.module.blocks[rapid.block]) : SourceRange{};
  };
  if (rapids.empty()) return;
  diag::Diagnostic& finding = context.findings.Report(diag::Code::kRapidPath, place_of(rapids.front()),
                                                      app::RapidWay(set.profile), app::RapidWay(target));
  for (std::size_t i = 1; i < rapids.size() && i <= kMostNotes; ++i)
    finding.notes.push_back({place_of(rapids[i]), "and here"});
  if (rapids.size() > kMostNotes + 1) {
    finding.notes.push_back(
        {SourceRange{}, fmt::format("and {} more; --report lists all", rapids.size() - kMostNotes - 1)});
  }
}

}  // namespace

Status Flatten(Context& context, std::vector<Input> inputs, const FlattenOptions& options, OutputSink& output) {
  using app::ProfileNeed;
  std::string target_name = options.to;
  if (target_name.empty() && options.config != nullptr) target_name = options.config->to.value_or("");
  if (target_name.empty()) {
    context.findings.Report(diag::Code::kNoProfile, SourceRange{}, "the output").help =
        "name the target with --to, for example --to iso-mill";
    return Failure{};
  }
  NCPORT_TRY_ASSIGN(const dialects::Profile target,
                    dialects::LoadProfile(target_name, context.files, context.findings));
  if (target.language != dialects::Language::kIso) {
    context.findings.Report(diag::Code::kNotExpressible, SourceRange{}, "a program of literal blocks", target.name)
        .help = "flat blocks are written for iso profiles, for example --to iso-mill";
    return Failure{};
  }
  app::ProgramSet set;
  NCPORT_TRY(app::ReadSet(context, std::move(inputs), options, ProfileNeed::kNamed, set));
  NCPORT_TRY_ASSIGN(exec::RunOptions run, app::RunOptionsFor(context, set, options));
  run.count_turns = options.side_by_side || options.source_map != nullptr;
  const ir::Machine machine = dialects::MachineFor(set.profile);

  exec::Coverage coverage;
  backends::iso::FlatOptions flat;
  flat.heading = Heading(context.files.Name(set.inputs.front()), options, set.profile, target);
  flat.config = options.config;
  flat.coverage = &coverage;
  flat.max_bytes = options.max_bytes;
  flat.start_offset = machine.start.work_offset;
  flat.list_rapids = app::RapidsMayDiffer(set.profile, target);
  flat.only_listener = options.side_by_side;
  backends::iso::FlatWriter writer(set.module, context.files, target, std::move(flat), output, context.findings);
  backends::iso::SideBySideWriter columns(set.module, context.files, output);
  std::unique_ptr<backends::iso::SourceMapWriter> map;
  Listeners listeners;
  if (options.side_by_side) listeners.Add(&columns);
  if (options.source_map != nullptr) {
    map = std::make_unique<backends::iso::SourceMapWriter>(set.module, context.files, *options.source_map);
    listeners.Add(map.get());
  }
  if (listeners.Any()) writer.SetListener(&listeners);

  exec::NoEnvironment environment;
  app::Envelopes envelopes(set.module, &writer);
  exec::EventSink& events = options.report != nullptr ? static_cast<exec::EventSink&>(envelopes) : writer;
  ReportToolChange(context, set, machine);
  const exec::RunResult result = exec::Run(set.module, machine, run, environment, events, context.findings, &coverage);
  if (result.outcome != exec::Outcome::kEnded) return Failure{};
  Status ok = writer.Finish();
  ReportRapids(context, set, target, writer.Record().rapids);
  if (options.report != nullptr && !context.findings.HasErrors()) {
    app::Report report = app::FlattenReport(context, set, target, options, writer.Record());
    report.envelopes = envelopes.Result(context.files, options.config);
    context.findings.SortByPlace();
    app::AddFindings(report, context.findings, context.files);
    ok &= options.report->Write(app::RenderReport(report, options.report_form));
  }
  if (options.side_by_side) ok &= columns.Finish();
  if (map) ok &= map->Finish();
  return context.findings.HasErrors() ? ok & Failure{} : ok;
}

}  // namespace ncport
