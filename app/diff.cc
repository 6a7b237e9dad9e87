#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
  ir::WorkOffset start_offset;  // that the profile starts with
  exec::RunOptions run;
  std::optional<exec::Linked> linked;
  prove::RecordedTrace trace;
  exec::Outcome outcome = exec::Outcome::kEnded;
};

SourceRange PlaceOf(const DiffSide& side, ir::BlockId block) {
  if (!block.Valid() || block.value >= side.set.module.blocks.Size()) return {};
  return side.set.module.RangeOf(side.set.module.blocks[block]);
}

Status ReadSide(Context& context, const Input& input, const std::string& from, const DiffOptions& options,
                DiffSide& side) {
  RunSettings settings = options;
  settings.from = from.empty() ? options.from : from;
  NCPORT_TRY(app::ReadSet(context, {input}, settings, app::ProfileNeed::kGuess, side.set));
  NCPORT_TRY_ASSIGN(side.run, app::RunOptionsFor(context, side.set, settings));
  side.run.report_variables = true;
  side.machine = dialects::MachineFor(side.set.profile);
  side.start_offset = side.machine.start.work_offset;
  prove::LeaveToOperator(side.machine.start);
  app::MarkAddedBlocks(side.set.module, side.set.profile.language);
  side.linked.emplace(side.set.module, side.machine);
  return {};
}

Status RunSide(Context& context, const DiffOptions& options, std::uint16_t skip_levels, DiffSide& side) {
  side.trace.Clear();
  exec::RunOptions run = side.run;
  run.skip_levels = skip_levels;
  exec::NoEnvironment environment;
  side.outcome = exec::Run(*side.linked, run, environment, side.trace, context.findings).outcome;
  if (side.trace.Full()) {
    const SourceRange at =
        PlaceOf(side, side.trace.Events().empty() ? ir::BlockId{} : side.trace.Events().back().block);
    context.findings.Report(diag::Code::kEventLimit, at, options.max_events).help = "raise it with --max-events";
    return Failure{};
  }
  if (side.outcome == exec::Outcome::kEnded || side.outcome == exec::Outcome::kAlarmed) return {};
  return Failure{};
}

std::uint16_t SkipLevelsOf(const ir::Module& module) {
  std::uint16_t levels = 0;
  const auto add = [&](std::uint8_t level) { levels = static_cast<std::uint16_t>(levels | 1U << level); };
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      if (block.skip_level != ir::Block::kNoSkip) add(block.skip_level);
      for (const ir::WordId word : block.words) {
        if (module.words[word].op == ir::WordOp::kSkipRest) add(module.words[word].index);
      }
    }
  }
  return levels;
}

/// Final values of what outlives the program, by name.
std::map<std::string_view, std::string_view> KeptValues(const DiffSide& side) {
  const ir::Module& module = side.set.module;
  const auto is_kept = [&](std::string_view name) {
    for (const ir::Space& space : module.spaces.All()) {
      const std::string_view prefix = module.View(space.name);
      if (space.lifetime != ir::Lifetime::kKept || !name.starts_with(prefix)) continue;
      std::uint32_t cell = 0;
      const char* const end = name.data() + name.size();
      const auto read = std::from_chars(name.data() + prefix.size(), end, cell);
      if (read.ec == std::errc{} && read.ptr == end && cell >= space.first && cell <= space.last) return true;
    }
    const std::string_view base = name.substr(0, name.find('['));
    return std::ranges::any_of(module.variables.All(), [&](const ir::Variable& variable) {
      const bool kept = variable.scope == ir::Scope::kChannel || variable.scope == ir::Scope::kGlobal;
      return kept && module.View(variable.name) == base;
    });
  };
  std::map<std::string_view, std::string_view> values;
  for (const exec::Event& event : side.trace.Events()) {
    if (event.kind == exec::EventKind::kSetVariable && is_kept(event.text)) values[event.text] = event.code;
  }
  return values;
}

