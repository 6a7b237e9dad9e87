#include "backends/sinumerik/raise.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/sinumerik/legal_check.h"
#include "backends/sinumerik/map_frames.h"
#include "backends/sinumerik/map_tools.h"
#include "backends/sinumerik/raise_words.h"
#include "backends/sinumerik/refuse_flow.h"
#include "base/letter_case.h"
#include "dialects/sinumerik/words.h"
#include "ir/analysis/call_graph.h"
#include "ir/builder.h"
#include "ir/transform/adapt_expressions.h"
#include "ir/transform/conditional_blocks.h"
#include "ir/transform/expand_cycles.h"
#include "ir/transform/lower_vacant_values.h"
#include "ir/transform/numbers_to_names.h"
#include "ir/transform/polar_mode.h"
#include "ir/transform/resolve_increments.h"
#include "ir/transform/resolve_jumps.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/transform/round_words.h"
#include "ir/transform/split_statements.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordOp;
using namespace ir::transform;

constexpr std::string_view kLabelPrefix = "U_L";  // sinumerik-12.1

/// "#100" or "R10" -> 100, 10.
bool CellNumber(std::string_view text, char space, std::uint32_t& cell) {
  if (text.empty() || text[0] != space) return false;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data() + 1, end, cell);
  return error == std::errc{} && last == end;
}

/// Names of the programs: those of [programs], else the source's where the target can say it, else one made from its
/// number: MAIN_1 from O1, SUB_4001 from O4001. An L name would do, but not with parameters behind it (sinumerik-7.1).
bool NamePrograms(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  std::set<std::string> taken;
  std::vector<std::string> names(module.programs.Size());
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    const std::string source(module.View(module.programs[program].name));
    const dialects::ProgramMapping* mapping = input.config == nullptr ? nullptr : input.config->FindProgram(source);
    if (mapping == nullptr) continue;
    names[program.value] = mapping->targets.front();
    if (!taken.insert(mapping->targets.front()).second || mapping->targets.size() != 1) {
      sink.Report(diag::Code::kDoubleName, mapping->at, mapping->targets.front());
      ok = false;
    }
  }
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto most = static_cast<std::size_t>(input.profile->names.programs.Or(24));
  for (const ir::ProgramId program : module.programs.Ids()) {
    std::string& name = names[program.value];
    if (!name.empty()) continue;
    const std::string source(module.View(module.programs[program].name));
    const bool main = module.programs[program].kind == ir::ProgramKind::kMain;
    std::string wish;
    for (const char c : source) {
      if (is_letter(c) || is_digit(c)) wish += c;
    }
    const std::size_t digits = wish.find_first_of("0123456789");
    if (wish.size() < 2 || !is_letter(wish[0]) || !is_letter(wish[1])) {
      wish = std::string(main ? "MAIN_" : "SUB_") + (digits == std::string::npos ? wish : wish.substr(digits));
    }
    if (dialects::sinumerik::IsReserved(UpperOf(wish))) wish = "U_" + wish;
    if (wish.size() > most) wish.resize(most);
    name = wish;
    for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", wish.substr(0, most - 4), n);
  }
  for (const bool main : {true, false}) {
    for (const ir::ProgramId program : module.programs.Ids()) {
      if ((module.programs[program].kind == ir::ProgramKind::kMain) != main) continue;
      out.programs.push_back(
          {program, std::string(module.View(module.programs[program].name)), names[program.value], main, program});
    }
  }
  for (const ProgramName& name : out.programs) module.programs[name.program].name = module.strings.Intern(name.target);
  for (ir::Call& call : module.calls.All()) {
    if (call.program.Valid()) call.name = module.programs[call.program].name;
  }
  return ok;
}

