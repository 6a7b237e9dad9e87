#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/added_blocks.h"
#include "app/ncport.h"
#include "app/pipeline.h"
#include "dialects/machine.h"
#include "exec/link.h"
#include "prove/compare.h"

namespace ncport {
namespace {

/// One side of a comparison: what was read, how it ran.
struct DiffSide {
  explicit DiffSide(std::size_t max_events) : trace(max_events) {}

  app::ProgramSet set;
  ir::Machine machine;
  prove::RecordedTrace trace;
  exec::Outcome outcome = exec::Outcome::kEnded;
};

SourceRange PlaceOf(const DiffSide& side, ir::BlockId block) {
  if (!block.Valid() || block.value >= side.set.module.blocks.Size()) return {};
  return side.set.module.RangeOf(side.set.module.blocks[block]);
}

Status RunSide(Context& context, const Input& input, const std::string& from, const DiffOptions& options,
               DiffSide& side) {
  RunSettings settings = options;
  settings.from = from.empty() ? options.from : from;
  NCPORT_TRY(app::ReadSet(context, {input}, settings, app::ProfileNeed::kGuess, side.set));
  NCPORT_TRY_ASSIGN(const exec::RunOptions run, app::RunOptionsFor(context, side.set, settings));
  side.machine = dialects::MachineFor(side.set.profile);
  prove::LeaveToOperator(side.machine.start);
  app::MarkAddedBlocks(side.set.module, side.set.profile.language);
  const exec::Linked linked(side.set.module, side.machine);
  exec::NoEnvironment environment;
  side.outcome = exec::Run(linked, run, environment, side.trace, context.findings).outcome;
  if (side.trace.Full()) {
    const SourceRange at =
        PlaceOf(side, side.trace.Events().empty() ? ir::BlockId{} : side.trace.Events().back().block);
    context.findings.Report(diag::Code::kEventLimit, at, options.max_events).help = "raise it with --max-events";
    return Failure{};
  }
  if (side.outcome == exec::Outcome::kEnded || side.outcome == exec::Outcome::kAlarmed) return {};
  return Failure{};
}

}  // namespace

Status Diff(Context& context, const Input& a, const Input& b, const DiffOptions& options, DiffResult& result) {
  DiffSide source(options.max_events);
  DiffSide target(options.max_events);
  NCPORT_TRY(RunSide(context, a, options.from_a, options, source));
  NCPORT_TRY(RunSide(context, b, options.from_b, options, target));
  prove::CompareOptions compare;
  compare.source = {source.machine.word_error, source.set.profile.increment.Or(source.machine.increment),
                    source.machine.transverse_axis};
  compare.target = {target.machine.word_error, target.set.profile.increment.Or(target.machine.increment),
                    target.machine.transverse_axis};
  compare.maps.cross_language = source.set.profile.language != target.set.profile.language;
  compare.tolerance = options.tolerance;
  const prove::Comparison comparison =
      prove::Compare(source.trace, target.trace, compare, target.machine.start.work_offset);
  if (!comparison.difference) {
    const auto added = [](const DiffSide& side) {
      const auto& events = side.trace.Events();
      return std::count_if(events.begin(), events.end(), [](const exec::Event& event) { return event.added; });
    };
    result.summary = fmt::format(
        "EQUAL: both programs make the machine do the same.\n"
        "  {} pairs of events compared, {} and {} events are of blocks marked as added\n"
        "  {} changes of a spindle stand on the other side of a rapid\n",
        comparison.events_compared, added(source), added(target), comparison.spindle_moved_across_rapid);
    return {};
  }
  auto& finding = context.findings.Report(
      diag::Code::kTraceDiffers, PlaceOf(source, comparison.difference->source_block), comparison.difference->what);
  const SourceRange other = PlaceOf(target, comparison.difference->target_block);
  if (other.Valid()) finding.notes.push_back({other, "the other program is here"});
  return Failure{};
}

}  // namespace ncport
