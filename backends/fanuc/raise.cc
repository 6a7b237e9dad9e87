#include "backends/fanuc/raise.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "backends/fanuc/arrange_spindle.h"
#include "backends/fanuc/array_bounds.h"
#include "backends/fanuc/corners.h"
#include "backends/fanuc/dwells.h"
#include "backends/fanuc/frame_blocks.h"
#include "backends/fanuc/legal_check.h"
#include "backends/fanuc/limit_m_words.h"
#include "backends/fanuc/limit_nesting.h"
#include "backends/fanuc/map_codes.h"
#include "backends/fanuc/mazak_lathe_rules.h"
#include "backends/fanuc/mill_tools.h"
#include "backends/fanuc/modal_calls.h"
#include "backends/fanuc/program_numbers.h"
#include "backends/fanuc/raise_words.h"
#include "backends/fanuc/references.h"
#include "backends/fanuc/refuse_functions.h"
#include "backends/fanuc/repeat_counts.h"
#include "backends/fanuc/rotations.h"
#include "backends/fanuc/shifts.h"
#include "backends/fanuc/source_meanings.h"
#include "backends/fanuc/text_values.h"
#include "backends/fanuc/thread_leads.h"
#include "backends/fanuc/turning_offsets.h"
#include "backends/fanuc/turret_tools.h"
#include "backends/fanuc/word_digits.h"
#include "base/letter_case.h"
#include "dialects/fanuc/words.h"
#include "dialects/machine.h"
#include "ir/block_words.h"
#include "ir/transform/absolute_dimensions.h"
#include "ir/transform/feeds_to_numbers.h"
#include "ir/transform/fixed_indices.h"
#include "ir/transform/join_tests.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/lower_expressions.h"
#include "ir/transform/names_to_numbers.h"
#include "ir/transform/part_ends.h"
#include "ir/transform/resolve_axes.h"
#include "ir/transform/resolve_increments.h"
#include "ir/transform/save_to_restores.h"
#include "ir/transform/specialize_programs.h"
#include "ir/transform/split_at_tool_change.h"
#include "ir/transform/split_statements.h"
#include "ir/transform/structure_to_jumps.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Module;
using ir::Word;
using ir::WordOp;
using namespace ir::transform;

NamesToNumbersConfig CellConfig(const RaiseInput& input, const SplitResult& split) {
  NamesToNumbersConfig config;
  config.modal_keeps_locals = input.source_machine->modal_call_keeps_locals;
  for (const SplitProgram& whole : split.programs) config.parts.push_back(whole.parts);
  // Letters that travel plainly on all controls of the family: no I J K (list II), no G L N O P, no M S T
  // (mazak-lathe-10.1).
  for (const char letter : std::string_view("ABCDEHQRUVWXYZ"))
    config.letters.push_back({letter, dialects::fanuc::ArgumentCell(letter)});
  config.feed_letter = {'F', dialects::fanuc::ArgumentCell('F')};
  for (const dialects::NumberRange& range : dialects::fanuc::FreeLocals()) {
    for (std::uint32_t cell = range.first; cell <= range.last; ++cell) config.free_locals_first.push_back(cell);
  }
  for (const dialects::ScratchRange& range : input.profile->scratch)
    config.scratch.push_back({range.range.first, range.range.last});
  if (input.config != nullptr) {
    for (const dialects::WordMapping& pin : input.config->variables) {
      std::uint32_t cell = 0;
      const char* first = pin.target.data() + (pin.target.starts_with('#') ? 1 : 0);
      if (std::from_chars(first, pin.target.data() + pin.target.size(), cell).ec == std::errc{})
        config.pins.push_back({pin.source, cell});
    }
  }
  return config;
}

/// What [ranges] promises of parameters, where both ends are numbers.
std::vector<ir::analysis::DeclaredRange> DeclaredRanges(const RaiseInput& input, const Module& module) {
  std::vector<ir::analysis::DeclaredRange> declared;
  if (input.config == nullptr) return declared;
  for (const dialects::ValueRange& range : input.config->ranges) {
    if (!range.least_of.empty() || !range.most_of.empty()) continue;
    for (const ir::VariableId id : module.variables.Ids()) {
      const ir::Variable& variable = module.variables[id];
      if (variable.scope != ir::Scope::kParameter || !variable.owner.Valid()) continue;
      const std::string name =
          fmt::format("{}.{}", module.View(module.programs[variable.owner].name), module.View(variable.name));
      if (EqualIgnoringCase(range.name, name)) declared.push_back({id, range.least, range.most});
    }
  }
  return declared;
}

