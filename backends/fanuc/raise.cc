#include "backends/fanuc/raise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "backends/fanuc/arrange_spindle.h"
#include "backends/fanuc/array_bounds.h"
#include "backends/fanuc/corners.h"
#include "backends/fanuc/dwells.h"
#include "backends/fanuc/frame_blocks.h"
#include "backends/fanuc/limit_m_words.h"
#include "backends/fanuc/limit_nesting.h"
#include "backends/fanuc/map_codes.h"
#include "backends/fanuc/mazak_lathe_rules.h"
#include "backends/fanuc/mill_tools.h"
#include "backends/fanuc/modal_calls.h"
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
#include "dialects/fanuc/words.h"
#include "dialects/machine.h"
#include "ir/block_words.h"
#include "ir/enum_names.h"
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

/// Numbers of the programs: those of [programs], the source's own where it is a number, else free ones.
bool NamePrograms(const RaiseInput& input, const SplitResult& split, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  std::set<std::string> taken;
  std::vector<std::string> names(module.programs.Size());
  const auto source_name = [&](ir::ProgramId program) {
    return std::string(module.View(module.programs[program].name));
  };
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (!names[program.value].empty()) continue;
    std::vector<ir::ProgramId> parts{program};
    for (const SplitProgram& whole : split.programs) {
      if (whole.whole == program) parts = whole.parts;
    }
    const dialects::ProgramMapping* mapping =
        input.config == nullptr ? nullptr : input.config->FindProgram(source_name(program));
    if (mapping == nullptr) continue;
    if (mapping->targets.size() < parts.size()) {
      sink.Report(diag::Code::kNotExpressible, mapping->at,
                  fmt::format("{} under one number: it is split at its tool changes", source_name(program)),
                  profile.name)
          .help = fmt::format("give {} numbers: {} = [4001, 4002]", parts.size(), source_name(program));
      ok = false;
      continue;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      names[parts[i].value] = mapping->targets[i];
      if (!taken.insert(mapping->targets[i]).second) {
        sink.Report(diag::Code::kDoubleName, mapping->at, mapping->targets[i]);
        ok = false;
      }
    }
  }
  std::uint32_t next_main = 1001;
  std::uint32_t next_sub = profile.names.macro_numbers.Known() ? profile.names.macro_numbers->first + 1 : 4001;
  for (const ir::ProgramId program : module.programs.Ids()) {
    std::string& name = names[program.value];
    if (!name.empty()) continue;
    const std::string source = source_name(program);
    const int letter = std::toupper(static_cast<unsigned char>(source.empty() ? ' ' : source[0]));
    const std::size_t digits = source.size() > 1 && (letter == 'L' || letter == 'O') ? 1 : 0;
    const bool numbered =
        source.find_first_not_of("0123456789", digits) == std::string::npos && source.size() - digits <= 4;
    if (numbered && !taken.contains(source.substr(digits)) && std::stoul(source.substr(digits)) != 0) {
      name = std::to_string(std::stoul(source.substr(digits)));
    }
    std::uint32_t& next = module.programs[program].kind == ir::ProgramKind::kMain ? next_main : next_sub;
    while (name.empty()) {
      const std::string wish = std::to_string(next++);
      if (!taken.contains(wish)) name = wish;
    }
    taken.insert(name);
  }
  for (const bool main : {true, false}) {
    for (const ir::ProgramId program : module.programs.Ids()) {
      if ((module.programs[program].kind == ir::ProgramKind::kMain) != main) continue;
      ir::ProgramId whole = program;
      for (const SplitProgram& cut : split.programs) {
        if (std::find(cut.parts.begin(), cut.parts.end(), program) != cut.parts.end()) whole = cut.whole;
      }
      out.programs.push_back({program, source_name(program), names[program.value], main, whole});
    }
  }
  for (const ProgramName& name : out.programs) module.programs[name.program].name = module.strings.Intern(name.target);
  return ok;
}

/// What [ranges] promises of parameters, where both ends are numbers.
std::vector<ir::analysis::DeclaredRange> DeclaredRanges(const RaiseInput& input, const Module& module) {
  std::vector<ir::analysis::DeclaredRange> declared;
  if (input.config == nullptr) return declared;
  const auto same = [](std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) {
      return std::toupper(static_cast<unsigned char>(x)) == std::toupper(static_cast<unsigned char>(y));
    });
  };
  for (const dialects::ValueRange& range : input.config->ranges) {
    if (!range.least_of.empty() || !range.most_of.empty()) continue;
    for (const ir::VariableId id : module.variables.Ids()) {
      const ir::Variable& variable = module.variables[id];
      if (variable.scope != ir::Scope::kParameter || !variable.owner.Valid()) continue;
      const std::string name =
          fmt::format("{}.{}", module.View(module.programs[variable.owner].name), module.View(variable.name));
      if (same(range.name, name)) declared.push_back({id, range.least, range.most});
    }
  }
  return declared;
}

/// Without brackets and conversions that change nothing.
ir::ExprId BareValue(const Module& module, ir::ExprId id) {
  while (module.exprs[id].op == ir::ExprOp::kGroup || module.exprs[id].op == ir::ExprOp::kPlus ||
         module.exprs[id].op == ir::ExprOp::kConvert)
    id = ir::ExprId{module.exprs[id].a};
  return id;
}