/// System variables that have a counterpart; others are known only to their machine.
bool MapSystemVariables(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  ir::ExprBuilder make(module);
  ir::SystemId position;
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    std::set<std::uint32_t> refused;
    RewriteProgram(module, program, [&](Module& m, ExprId id) {
      const ir::Expr expr = m.exprs[id];
      if (expr.op != ExprOp::kSystem) return id;
      const ir::System system = m.systems[ir::SystemId{std::size_t{expr.a}}];
      if (m.View(system.name).starts_with("$")) return id;
      if (system.kind == ir::SystemKind::kProgrammedPosition && expr.count == 1) {
        if (!position.Valid()) position = ir::AddSystem(module, "$P_EP", ir::SystemKind::kProgrammedPosition);
        const auto axis = static_cast<std::uint8_t>(m.exprs[m.Item(expr.b)].a);
        const ExprId read = make.System(position, {make.AxisName(axis)});
        const bool diameter =
            input.source_machine->position_reads_diameter && axis == input.source_machine->transverse_axis;
        // $P_EP is a radius (sinumerik-8.5 names diameters for $AA_IW only); the card has no row that says so.
        constexpr std::string_view kAssumed =
            "$P_EP of the transverse axis is a radius under diameter programming too: check it on the control";
        if (diameter && std::ranges::find(out.assumptions, kAssumed) == out.assumptions.end())
          out.assumptions.emplace_back(kAssumed);
        return diameter ? make.Unary(ExprOp::kGroup, make.Binary(ExprOp::kMultiply, make.Number("2"), read)) : read;
      }
      refused.insert(id.value);
      return id;
    });
    if (refused.empty()) continue;
    for (const ir::BlockId block : module.programs[program].blocks) {
      for (const ir::WordId word_id : module.blocks[block].words) {
        const Word& word = module.words[word_id];
        const auto look = [&](ExprId root) {
          RewriteExpr(module, root, [&](Module& m, ExprId id) {
            if (refused.contains(id.value)) {
              ok = false;
              sink.Report(diag::Code::kNotExpressible, m.RangeOf(m.blocks[block], word),
                          fmt::format("the system variable {}",
                                      m.View(m.systems[ir::SystemId{std::size_t{m.exprs[id].a}}].name)),
                          input.profile->name);
            }
            return id;
          });
        };
        look(word.value);
        if (word.op == WordOp::kAssign) look(word.Extra<ExprId>());
      }
    }
  }
  return ok;
}

NumbersToNamesConfig CellConfig(const RaiseInput& input, const VacantValuesResult& empty) {
  NumbersToNamesConfig config;
  config.letter_of = input.argument_letter;
  for (const dialects::VariableSpace& space : input.profile->variables) {
    if (space.name == config.space) config.cells = {space.range.first, space.range.last};
  }
  if (input.config != nullptr) {
    for (const dialects::WordMapping& pin : input.config->variables) {
      NumbersToNamesConfig::Pin made;
      if (CellNumber(pin.source, '#', made.source) && CellNumber(pin.target, 'R', made.target))
        config.pins.push_back(made);
    }
  }
  config.read_at_entry = empty.read_at_entry;
  config.written_at_end = empty.written_at_end;
  return config;
}

/// Letters whose absence the output would not notice.
void TellTakenForGiven(const RaiseInput& input, const VacantValuesResult& empty, Translation& out) {
  std::map<ir::ProgramId, std::string> letters;
  for (const auto& [program, cell] : empty.taken_for_given)
    letters[program] += fmt::format(" {}", input.argument_letter(cell));
  for (const auto& [program, names] : letters) {
    out.assumptions.push_back(fmt::format("every call of {} gives{}: the program does not ask whether it has them",
                                          out.module.View(out.module.programs[program].name), names));
  }
}