/// The first variable that outlives the program and ends with another value, in plain words (contracts section 6).
std::optional<std::string> OtherFinalValue(const DiffSide& a, const DiffSide& b) {
  if (a.outcome != exec::Outcome::kEnded || b.outcome != exec::Outcome::kEnded) return std::nullopt;
  const auto here = KeptValues(a);
  auto there = KeptValues(b);
  const auto number = [](std::string_view text) { return std::strtod(std::string(text).c_str(), nullptr); };
  const auto nothing = [&](std::string_view text) {
    return text.empty() || text == "vacant" || text == "\"\"" || (text.front() != '"' && number(text) == 0);
  };
  const auto same = [&](std::string_view x, std::string_view y) {
    if (x == y || (x.empty() && nothing(y)) || (y.empty() && nothing(x))) return true;
    if (x.empty() || y.empty() || x == "vacant" || y == "vacant" || x.front() == '"' || y.front() == '"') return false;
    return std::fabs(number(x) - number(y)) <= 1e-6 * std::max({1.0, std::fabs(number(x)), std::fabs(number(y))});
  };
  const auto shown = [](std::string_view text) { return text.empty() ? std::string_view("it was") : text; };
  for (const auto& [name, value] : here) {
    const std::string_view other = there[name];
    if (!same(value, other))
      return fmt::format("{} ends as {} in the source, as {} in the target", name, value, shown(other));
  }
  for (const auto& [name, value] : there) {
    if (!here.contains(name) && !same({}, value))
      return fmt::format("{} ends as it was in the source, as {} in the target", name, value);
  }
  return std::nullopt;
}

}  // namespace

Status Diff(Context& context, const Input& a, const Input& b, const DiffOptions& options, DiffResult& result) {
  DiffSide source(options.max_events);
  DiffSide target(options.max_events);
  NCPORT_TRY(ReadSide(context, a, options.from_a, options, source));
  NCPORT_TRY(ReadSide(context, b, options.from_b, options, target));
  prove::CompareOptions compare;
  compare.source = {source.machine.word_error, source.set.profile.increment.Or(source.machine.increment),
                    source.machine.transverse_axis};
  compare.target = {target.machine.word_error, target.set.profile.increment.Or(target.machine.increment),
                    target.machine.transverse_axis};
  compare.maps.cross_language = source.set.profile.language != target.set.profile.language;
  compare.tolerance = options.tolerance;
  const bool same_language = !compare.maps.cross_language;
  // A flat form names the offset that the profile of its source starts with; of other programs it is the operator's.
  const auto is_flat = [](const DiffSide& side) { return side.set.profile.language == dialects::Language::kIso; };
  const ir::WorkOffset source_start = is_flat(target) && !is_flat(source) ? source.start_offset : ir::WorkOffset{};
  const ir::WorkOffset target_start = is_flat(source) && !is_flat(target) ? target.start_offset : ir::WorkOffset{};
  const auto added = [](const DiffSide& side) {
    const auto& events = side.trace.Events();
    return std::count_if(events.begin(), events.end(), [](const exec::Event& event) { return event.added; });
  };
  // `/` without a number is the first level of its control.
  const int shift = static_cast<int>(target.set.profile.skip.Or(0) - source.set.profile.skip.Or(0));
  const auto shifted = [](std::uint16_t levels, int by) {
    return static_cast<std::uint16_t>(by >= 0 ? levels << by : levels >> -by);
  };
  const auto levels =
      static_cast<std::uint16_t>(SkipLevelsOf(source.set.module) | shifted(SkipLevelsOf(target.set.module), -shift));
  std::string summary;
  std::vector<std::uint16_t> sets{0};
  for (unsigned level = 0; level < 16; ++level) {
    if ((levels >> level & 1U) != 0) sets.push_back(static_cast<std::uint16_t>(1U << level));
  }
  if (sets.size() > 2) sets.push_back(levels);
  for (const std::uint16_t on : sets) {
    NCPORT_TRY(RunSide(context, options, on, source));
    NCPORT_TRY(RunSide(context, options, shifted(on, shift), target));
    prove::Comparison comparison = prove::Compare(source.trace, target.trace, compare, target_start, source_start);
    if (!comparison.difference && same_language) {
      if (std::optional<std::string> other = OtherFinalValue(source, target))
        comparison.difference = prove::Difference{*std::move(other), {}, {}};
    }
    if (comparison.difference) {
      if (on != 0)
        comparison.difference->what +=
            on == levels ? " (blocks with / skipped)" : fmt::format(" (skip level {} on)", std::countr_zero(on));
      auto& finding = context.findings.Report(
          diag::Code::kTraceDiffers, PlaceOf(source, comparison.difference->source_block), comparison.difference->what);
      const SourceRange other = PlaceOf(target, comparison.difference->target_block);
      if (other.Valid()) finding.notes.push_back({other, "the other program is here"});
      return Failure{};
    }
    if (on != 0) continue;
    summary = fmt::format(
        "EQUAL: both programs make the machine do the same.\n"
        "  {} pairs of events compared, {} and {} events are of blocks marked as added\n"
        "  {} changes of a spindle stand on the other side of a rapid\n",
        comparison.events_compared, added(source), added(target), comparison.spindle_moved_across_rapid);
  }
  if (sets.size() > 1) summary += fmt::format("  also with blocks that have / skipped: {} ways\n", sets.size() - 1);
  result.summary = std::move(summary);
  return {};
}

}  // namespace ncport