/// Modes that a target without words for them has always: the words go.
void DropForeignModes(const RaiseInput& input, Translation& out) {
  Module& module = out.module;
  const auto system = *dialects::fanuc::SystemOf(*input.profile);
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      ir::Block& block = module.blocks[id];
      std::vector<Word> kept;
      for (const ir::WordId word_id : block.words) {
        const Word word = module.words[word_id];
        // Exact stop and path control are a listed loss where the target has no word (contracts section 3).
        const bool path = word.op == WordOp::kPathMode || word.op == WordOp::kExactOnce;
        // The code of a dwell: the target's words for the seconds have their own.
        if (word.op == WordOp::kInert && word.phase == ir::Phase::kMotion &&
            ir::HasWord(module, block, WordOp::kDwellSeconds))
          continue;
        const bool known = dialects::fanuc::Codes(system).FindMeaning(word.op, word.index) != nullptr;
        if (path && !known) {
          out.path_lost = true;
          out.losses.push_back({module.RangeOf(block, word), "path mode", true});
        } else {
          kept.push_back(word);
        }
      }
      if (kept.size() == block.words.count) continue;
      ir::SetWords(module, block, kept);
    }
  }
}

/// The words of the target that a kept increment can have.
void ChooseKeptIncrements(const RaiseInput& input, AbsoluteDimensionsConfig& dimensions) {
  if (!input.keep_increments) return;
  const dialects::Profile& profile = *input.profile;
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if (HasIncrementLetter(profile, axis))
      dimensions.keep_axes = static_cast<std::uint16_t>(dimensions.keep_axes | (1U << axis));
  }
  const auto system = *dialects::fanuc::SystemOf(profile);
  const auto incremental = static_cast<std::uint8_t>(ir::Distance::kIncremental);
  if (dimensions.keep_axes != 0) {
    dimensions.keep = KeepIncrements::kAxes;
  } else if (dialects::fanuc::Codes(system).FindMeaning(WordOp::kDistance, incremental) != nullptr) {
    dimensions.keep = KeepIncrements::kBlocks;
  }
  const ir::Machine target = dialects::MachineFor(profile);
  dimensions.word_error = target.word_error;
  dimensions.increment = profile.increment.Or(target.increment);
}

void TellKeptIncrements(const KeptIncrements& kept, Translation& out) {
  if (kept.drifting != 0)
    out.assumptions.push_back(
        fmt::format("{} of {} kept increments are rounded each time they run: what they add up to may drift",
                    kept.drifting, kept.words));
  std::string programs;
  for (const ProgramName& name : out.programs) {
    if (std::ranges::find(kept.started, name.program) == kept.started.end()) continue;
    programs += (programs.empty() ? "" : " ") + name.target;
  }
  if (programs.empty()) return;
  out.required.push_back(fmt::format(
      "CALLS OF {} BEHIND A MOVE OF THE SAME TOOL IN THE SAME COORDINATES: THEY START WITH INCREMENTS", programs));
}

/// A program that takes its position from cells cuts elsewhere when somebody else calls it.
void TellCarriedPositions(const CarriedPositions& carried, Translation& out) {
  if (carried.programs.empty()) return;
  std::string programs, cells;
  for (const ProgramName& name : out.programs) {
    if (std::ranges::find(carried.programs, name.program) == carried.programs.end()) continue;
    programs += (programs.empty() ? "" : " ") + name.target;
  }
  for (const CellMapping& cell : out.cells) {
    if (std::ranges::find(carried.cells, cell.source_space) == carried.cells.end()) continue;
    cells += (cells.empty() ? "" : " ") + cell.target;
  }
  out.required.push_back(fmt::format("CALLS OF {} ONLY AS THEY STAND HERE: {} HOLD THE POSITION", programs, cells));
}

}  // namespace