/// Common cells that are read as they were before the run: they are other memory on the target, and volatile ones are
/// empty after power-on and reset, which no R parameter ever is.
void TellReadAtEntry(const VacantValuesResult& empty, Translation& out) {
  constexpr std::uint32_t kFirstVolatile = 100, kLastVolatile = 199;  // fanuc-3.1
  std::string cells, volatile_cells;
  for (const CellMapping& cell : out.cells) {
    if (!cell.common || !empty.common_at_entry.contains(cell.source_cell)) continue;
    const bool is_volatile = cell.source_cell >= kFirstVolatile && cell.source_cell <= kLastVolatile;
    std::string& text = is_volatile ? volatile_cells : cells;
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", cell.target, cell.source);
  }
  if (!volatile_cells.empty()) {
    out.assumptions.push_back(fmt::format(
        "read before written: {}: set them before the run, the source control may empty these at power-on and "
        "reset (0 in arithmetic), R parameters keep their values (fanuc-3.1, sinumerik-3.1)",
        volatile_cells));
  }
  if (!cells.empty()) {
    out.assumptions.push_back(fmt::format(
        "read before written: {}: set them before the run to what the source control holds (fanuc-3.1)", cells));
  }
}

/// Values that the compiler made are printed like any other.
void ShowImplied(Module& module) {
  for (ir::Expr& expr : module.exprs.All()) {
    if (expr.op != ExprOp::kConvert) expr.flags = static_cast<std::uint8_t>(expr.flags & ~ir::Expr::kImplicit);
  }
}

/// Brackets around a whole value: the source needs them, here they only stand in the way.
void DropOuterBrackets(Module& module) {
  for (Word& word : module.words.All()) {
    while (word.value.Valid() && module.exprs[word.value].op == ExprOp::kGroup)
      word.value = ExprId{std::size_t{module.exprs[word.value].a}};
  }
}

/// `/` without a number is the first level: 1 there, 0 here (sinumerik-1.3).
void ShiftSkipLevels(const RaiseInput& input, Module& module) {
  const std::int64_t shift = input.profile->skip.Or(0) - input.source_profile->skip.Or(0);
  for (ir::Block& block : module.blocks.All()) {
    if (block.skip_level == ir::Block::kNoSkip) continue;
    block.skip_level = static_cast<std::uint8_t>(std::max<std::int64_t>(0, block.skip_level + shift));
    block.flags = static_cast<std::uint8_t>(block.flags & ~ir::Block::kSkipDigit);
  }
}

/// The smaller controls have no structures, parameters or names (sinumerik-11), and between a mill and a lathe the same
/// word means another axis, plane and tool change: those ways are not built.
bool CanWrite(const RaiseInput& input, bool same_language, diag::Sink& sink) {
  using Settings = dialects::SinumerikSettings;
  const bool full = input.profile->sinumerik.family.Is(Settings::Family::k840D);
  const bool same_family = same_language && full && input.source_profile->sinumerik.family.Is(Settings::Family::k840D);
  const bool same_machine = input.source_profile->machine == input.profile->machine;
  if (full && same_machine && (!same_language || same_family)) return true;
  auto& finding = sink.Report(diag::Code::kNotExpressible, SourceRange{},
                              same_machine ? "a program with loops, calls and variables"
                                           : "a program of a mill on a lathe, or of a lathe on a mill,",
                              input.profile->name);
  finding.help = "ncport flatten writes programs of literal blocks";
  return false;
}

/// The same language: the text stays as it is.
bool Copy(Translation& out) {
  const Module& module = out.module;
  bool ok = true;
  for (const bool main : {true, false}) {
    for (const ir::ProgramId program : module.programs.Ids()) {
      const ir::Program& record = module.programs[program];
      if (record.library || (record.kind == ir::ProgramKind::kMain) != main) continue;
      const std::string name(module.View(record.name));
      out.programs.push_back({program, name, name, main, program});
      for (const ir::BlockId block : record.blocks)
        ok = ok && (module.blocks[block].flags & ir::Block::kRefused) == 0;  // those have their findings
    }
  }
  out.keeps_files = true;
  return ok;
}

}  // namespace

