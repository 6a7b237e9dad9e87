// The flat form: what a run does, written as literal blocks, read back and run. The turns of helices are blocks of
// their own there, messages and path modes are listed losses.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "app/ncport.h"
#include "backends/iso/flat_arc.h"
#include "backends/iso/flat_writer.h"
#include "dialects/machine.h"
#include "dialects/registry.h"
#include "exec/environment.h"
#include "prove/compare.h"
#include "tests/random/direction_checks.h"
#include "tests/random/refusals.h"
#include "tests/random/runs.h"
#include "tests/random/shop.h"
#include "tests/random/texts.h"

namespace ncport::tests::random {

namespace {

/// Hands the events of a run to the writer and keeps them.
class Tee final : public exec::EventSink {
 public:
  Tee(backends::iso::FlatWriter& writer, prove::RecordedTrace& trace) : writer_(writer), trace_(trace) {}
  bool OnEvent(const exec::Event& event) override { return writer_.OnEvent(event) && trace_.OnEvent(event); }

 private:
  backends::iso::FlatWriter& writer_;
  prove::RecordedTrace& trace_;
};

double SweepOf(const exec::Event& arc, int first, int second) {
  backends::iso::ExactArc exact;
  exact.from[0] = arc.from[first];
  exact.from[1] = arc.from[second];
  exact.to[0] = arc.position[first];
  exact.to[1] = arc.position[second];
  exact.center[0] = arc.center[0];
  exact.center[1] = arc.center[1];
  exact.clockwise = arc.clockwise;
  exact.full_circle = arc.full_circle;
  return backends::iso::SweepOf(exact);
}

/// Arcs with additional turns as that many full circles and the rest; the other axes move evenly (sinumerik-8.3).
void SplitTurns(const prove::RecordedTrace& trace, prove::RecordedTrace& split) {
  for (exec::Event event : trace.Events()) {
    if (event.kind != exec::EventKind::kArc || event.turns == 0) {
      split.OnEvent(event);
      continue;
    }
    const int first = event.plane == ir::Plane::kXY ? 0 : event.plane == ir::Plane::kZX ? 2 : 1;
    const int second = event.plane == ir::Plane::kXY ? 1 : event.plane == ir::Plane::kZX ? 0 : 2;
    const double in_all = event.turns + SweepOf(event, first, second) / (2 * std::numbers::pi);
    const exec::Event whole = event;
    event.turns = 0;
    event.full_circle = true;
    for (std::uint32_t turn = 1; turn <= whole.turns; ++turn) {
      for (int axis = 0; axis < ir::kMaxAxes; ++axis) {
        const bool in_plane = axis == first || axis == second;
        const double way = in_plane ? 0 : whole.position[axis] - whole.from[axis];
        event.from[axis] = whole.from[axis] + way * (turn - 1) / in_all;
        event.position[axis] = whole.from[axis] + way * turn / in_all;
      }
      split.OnEvent(event);
    }
    exec::Event last = whole;
    last.turns = 0;
    for (int axis = 0; axis < ir::kMaxAxes; ++axis) last.from[axis] = event.position[axis];
    split.OnEvent(last);
  }
}

}  // namespace

Finding CheckFlat(const Subject& subject, const Direction& /*direction*/) {
  const std::vector<TextFile> texts = PrintAll(*subject.module, *subject.profile);
  Context context;
  ir::Module source;
  if (!ReadAll(texts, *subject.profile, context.files, source, context.findings))
    return {Verdict::kFails, "read the source, " + FirstError(context.findings), TextOf(context.findings),
            Listing(texts)};
  const ir::ProgramId entry =
      source.FindProgram(subject.module->View(subject.module->programs[subject.main].name), true);
  if (!entry.Valid()) return {Verdict::kFails, "main program lost", "no program of that name", Listing(texts)};

  const SkipSets skips = SkipSetsOf(source);
  // Flat text holds one run: with all blocks it is that of the program without its marks, as flatten tells the user.
  ir::Module unmarked = source;
  for (ir::Block& block : unmarked.blocks.All()) block.skip_level = ir::Block::kNoSkip;
  bool compared = false;
  for (std::uint32_t i = 0; i < skips.count; ++i) {
    exec::RunOptions options;
    options.entry = entry;
    options.skip_levels = skips.sets[i];
    options.max_blocks = subject.max_blocks;
    options.report_variables = false;
    exec::Coverage coverage;
    backends::iso::FlatOptions flat_options;
    flat_options.config = subject.config;
    flat_options.coverage = &coverage;
    flat_options.start_offset = subject.machine->start.work_offset;
    const ir::Module& run_of = skips.sets[i] == 0 ? unmarked : source;
    std::string flat;
    OutputSink output(flat);
    backends::iso::FlatWriter writer(run_of, context.files, *subject.target, flat_options, output, context.findings);
    exec::NoEnvironment environment;
    prove::RecordedTrace trace;
    Tee tee(writer, trace);
    const exec::Outcome outcome =
        exec::Run(run_of, *subject.machine, options, environment, tee, context.findings, &coverage).outcome;
    if (outcome == exec::Outcome::kAlarmed) continue;  // an alarm has no flat form, and no program comes of it
    if (context.findings.HasErrors())
      return {Verdict::kRefused, ReasonOf(context.findings), TextOf(context.findings), Listing(texts)};
    if (outcome != exec::Outcome::kEnded || !writer.Finish().Ok())
      return {Verdict::kFails, "flatten", TextOf(context.findings), Listing(texts)};

    SourceFiles flat_files;
    ir::Module module;
    diag::Sink sink;
    const std::vector<TextFile> flat_texts{{"flat.nc", flat}};
    const std::string artefact = Listing(texts) + Listing(flat_texts);
    if (!ReadAll(flat_texts, *subject.target, flat_files, module, sink) || module.programs.Size() == 0)
      return {Verdict::kFails, "read back, " + FirstError(sink), TextOf(sink), artefact};
    const ir::Machine machine = dialects::MachineFor(*subject.target);
    Subject flat_subject;
    flat_subject.module = &module;
    flat_subject.main = ir::ProgramId{0U};
    flat_subject.machine = &machine;
    flat_subject.max_blocks = 10'000'000;
    Run run;
    RunProgram(flat_subject, 0, run);
    if (run.outcome != exec::Outcome::kEnded) return {Verdict::kFails, "run, " + run.code, run.findings, artefact};

    prove::CompareOptions compare;
    compare.source = {subject.machine->word_error, subject.profile->increment.Or(subject.machine->increment),
                      subject.machine->transverse_axis};
    // Literal words are taken as they are; the writer has rounded each once, S to a whole number (iso-3).
    compare.target = {ir::WordError::kRound, subject.target->increment.Or(0.001), machine.transverse_axis};
    compare.target.speed_error = 0.5;
    compare.maps = ShopMapsFor(*subject.target);
    prove::RecordedTrace split;
    SplitTurns(trace, split);
    const prove::Comparison comparison = prove::Compare(split, run.trace, compare, subject.machine->start.work_offset);
    if (comparison.difference) {
      return {Verdict::kFails, "compare, " + KindOfText(comparison.difference->what), comparison.difference->what,
              artefact};
    }
    compared = true;
  }
  return compared ? Finding{} : Finding{Verdict::kNoProgram, "every run ends in an alarm", {}, {}};
}

}  // namespace ncport::tests::random