bool Raise(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const dialects::Profile& profile = *input.profile;
  if (!dialects::fanuc::SystemOf(profile).has_value()) {
    return dialects::Need(profile, profile.series, {}, sink);
  }
  out.module = *input.source;
  Module& module = out.module;
  const ir::Machine& machine = *input.source_machine;
  const ir::ModalState entry = input.SubEntry();

  const bool framed = NeedFrame(input, sink);
  // Another Fanuc control's X100 is 0.1 mm: the value, since here every number gets its point.
  const bool in_units = ResolveIncrements(module, machine, entry, sink);
  // Here every cycle has one text for all its calls, behind specialisation one for each kind of call.
  if (input.source_profile != nullptr && input.source_profile->language != profile.language) {
    FeedsToNumbers(module, machine, entry);
    SpecializePrograms(module, machine, entry);
    FeedsToNumbers(module, machine, entry);
  } else {
    SpecializePrograms(module, machine, entry);
  }
  bool forms = MapModalCalls(input, module, sink);
  forms = RefuseOpenIndices(input, module, sink) && forms;
  const std::vector<ir::analysis::DeclaredRange> declared = DeclaredRanges(input, module);
  forms = RefuseOpenRepeats(input, module, declared, sink) && forms;
  ResolveAxes(module, input.Analyse(module).Modal());
  // Before a pass puts blocks behind the last one of a part that is repeated.
  for (const ir::ProgramId program : module.programs.Ids()) MarkPartEnds(module, program);
  TextsToComments(input, out, sink);
  EndsToReturns(input, module);
  PiToNumber(module);
  if (!ShiftSkipLevels(input, module, sink)) return false;
  // Cells of a source of the family keep their numbers, computed or not.
  if (input.source_profile != nullptr && input.source_profile->language != profile.language)
    FixIndices(module, machine);
  bool ok = RefuseInputs(input, out, sink) && in_units && forms;
  ok = RefuseTexts(input, module, sink) && ok;
  ok = RefuseRepeatedCalls(input, module, sink) && ok;
  ok = SaveToRestores(module, machine, entry, sink) && ok;
  for (const ir::ProgramId program : module.programs.Ids()) SplitStatements(module, program);
  // Programs are split before positions are followed: a position does not cross a tool change.
  SplitResult split;
  if (profile.IsMazakLathe()) {
    split = SplitAtToolChange(module, sink);
    ok = split.ok && ok;
  }
  if (!ok) return false;
  // While the source's modes still stand in the blocks: words that name what the target must be told.
  ok = MapCorners(input, out, sink) && ok;
  ok = MapDwells(input, out, sink) && ok;
  NameMotions(input, out);
  ok = ArrangeSpindle(input, out, sink) && ok;
  ok = (profile.IsLathe() ? MapTurretTools(input, out, sink) : MapMillTools(input, out, sink)) && ok;
  const bool native = RotationsAreNative(input, out);
  const bool worked_in = !native && FramesAreWorkedIn(input, out);
  FramesToComments(out, worked_in);
  if (native) RotationsToNative(input, out);
  if (!native && !worked_in) ok = ShiftsToLocal(input, out, sink) && ok;
  ok = MapAlarms(input, out, sink) && ok;
  AbsoluteDimensionsConfig dimensions;
  dimensions.diameter_axis = profile.diameter.Is(dialects::DiameterRule::kYes) ? 0 : 0xFF;
  dimensions.sub_entry = entry;
  dimensions.target = profile.name;
  dimensions.declared = DeclaredRanges(input, module);
  dimensions.work_frames_in = worked_in;
  dimensions.corners_to_moves = CornersToMoves(profile);
  for (const ir::ProgramId program : input.source->programs.Ids()) {
    const bool split_up = std::ranges::any_of(split.programs, [&](const auto& p) { return p.whole == program; });
    dimensions.frames.restores.push_back(input.source->programs[program].saves_modal_state && !split_up);
  }
  ChooseKeptIncrements(input, dimensions);
  CarriedPositions carried;
  KeptIncrements kept;
  ok = AbsoluteDimensions(module, machine, dimensions, sink, &carried, &kept) && ok;
  ReferencesToSteps(input, out);
  ok = ThreadLeads(input, out, sink) && ok;
  ok = StartAngles(out, sink) && ok;
  ok = RoundFeeds(input, out, sink) && ok;  // while the blocks still say which of them are threads
  ok = NameTurningOffsets(input, out, sink) && ok;
  ok = MapWorkOffsets(input, out, sink) && ok;
  ok = MapAuxiliaries(input, out, sink) && ok;
  DropForeignModes(input, out);
  if (!ok) return false;

  // Expressions before structure: a test that needs statements makes IF blocks; structure before names: it makes
  // locals.
  for (const ir::ProgramId program : module.programs.Ids()) {
    JoinTests(module, program);
    LowerExpressionsConfig expressions;
    expressions.compare_tolerance = machine.compare_tolerance;
    expressions.for_counter_rounds = machine.for_counter_rounds;
    ok = LowerExpressions(module, program, expressions, sink) && ok;
    StructureToJumpsConfig structure;
    structure.loop_depth = static_cast<std::uint32_t>(std::min<std::int64_t>(profile.nesting.loop.Or(3), 3));
    if (profile.names.block_numbers.Known()) structure.last_number = profile.names.block_numbers->last;
    ok = StructureToJumps(module, program, structure, sink) && ok;
    LimitNesting(module, program, static_cast<int>(profile.nesting.brackets.Or(5)));
  }
  if (!ok) return false;
  NamesToNumbersResult names = NamesToNumbers(module, CellConfig(input, split), sink);
  out.cells = std::move(names.map);
  if (!names.ok) return false;
  ok = NumberPrograms(input, split, out, sink);
  if (ok) TellCarriedPositions(carried, out);
  TellKeptIncrements(kept, out);
  GuardMacros(input, out);
  if (framed) {
    ok = FrameToolChanges(input, out, sink) && ok;
    FrameMainPrograms(input, out);
  }
  LimitMWords(input, out);  // behind all that makes blocks
  ok = CheckLegal(input, out, sink) && ok && framed;
  ok = RefuseFunctions(input, module, sink) && ok;
  ok = ok && CheckDigits(input, out, sink);
  if (ok && profile.IsMazakLathe()) ok = CheckMazakLathe(input, out, sink);
  return ok;
}

}  // namespace ncport::backends::fanuc