bool Raise(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  out.module = *input.source;
  const bool same_language = input.source_profile->language == input.profile->language;
  if (!CanWrite(input, same_language, sink)) return false;
  if (same_language) {
    if (!Copy(out)) return false;
    WriteStartModes(input, out, true);
    return true;
  }
  Module& module = out.module;
  const ir::Machine& machine = *input.source_machine;
  const ir::ModalState entry = input.SubEntry();

  bool ok = RefuseFlow(input, module, sink);
  ok = ArrangeTexts(input, out, sink) && ok;
  // While the source's modes and flags still stand in the words: numbers in their units, rounding where it counts.
  ok = ResolveIncrements(module, machine, entry, sink) && ok;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ConditionalBlocks(module, program, kLabelPrefix);
    SplitStatements(module, program);
  }
  ok = RoundWords(module, machine, entry, sink) && ok;
  ok = MapTools(input, out, sink) && ok;
  ok = ArrangeWords(input, out, sink) && ok;
  ok = MapOffsets(input, out, sink) && ok;
  ok = MapAuxiliaries(input, out, sink) && ok;
  ok = MapSystemVariables(input, out, sink) && ok;
  if (!ok) {
    // Words without a form are named in the same run; what expressions become is not known yet.
    static_cast<void>(CheckLegal(input, module, false, sink));
    return false;
  }

  // Jumps before emptiness: that pass makes blocks, and only the source's own text decides where a jump goes.
  for (const ir::ProgramId program : module.programs.Ids())
    ok = ResolveJumps(module, program, kLabelPrefix, sink) && ok;
  ir::analysis::VacancyConfig empty_config;
  if (input.config != nullptr) {
    empty_config.holds_number = [&](std::uint32_t cell) {
      const std::string name = fmt::format("#{}", cell);
      return std::any_of(input.config->ranges.begin(), input.config->ranges.end(),
                         [&](const dialects::ValueRange& range) { return range.name == name; });
    };
    empty_config.given = [&](ir::ProgramId program, std::uint32_t cell) {
      const char letter = input.argument_letter != nullptr ? input.argument_letter(cell) : '\0';
      if (letter == 0) return false;
      const std::string name = fmt::format("{}.{}", module.View(module.programs[program].name), letter);
      const auto is_declared = [&](const dialects::ValueRange& range) { return range.name == name; };
      return std::ranges::any_of(input.config->ranges, is_declared) ||
             std::ranges::find(input.config->given, name) != input.config->given.end();
    };
  }
  const VacantValuesResult empty = LowerVacantValues(module, machine, empty_config, sink);
  ok = empty.ok && ok;
  if (!ok) return false;
  TellTakenForGiven(input, empty, out);
  if (!LowerPolarMode(module, machine, entry, sink)) return false;
  if (!MapFrames(input, out, sink)) return false;
  ExpandCyclesConfig cycles;
  cycles.sub_entry = entry;
  cycles.position = ir::AddSystem(module, "$P_EP", ir::SystemKind::kProgrammedPosition);
  if (!input.source_profile->IsLathe() && !ExpandCycles(module, machine, cycles, sink)) return false;
  if (!SettleArcs(input, out, sink)) return false;

  AdaptExpressionsConfig expressions;
  expressions.relative_comparisons = true;
  expressions.positive_angles = false;
  expressions.has_atan = false;
  expressions.has_round_away = false;
  expressions.has_round_to_increment = false;
  expressions.modulo_rounds_operands = false;
  expressions.increment = machine.increment;
  for (const ir::ProgramId program : module.programs.Ids()) AdaptExpressions(module, program, expressions);
  ShowImplied(module);
  DropOuterBrackets(module);
  ok = NamePrograms(input, out, sink);
  WriteStartModes(input, out, false);
  NumbersToNamesResult names = NumbersToNames(module, CellConfig(input, empty), sink);
  out.cells = std::move(names.map);
  TellReadAtEntry(empty, out);
  ok = names.ok && CheckLegal(input, module, true, sink) && ok;  // while words still have the names of the source
  DropSpellings(out);
  ShiftSkipLevels(input, module);
  return ok;
}

}  // namespace ncport::backends::sinumerik
