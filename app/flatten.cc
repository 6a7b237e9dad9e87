#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "app/ncport.h"
#include "app/pipeline.h"
#include "backends/iso/flat_writer.h"
#include "backends/iso/source_map.h"
#include "dialects/machine.h"

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

  exec::Coverage coverage;
  backends::iso::FlatOptions flat;
  flat.heading = Heading(context.files.Name(set.inputs.front()), options, set.profile, target);
  flat.config = options.config;
  flat.coverage = &coverage;
  flat.max_bytes = options.max_bytes;
  flat.tool_changes_at_t = set.profile.sinumerik.tool_change.Is(dialects::SinumerikSettings::ToolChange::kAtT);

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
  const ir::Machine machine = dialects::MachineFor(set.profile);
  const exec::RunResult result = exec::Run(set.module, machine, run, environment, writer, context.findings, &coverage);
  if (result.outcome != exec::Outcome::kEnded) return Failure{};
  Status ok = writer.Finish();
  if (options.side_by_side) ok &= columns.Finish();
  if (map) ok &= map->Finish();
  return context.findings.HasErrors() ? ok & Failure{} : ok;
}

}  // namespace ncport