/// What is left must have a form in the target.
bool CheckLegal(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  const auto system = *dialects::fanuc::SystemOf(profile);
  bool ok = true;
  std::set<std::string> asked;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const auto refuse = [&](const Word& word, std::string_view what) -> diag::Diagnostic& {
        ok = false;
        return sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), what, profile.name);
      };
      // A setting that the profile leaves open is named once.
      const auto need = [&](const auto& setting, const Word& word) {
        if (setting.Known()) return;
        ok = false;
        if (asked.insert(std::string(setting.Key())).second)
          static_cast<void>(dialects::Need(profile, setting, module.RangeOf(block, word), sink));
      };
      if ((block.flags & ir::Block::kRefused) != 0) {
        ok = false;
        continue;  // has its finding already
      }
      for (const ir::WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        const auto values = [&](ir::ExprId value) {
          VisitReads(module, value, [&](ir::ExprId read) {
            const ir::Expr& expr = module.exprs[read];
            if (expr.op != ir::ExprOp::kSystem) return;
            const ir::System& system = module.systems[ir::SystemId{expr.a}];
            diag::Diagnostic& finding = refuse(word, module.View(system.name));
            if (system.kind == ir::SystemKind::kActiveFeed)
              finding.help = "where F is one number on every way to this block, that number stands for it";
          });
        };
        values(word.value);
        if (word.op == WordOp::kAssign) values(word.Extra<ir::ExprId>());
        if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<ir::CallId>().Valid()) {
          values(module.calls[word.Extra<ir::CallId>()].passes);
          for (const ir::ArgId arg : module.calls[word.Extra<ir::CallId>()].args) values(module.args[arg].value);
        }
        const bool whole_only = word.op == WordOp::kSpeed || word.op == WordOp::kRadiusOffset ||
                                word.op == WordOp::kLengthOffset || word.op == WordOp::kAux;
        if (whole_only && word.value.Valid()) {
          const ir::Expr& value = module.exprs[BareValue(module, word.value)];
          if (value.op == ir::ExprOp::kLiteral && value.number != std::floor(value.number)) {
            ok = false;
            sink.Report(diag::Code::kWordTooCoarse, module.RangeOf(block, word), fmt::format("{:g}", value.number),
                        "whole number");
          }
        }
        const auto named = [&] {
          if (word.op == WordOp::kMotion && word.spelling == 0)
            return fmt::format("the motion mode {}", ir::NameOf(static_cast<ir::Motion>(word.index)));
          return word.spelling != 0 ? std::string(module.View(module.spellings[word.spelling].text))
                                    : std::string(ir::NameOf(word.op));
        };
        switch (word.op) {
          case WordOp::kAssign:
          case WordOp::kWhile:
          case WordOp::kEndWhile:
          case WordOp::kJump:
          case WordOp::kWhen:
          case WordOp::kAlarm:
          case WordOp::kCenter:
          case WordOp::kRadius:
          case WordOp::kFeed:
          case WordOp::kStartAngle:
          case WordOp::kSpeed:
          case WordOp::kRadiusOffset:
          case WordOp::kAux:
          case WordOp::kChamfer:  // MapCorners left those only that the target has
            break;
          case WordOp::kSpeedLimit:
            need(profile.spindle.limit, word);
            break;
          case WordOp::kProgramEnd:
            need(profile.words.end, word);
            break;
          case WordOp::kFrame:  // G52, G68, G69; all others were refused
          case WordOp::kFrameAngle:
            break;
          case WordOp::kReturn:
            need(profile.words.sub_end, word);
            if (word.value.Valid()) refuse(word, "a return to a label of the caller");
            break;
          case WordOp::kInert:
            // Made by a pass of this target, or a word of the source that has no effect here: that one is not carried
            // over.
            if (word.spelling != 0 && module.View(module.spellings[word.spelling].rule).empty()) break;
            refuse(word, named());
            break;
          case WordOp::kAxis:
            if (word.index >= ir::kLetterAxes) {
              refuse(word, "an axis with a name of its own");
            } else if (word.mode == ir::ValueMode::kIncremental && !HasIncrementLetter(profile, word.index)) {
              refuse(word, "an increment of one axis");
            }
            break;
          case WordOp::kCall:
          case WordOp::kModalCall: {
            const auto call = word.Extra<ir::CallId>();
            if (!call.Valid()) break;
            if (module.calls[call].program.Valid()) break;
            const ir::ExprId name = module.calls[call].name_expr;
            const bool text = name.Valid() && module.exprs[name].op == ir::ExprOp::kText;
            ok = false;
            sink.Report(diag::Code::kUnknownProgram, module.RangeOf(block, word),
                        module.View(text ? StringId{std::size_t{module.exprs[name].a}} : module.calls[call].name));
            break;
          }
          case WordOp::kSpindle:
            if (word.extra == static_cast<std::uint32_t>(ir::SpindleState::kPositioned)) {
              refuse(word, named());
            } else {
              const auto state = static_cast<ir::SpindleState>(word.extra);
              const auto& words = profile.spindle;
              need(state == ir::SpindleState::kCw    ? words.cw
                   : state == ir::SpindleState::kCcw ? words.ccw
                                                     : words.stop,
                   word);
            }
            break;
          case WordOp::kDwellSeconds:
            need(profile.words.dwell, word);
            break;
          default: {
            const std::uint32_t extra = word.op == WordOp::kWorkOffset ? word.extra : Id<void>::kNone;
            if (dialects::fanuc::Codes(system).FindMeaning(word.op, word.index, extra) == nullptr)
              refuse(word, named());
          }
        }
      }
    }
  }
  return ok;
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
  ok = NamePrograms(input, split, out, sink);
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
