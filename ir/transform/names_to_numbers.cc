#include "ir/transform/names_to_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/builder.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

bool SameName(std::string_view a, std::string_view b, bool ignore_case) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) {
           return x == y || (ignore_case && std::toupper(static_cast<unsigned char>(x)) ==
                                                std::toupper(static_cast<unsigned char>(y)));
         });
}

std::uint32_t CellCount(const Variable& variable) {
  std::uint32_t count = 1;
  for (std::uint8_t i = 0; i < variable.dimension_count; ++i) count *= variable.dimensions[i];
  return count;
}

class Allocation {
 public:
  Allocation(Module& module, const NamesToNumbersConfig& config, diag::Sink& sink)
      : module_(module), config_(config), sink_(sink), make_(module), calls_(module) {}

  NamesToNumbersResult Run();

 private:
  struct Home {
    std::uint32_t cell = 0;
    bool common = false;
  };

  // What is used.
  void FindUses();
  void FindFeedParameters(ProgramId program);
  // Where it goes.
  void ReservePins();
  void ReservePin(const NamesToNumbersConfig::Pin& pin, std::string_view name, std::uint32_t count, ProgramId owner);
  void KeepLocals();
  void PlaceSpaces();
  void ChooseLetters(const std::vector<ProgramId>& parts);
  [[nodiscard]] bool ArgumentsAreHarmless(ProgramId program, std::uint32_t position) const;
  void PlaceProgram(ProgramId program);
  void Map(CellMapping mapping);
  bool PlaceParameter(ProgramId program, VariableId id);
  void PlaceLocal(ProgramId program, VariableId id);
  bool TakeLocal(ProgramId program, std::uint32_t count, std::uint32_t& cell);
  bool TakeCommon(std::uint32_t count, std::uint32_t& cell);
  const NamesToNumbersConfig::Pin* PinOf(ProgramId program, std::string_view name) const;
  // The program text.
  void LowerDefinitions(ProgramId program, const analysis::Cfg& cfg);
  [[nodiscard]] std::uint32_t RepeatCount(const AssignList& list, std::uint32_t all) const;
  bool WrittenBeforeRead(const analysis::Cfg& cfg, BlockId definition, VariableId variable);
  void LowerCalls(ProgramId program);
  [[nodiscard]] bool MayReach(ProgramId callee, std::uint32_t space, std::uint32_t cell) const;
  [[nodiscard]] bool IsOwn(ProgramId program, const Expr& actual, const Variable& parameter, ProgramId callee) const;
  void ReplaceNames(ProgramId program);
  ExprId CellOf(ExprId id);

  void Refuse(const SourceRange& at, std::string_view what);
  [[nodiscard]] SourceRange PlaceOf(const Variable& variable) const {
    return {variable.file, variable.line, variable.begin, variable.begin + variable.length};
  }
  /// Its value is one for all calls of all programs.
  [[nodiscard]] bool IsShared(VariableId id) const {
    const Scope scope = module_.variables[id].scope;
    return scope == Scope::kChannel || scope == Scope::kGlobal ||
           (scope == Scope::kProgram && seen_elsewhere_.contains(id.value));
  }
  /// Variables of the program live in the cells of its level.
  [[nodiscard]] bool OwnsLocals(ProgramId program) const {
    return std::any_of(homes_.begin(), homes_.end(), [&](const auto& home) {
      return module_.variables[VariableId{home.first}].owner == program && !home.second.common;
    });
  }

  Module& module_;
  const NamesToNumbersConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::CallGraph calls_;
  SpaceId space_;

  std::map<std::uint32_t, Home> homes_;                           // VariableId -> first cell
  std::map<std::uint64_t, std::uint32_t> cells_;                  // source space, cell -> cell
  std::map<std::uint32_t, std::int64_t> offsets_;                 // source space reached by an index -> offset
  std::map<std::uint32_t, std::set<std::uint32_t>> used_locals_;  // ProgramId -> cells taken
  std::set<std::uint32_t> used_common_;
  std::set<std::uint32_t> pinned_common_;
  std::map<std::uint32_t, std::set<std::uint32_t>> used_cells_;  // SpaceId -> cells of the source
  std::set<std::uint32_t> indexed_spaces_;
  std::map<std::uint32_t, std::set<std::uint64_t>> cells_of_;  // ProgramId -> source space, cell that it names
  std::map<std::uint32_t, std::set<std::uint32_t>>
      spaces_of_;  // ProgramId -> source spaces that it reaches by an index
  std::set<std::uint32_t> read_variables_;
  std::set<std::uint32_t> modal_;                             // ProgramId: called modally, and locals keep their values
  std::map<std::uint32_t, std::set<std::uint32_t>> written_;  // ProgramId -> variables that its blocks write
  std::set<std::uint32_t> seen_elsewhere_;                    // variables of a main program that its subprograms name
  std::set<std::uint32_t> feeds_;                             // parameters that stand alone as a feed
  std::map<std::uint32_t, ArgumentLetter> letters_;           // VariableId of a parameter
  std::size_t steps_left_ = 1'000'000;                        // of WrittenBeforeRead
  std::set<std::uint32_t> unread_parts_;                      // parameters that a part of a cut program gets on no way
  NamesToNumbersResult result_;
};

void Allocation::Refuse(const SourceRange& at, std::string_view what) {
  result_.ok = false;
  sink_.Report(diag::Code::kNotExpressible, at, what, "a language with numbered variables");
}

void Allocation::FindUses() {
  for (const ProgramId program : module_.programs.Ids()) {
    RewriteProgram(module_, program, [&](Module& module, ExprId id) {
      const Expr& expr = module.exprs[id];
      if (expr.op == ExprOp::kCell) {
        used_cells_[expr.a].insert(expr.b);
        cells_of_[program.value].insert(std::uint64_t{expr.a} << 32U | expr.b);
      }
      if (expr.op == ExprOp::kCellAt) {
        indexed_spaces_.insert(expr.b);
        spaces_of_[program.value].insert(expr.b);
      }
      if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) {
        read_variables_.insert(expr.a);
        const ProgramId owner = module.variables[VariableId{std::size_t{expr.a}}].owner;
        if (owner.Valid() && owner != program) seen_elsewhere_.insert(expr.a);
      }
      return id;
    });
    FindFeedParameters(program);
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId id : module_.blocks[block].words) {
        const Word& word = module_.words[id];
        if (word.op == WordOp::kModalCall && word.Extra<CallId>().Valid() && config_.modal_keeps_locals &&
            module_.calls[word.Extra<CallId>()].program.Valid())
          modal_.insert(module_.calls[word.Extra<CallId>()].program.value);
        VisitWordExprs(module_, word, [&](ExprId root, bool place) {
          const Expr& expr = module_.exprs[root];
          if (place && (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement))
            written_[program.value].insert(expr.a);
        });
        if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
        if (!word.Extra<CallId>().Valid()) continue;
        // What a call takes by reference its program may write.
        const Call& call = module_.calls[word.Extra<CallId>()];
        if (!call.program.Valid()) continue;
        const IdRange<VariableId> parameters = module_.programs[call.program].parameters;
        for (const ArgId arg_id : call.args) {
          const Arg& arg = module_.args[arg_id];
          if (arg.letter != 0 || !arg.value.Valid() || arg.position >= parameters.count) continue;
          const Expr& given = module_.exprs[arg.value];
          const bool variable = given.op == ExprOp::kVariable || given.op == ExprOp::kElement;
          if (variable && module_.variables[parameters[arg.position]].by_reference)
            written_[program.value].insert(given.a);
        }
      }
    }
  }
}

void Allocation::FindFeedParameters(ProgramId program) {
  for (const BlockId block : module_.programs[program].blocks) {
    for (const WordId id : module_.blocks[block].words) {
      const Word& word = module_.words[id];
      if (word.op != WordOp::kFeed || !word.value.Valid()) continue;
      const Expr& value = module_.exprs[word.value];
      if (value.op == ExprOp::kVariable && module_.variables[VariableId{value.a}].scope == Scope::kParameter)
        feeds_.insert(value.a);
    }
  }
}

const NamesToNumbersConfig::Pin* Allocation::PinOf(ProgramId program, std::string_view name) const {
  for (const NamesToNumbersConfig::Pin& pin : config_.pins) {
    if (SameName(pin.source, name, config_.ignore_case)) return &pin;
    if (!program.Valid()) continue;
    const std::string full = fmt::format("{}.{}", module_.View(module_.programs[program].name), name);
    if (SameName(pin.source, full, config_.ignore_case)) return &pin;
  }
  return nullptr;
}

bool Allocation::TakeCommon(std::uint32_t count, std::uint32_t& cell) {
  for (const CellRange& range : config_.scratch) {
    for (std::uint32_t first = range.first; first + count <= range.last + 1; ++first) {
      bool free = true;
      for (std::uint32_t i = 0; i < count && free; ++i) free = !used_common_.contains(first + i);
      if (!free) continue;
      for (std::uint32_t i = 0; i < count; ++i) used_common_.insert(first + i);
      cell = first;
      return true;
    }
  }
  return false;
}

bool Allocation::TakeLocal(ProgramId program, std::uint32_t count, std::uint32_t& cell) {
  std::set<std::uint32_t>& used = used_locals_[program.value];
  const auto take = [&](std::uint32_t first) {
    for (std::uint32_t i = 0; i < count; ++i) {
      if (first + i > config_.locals.last || used.contains(first + i)) return false;
    }
    for (std::uint32_t i = 0; i < count; ++i) used.insert(first + i);
    cell = first;
    return true;
  };
  for (const std::uint32_t first : config_.free_locals_first) {
    if (count == 1 && take(first)) return true;
  }
  for (std::uint32_t first = config_.locals.first; first <= config_.locals.last; ++first) {
    if (take(first)) return true;
  }
  return false;
}

/// The cells of a pin belong to nothing else, exist, and outlive a call where the variable does. `owner`: the program
/// whose calls have the variable, none = all programs share it.
void Allocation::ReservePin(const NamesToNumbersConfig::Pin& pin, std::string_view name, std::uint32_t count,
                            ProgramId owner) {
  const std::uint32_t last = pin.cell + count - 1;
  const bool local = pin.cell <= config_.locals.last;
  if (pin.cell < config_.cells.first || last > config_.cells.last || last < pin.cell ||
      (local && (!owner.Valid() || last > config_.locals.last))) {
    return Refuse({}, fmt::format("{} in #{}, which is no cell for it,", name, pin.cell));
  }
  std::set<std::uint32_t>& taken = local ? used_locals_[owner.value] : pinned_common_;
  for (std::uint32_t cell = pin.cell; cell <= last; ++cell) {
    if (!taken.insert(cell).second) {
      return Refuse({}, fmt::format("{} in #{}, where another variable is pinned,", name, cell));
    }
  }
  if (!local) used_common_.insert(taken.begin(), taken.end());
}

void Allocation::ReservePins() {
  for (const auto& [space, cells] : used_cells_) {
    const Space& source = module_.spaces[SpaceId{std::size_t{space}}];
    if (SpaceId{std::size_t{space}} == space_ || source.visibility == Visibility::kLevel ||
        indexed_spaces_.contains(space))
      continue;
    for (const std::uint32_t number : cells) {
      const std::string name = fmt::format("{}{}", module_.View(source.name), number);
      if (const auto* pin = PinOf({}, name)) ReservePin(*pin, name, 1, {});
    }
  }
  for (const std::uint32_t space : indexed_spaces_) {
    const Space& source = module_.spaces[SpaceId{std::size_t{space}}];
    if (SpaceId{std::size_t{space}} == space_ || source.visibility == Visibility::kLevel) continue;
    const std::string name = fmt::format("{}{}", module_.View(source.name), source.first);
    if (const auto* pin = PinOf({}, name)) ReservePin(*pin, name, source.last - source.first + 1, {});
  }
  for (const VariableId id : module_.variables.Ids()) {
    const Variable& variable = module_.variables[id];
    if (variable.scope == Scope::kParameter || !read_variables_.contains(id.value)) continue;
    const bool shared = IsShared(id);
    const std::string_view name = module_.View(variable.name);
    if (const auto* pin = PinOf(variable.owner, name))
      ReservePin(*pin, name, CellCount(variable), shared ? ProgramId{} : variable.owner);
  }
  // Pins of what does not occur keep their cells too: the map stays when it comes back.
  for (const NamesToNumbersConfig::Pin& pin : config_.pins) used_common_.insert(pin.cell);
}

/// Numbered locals of the source stay what they are: the target has the same ones at each call. What the passes made
/// beside them takes others, in every program: some may run with the locals of their caller.
void Allocation::KeepLocals() {
  for (const SpaceId space : module_.spaces.Ids()) {
    if (space == space_ || module_.spaces[space].visibility != Visibility::kLevel) continue;
    offsets_[space.value] = 0;
    std::set<std::uint32_t> cells = used_cells_[space.value];
    if (indexed_spaces_.contains(space.value)) {
      for (std::uint32_t cell = module_.spaces[space].first; cell <= module_.spaces[space].last; ++cell)
        cells.insert(cell);
    }
    for (const Arg& arg : module_.args.All()) {
      if (arg.letter != 0) cells.insert(arg.position);
    }
    for (const ProgramId program : module_.programs.Ids())
      used_locals_[program.value].insert(cells.begin(), cells.end());
  }
}

void Allocation::PlaceSpaces() {
  for (const std::uint32_t space : indexed_spaces_) {
    if (SpaceId{space} == space_ || offsets_.contains(space)) continue;
    // An index may reach any cell: the space moves as one piece with one offset, or not at all.
    const Space& source = module_.spaces[SpaceId{space}];
    std::uint32_t first = 0;
    const std::uint32_t count = source.last - source.first + 1;
    if (const NamesToNumbersConfig::Pin* pin =
            PinOf({}, fmt::format("{}{}", module_.View(source.name), source.first))) {
      first = pin->cell;
    } else if (!TakeCommon(count, first)) {
      Refuse({}, fmt::format("{}[..] with a computed number ({} cells that move together)", module_.View(source.name),
                             count));
      continue;
    }
    offsets_[space] = static_cast<std::int64_t>(first) - source.first;
    CellMapping mapping;
    mapping.source = fmt::format("{0}{1} to {0}{2}", module_.View(source.name), source.first, source.last);
    mapping.first = first;
    mapping.count = count;
    mapping.common = true;
    mapping.outlives = source.lifetime == Lifetime::kKept;
    mapping.source_space = SpaceId{space};
    mapping.source_cell = source.first;
    Map(mapping);
  }
  for (const auto& [space, cells] : used_cells_) {
    if (SpaceId{space} == space_ || offsets_.contains(space)) continue;
    const Space source = module_.spaces[SpaceId{space}];
    for (const std::uint32_t number : cells) {
      // A space of one cell is a name by itself.
      const std::string name = source.last == source.first ? std::string(module_.View(source.name))
                                                           : fmt::format("{}{}", module_.View(source.name), number);
      std::uint32_t cell = 0;
      if (const NamesToNumbersConfig::Pin* pin = PinOf({}, name)) {
        cell = pin->cell;
      } else {
        // The same number behind the start of the scratch cells where that is free: the map stays when other cells
        // come.
        const std::uint32_t wish = config_.scratch.empty() ? 0 : config_.scratch.front().first + number;
        const bool fits =
            !config_.scratch.empty() && wish <= config_.scratch.front().last && !used_common_.contains(wish);
        if (fits) {
          used_common_.insert(wish);
          cell = wish;
        } else if (!TakeCommon(1, cell)) {
          Refuse({}, fmt::format("{}: the scratch cells of the profile are used up", name));
          continue;
        }
      }
      cells_[static_cast<std::uint64_t>(space) << 32U | number] = cell;
      CellMapping mapping;
      mapping.source = name;
      mapping.first = cell;
      mapping.common = true;
      mapping.outlives = source.lifetime == Lifetime::kKept;
      mapping.source_space = SpaceId{space};
      mapping.source_cell = number;
      Map(mapping);
    }
  }
}

void Allocation::Map(CellMapping mapping) {
  mapping.target = fmt::format("{}{}", config_.space, mapping.first);
  result_.map.push_back(std::move(mapping));
}

/// Evaluating the argument again or not at all makes no difference: no call can end in an alarm there.
bool Allocation::ArgumentsAreHarmless(ProgramId program, std::uint32_t position) const {
  for (const ProgramId caller : module_.programs.Ids()) {
    for (const BlockId block : module_.programs[caller].blocks) {
      for (const WordId id : module_.blocks[block].words) {
        const Word& word = module_.words[id];
        if ((word.op != WordOp::kCall && word.op != WordOp::kModalCall) || !word.Extra<CallId>().Valid()) continue;
        const Call& call = module_.calls[word.Extra<CallId>()];
        if (call.program != program) continue;
        for (const ArgId arg : call.args) {
          ExprId value = module_.args[arg].value;
          if (module_.args[arg].letter != 0 || module_.args[arg].position != position || !value.Valid()) continue;
          while (module_.exprs[value].op == ExprOp::kGroup || module_.exprs[value].op == ExprOp::kNegate ||
                 module_.exprs[value].op == ExprOp::kConvert)
            value = ExprId{module_.exprs[value].a};
          const ExprOp op = module_.exprs[value].op;
          if (op != ExprOp::kLiteral && op != ExprOp::kVariable && op != ExprOp::kCell) return false;
        }
      }
    }
  }
  return true;
}

/// One letter for each parameter, the same in all parts of a cut program; the feed has its own.
void Allocation::ChooseLetters(const std::vector<ProgramId>& parts) {
  const std::uint32_t count = module_.programs[parts.front()].parameters.count;
  const auto variable = [&](ProgramId part, std::uint32_t position) {
    return VariableId{module_.programs[part].parameters[position]};
  };
  const auto any = [&](const auto& holds) { return std::any_of(parts.begin(), parts.end(), holds); };
  std::size_t next_letter = 0;
  bool feed_taken = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Variable& first = module_.variables[variable(parts.front(), i)];
    if (first.by_reference || first.dimension_count > 0) continue;
    if (parts.size() > 1) {
      const bool read = any([&](ProgramId part) { return read_variables_.contains(variable(part, i).value); });
      const bool harmless = ArgumentsAreHarmless(parts.front(), i);
      for (std::size_t part = 0; part < parts.size(); ++part) {
        if (read_variables_.contains(variable(parts[part], i).value)) continue;
        if (part == 0 ? read && harmless : true) unread_parts_.insert(variable(parts[part], i).value);
      }
    }
    ArgumentLetter letter;
    const bool feed = any([&](ProgramId part) { return feeds_.contains(variable(part, i).value); });
    if (feed && !feed_taken && config_.feed_letter.letter != 0) {
      letter = config_.feed_letter;
      feed_taken = true;
    } else {
      while (next_letter < config_.letters.size() &&
             any([&](ProgramId part) { return used_locals_[part.value].contains(config_.letters[next_letter].cell); }))
        ++next_letter;
      if (next_letter < config_.letters.size()) letter = config_.letters[next_letter++];
    }
    for (const ProgramId part : parts) letters_[variable(part, i).value] = letter;
  }
}

bool Allocation::PlaceParameter(ProgramId program, VariableId id) {
  if (unread_parts_.contains(id.value)) return true;
  const Variable variable = module_.variables[id];
  CellMapping mapping;
  mapping.program = program;
  mapping.source = module_.View(variable.name);
  mapping.variable = id;
  if (variable.type == Type::kString || variable.type == Type::kAxis || variable.type == Type::kFrame) {
    Refuse(PlaceOf(variable), fmt::format("parameter {} that is no number", mapping.source));
    return false;
  }
  if (variable.by_reference || variable.dimension_count > 0) {
    if (CellCount(variable) == 0) {
      Refuse(PlaceOf(variable), fmt::format("parameter {}: an array whose size its caller knows", mapping.source));
      return false;
    }
    if (calls_.Recursive(program)) {
      Refuse(PlaceOf(variable),
             fmt::format("parameter {} by reference of a program that calls itself", mapping.source));
      return false;
    }
    std::uint32_t cell = 0;
    if (!TakeCommon(CellCount(variable), cell)) {
      Refuse(PlaceOf(variable),
             fmt::format("parameter {}: the scratch cells of the profile are used up", mapping.source));
      return false;
    }
    mapping.first = cell;
    mapping.count = CellCount(variable);
    mapping.common = true;
    homes_[id.value] = {cell, true};
  } else {
    const ArgumentLetter letter = letters_[id.value];
    if (letter.letter == 0) {
      Refuse(PlaceOf(variable), fmt::format("parameter {}: more parameters than argument letters", mapping.source));
      return false;
    }
    used_locals_[program.value].insert(letter.cell);
    mapping.letter = letter.letter;
    mapping.first = letter.cell;
    homes_[id.value] = {letter.cell, false};
  }
  Map(mapping);
  return true;
}

void Allocation::PlaceLocal(ProgramId program, VariableId id) {
  const Variable variable = module_.variables[id];
  const std::string name(module_.View(variable.name));
  if (!read_variables_.contains(id.value)) return;
  if (variable.initial_list.Valid()) {
    const AssignList& list = module_.assign_lists[variable.initial_list];
    if (list.repeat && list.count.Valid() && module_.exprs[list.count].op != ExprOp::kLiteral)
      return Refuse(PlaceOf(variable), fmt::format("start values of {} as many as an expression says", name));
  }
  if (variable.type == Type::kString || variable.type == Type::kAxis || variable.type == Type::kFrame) {
    return Refuse(PlaceOf(variable), fmt::format("variable {} that is no number", name));
  }
  CellMapping mapping;
  mapping.program = program;
  mapping.source = name;
  mapping.variable = id;
  mapping.count = CellCount(variable);
  if (const NamesToNumbersConfig::Pin* pin = PinOf(program, name)) {
    mapping.first = pin->cell;
    mapping.common = pin->cell > config_.locals.last;
  } else if (variable.scope == Scope::kChannel || variable.scope == Scope::kGlobal) {
    return Refuse(PlaceOf(variable),
                  fmt::format("{}, which other programs may use and no [variables] line pins to a cell", name));
  } else if (IsShared(id) || !TakeLocal(program, mapping.count, mapping.first)) {
    if (!TakeCommon(mapping.count, mapping.first)) {
      return Refuse(PlaceOf(variable), fmt::format("variable {}: no free cells are left", name));
    }
    mapping.common = true;
  }
  if (mapping.common && !IsShared(id) && program.Valid() && calls_.Recursive(program)) {
    return Refuse(PlaceOf(variable),
                  fmt::format("variable {} of a program that calls itself, in a cell that all its calls share,", name));
  }
  homes_[id.value] = {mapping.first, mapping.common};
  if (mapping.count > 1) mapping.source += fmt::format("[0] to [{}]", mapping.count - 1);
  Map(mapping);
}

void Allocation::PlaceProgram(ProgramId program) {
  for (const VariableId id : module_.programs[program].parameters) {
    if (!PlaceParameter(program, id)) return;
  }
  for (std::uint32_t i = 0; i < module_.variables.Size(); ++i) {
    const Variable& variable = module_.variables[VariableId{i}];
    if (variable.owner == program && variable.scope != Scope::kParameter) PlaceLocal(program, VariableId{i});
  }
}

/// From the definition on, on every way: is the variable assigned before anything reads it?
bool Allocation::WrittenBeforeRead(const analysis::Cfg& cfg, BlockId definition, VariableId variable) {
  // Subprograms may read what belongs to the whole program.
  if (module_.variables[variable].scope != Scope::kLocal || cfg.Opaque()) return false;
  const IdRange<BlockId> blocks = cfg.Blocks();
  enum class Use : std::uint8_t { kNone, kReads, kWrites };
  const auto use_of = [&](BlockId id, bool behind_definition) {
    const Block& block = module_.blocks[id];
    bool sure = block.skip_level == Block::kNoSkip, active = !behind_definition;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (!active) {
        active = word.op == WordOp::kDefine && word.Extra<VariableId>() == variable;
        continue;
      }
      if (ReadsVariable(module_, word, variable)) return Use::kReads;
      sure = sure && word.op != WordOp::kWhen && word.op != WordOp::kSkipRest;
      if (word.op != WordOp::kAssign || !sure) continue;
      const Expr& place = module_.exprs[word.Extra<ExprId>()];
      if (place.op == ExprOp::kVariable && place.a == variable.value) return Use::kWrites;
    }
    return Use::kNone;
  };
  std::vector<std::uint8_t> seen(blocks.count, 0);
  std::vector<BlockId> work{definition};
  for (bool first = true; !work.empty(); first = false) {
    // Long programs with many variables: a start value too much does no harm.
    if (steps_left_ == 0) return false;
    --steps_left_;
    const BlockId block = work.back();
    work.pop_back();
    const Use use = use_of(block, first);
    if (use == Use::kReads) return false;
    if (use == Use::kWrites) continue;
    for (const analysis::Edge& edge : cfg.Successors(block)) {
      if (edge.kind == analysis::EdgeKind::kComputed || edge.kind == analysis::EdgeKind::kRestart) return false;
      if (edge.to.Valid() && std::exchange(seen[edge.to.value - blocks.begin], 1) == 0) work.push_back(edge.to);
    }
  }
  return true;
}

/// Elements that a repeated start value fills, of `all`.
std::uint32_t Allocation::RepeatCount(const AssignList& list, std::uint32_t all) const {
  if (!list.count.Valid()) return all;
  const Expr& count = module_.exprs[list.count];
  return count.op == ExprOp::kLiteral && count.number < all ? static_cast<std::uint32_t>(std::lround(count.number))
                                                            : all;
}

/// A definition sets its variable at each call: that becomes an assignment, unless the next lines set it anyway.
void Allocation::LowerDefinitions(ProgramId program, const analysis::Cfg& cfg) {
  ProgramEditor editor(module_, program, "names_to_numbers");
  for (const BlockId id : module_.programs[program].blocks) {
    const Block block = module_.blocks[id];
    std::vector<Word> assignments;
    bool definition = false;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kHeader || word.op == WordOp::kExtern) definition = true;
      if (word.op != WordOp::kDefine) continue;
      definition = true;
      const VariableId variable_id = word.Extra<VariableId>();
      const Variable variable = module_.variables[variable_id];
      if (!homes_.contains(variable_id.value)) continue;
      const bool plain = !variable.initial.Valid() || module_.exprs[variable.initial].op == ExprOp::kLiteral;
      const bool idle = plain && !variable.initial_list.Valid() && WrittenBeforeRead(cfg, id, variable_id);
      if (idle) continue;
      if (modal_.contains(program.value) && written_[program.value].contains(variable_id.value)) {
        Refuse(module_.RangeOf(block, word),
               fmt::format("{}, which keeps its value between the runs of a modal call", module_.View(variable.name)));
        continue;
      }
      const auto assign = [&](ExprId place, ExprId value) {
        Word made;
        made.op = WordOp::kAssign;
        made.phase = DefaultPhaseOf(WordOp::kAssign);
        made.extra = place.value;
        made.value = value;
        assignments.push_back(made);
      };
      if (variable.dimension_count == 0) {
        assign(make_.Variable(variable_id), variable.initial.Valid() ? variable.initial : make_.Literal(0));
        continue;
      }
      const std::uint32_t count = CellCount(variable);
      for (std::uint32_t i = 0; i < count; ++i) {
        ExprId value = make_.Literal(0);
        if (variable.initial_list.Valid()) {
          const AssignList list = module_.assign_lists[variable.initial_list];
          if (list.repeat && list.values.count == 1) {
            if (i < RepeatCount(list, count)) value = module_.Item(list.values[0].value);
          } else if (i < list.values.count && module_.Item(list.values[i].value).Valid()) {
            value = module_.Item(list.values[i].value);
          }
        }
        // Written as a cell at once: elements of more dimensions count with the last index fastest.
        assign(make_.Cell(space_, homes_[variable_id.value].cell + i), value);
      }
    }
    if (!definition) continue;
    for (std::size_t i = 0; i < assignments.size(); ++i) {
      Block made = editor.MakeBlock(id);
      if (i == 0) {
        made.comments = block.comments;
        made.number = block.number;
        made.number_digits = block.number_digits;
      }
      editor.SetWords(made, {assignments[i]});
      editor.InsertBefore(id, made);
    }
    if (!assignments.empty()) {
      module_.blocks[id].comments = {};
      module_.blocks[id].number = Block::kNoNumber;
      editor.Remove(id);
    } else {
      // Only the words go: comments stay where they stood.
      module_.blocks[id].words = {};
      if (block.comments.Empty() && block.number == Block::kNoNumber && !block.label.Valid()) editor.Remove(id);
    }
  }
  editor.Apply();
}

/// Some program that runs below the call may name the cell.
bool Allocation::MayReach(ProgramId callee, std::uint32_t space, std::uint32_t cell) const {
  std::set<std::uint32_t> seen;
  std::vector<ProgramId> work{callee};
  while (!work.empty()) {
    const ProgramId program = work.back();
    work.pop_back();
    if (!program.Valid()) return true;
    if (!seen.insert(program.value).second) continue;
    const auto cells = cells_of_.find(program.value);
    if (cells != cells_of_.end() && cells->second.contains(std::uint64_t{space} << 32U | cell)) return true;
    const auto spaces = spaces_of_.find(program.value);
    if (spaces != spaces_of_.end() && spaces->second.contains(space)) return true;
    for (const analysis::CallSite& site : calls_.SitesOf(program)) work.push_back(site.callee);
  }
  return false;
}

/// What the call gives by reference is of the parameter's type, and nothing below the call names it.
bool Allocation::IsOwn(ProgramId program, const Expr& actual, const Variable& parameter, ProgramId callee) const {
  if (actual.op != ExprOp::kCell) {
    const Variable& variable = module_.variables[VariableId{std::size_t{actual.a}}];
    return variable.owner == program && !seen_elsewhere_.contains(actual.a) && variable.type == parameter.type;
  }
  // A modal call runs its program behind blocks of any other.
  for (const analysis::CallSite& site : calls_.AllSites()) {
    if (site.modal && MayReach(site.callee, actual.a, actual.b)) return false;
  }
  return module_.spaces[SpaceId{std::size_t{actual.a}}].type == parameter.type && !MayReach(callee, actual.a, actual.b);
}

void Allocation::LowerCalls(ProgramId program) {
  ProgramEditor editor(module_, program, "names_to_numbers");
  for (const BlockId id : module_.programs[program].blocks) {
    const Block block = module_.blocks[id];
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if ((word.op != WordOp::kCall && word.op != WordOp::kModalCall) || !word.Extra<CallId>().Valid()) continue;
      Call call = module_.calls[word.Extra<CallId>()];
      if (!call.program.Valid()) continue;  // refused elsewhere: an unknown program
      // Letters of the source fill the same locals here; without them, a program without locals needs no level.
      const bool letters = std::any_of(module_.spaces.All().begin(), module_.spaces.All().end(),
                                       [](const Space& space) { return space.visibility == Visibility::kLevel; });
      if (!letters) call.new_level = OwnsLocals(call.program);
      const IdRange<VariableId> parameters = module_.programs[call.program].parameters;
      std::vector<Arg> args;
      for (const ArgId arg : call.args) {
        if (module_.args[arg].letter != 0) args.push_back(module_.args[arg]);
      }
      std::set<std::uint32_t> references;
      for (std::uint32_t i = 0; i < parameters.count; ++i) {
        const Variable parameter = module_.variables[parameters[i]];
        if (!homes_.contains(parameters[i].value)) continue;
        const Home home = homes_[parameters[i].value];
        ExprId given;
        for (const ArgId arg : call.args) {
          if (module_.args[arg].letter == 0 && module_.args[arg].position == i) given = module_.args[arg].value;
        }
        if (!parameter.by_reference) {
          Arg arg;
          arg.position = static_cast<std::uint16_t>(i);
          const auto mapping = std::find_if(result_.map.begin(), result_.map.end(),
                                            [&](const CellMapping& m) { return m.variable == parameters[i]; });
          arg.letter = mapping->letter;
          // A missing argument is 0 in the source and empty in the target: 0 is passed.
          arg.value = given.Valid() ? given : parameter.initial.Valid() ? parameter.initial : make_.Literal(0);
          args.push_back(arg);
          continue;
        }
        const Expr* actual = given.Valid() ? &module_.exprs[given] : nullptr;
        const bool variable = actual != nullptr && actual->op == ExprOp::kVariable;
        // An element by numbers and a cell are one cell here.
        Home source;
        bool whole = variable;
        if (actual != nullptr && (actual->op == ExprOp::kElement || actual->op == ExprOp::kCell)) {
          const Expr place = module_.exprs[CellOf(given)];
          actual = &module_.exprs[given];
          whole = place.op == ExprOp::kCell && SpaceId{std::size_t{place.a}} == space_;
          source.cell = place.b;
        }
        if (!whole || word.op == WordOp::kModalCall) {
          Refuse(module_.RangeOf(block, word), fmt::format("argument {} by reference", module_.View(parameter.name)));
          continue;
        }
        // Copied in and out: nothing that the callee reaches another way, and no value that changes its type.
        const std::uint32_t count = CellCount(parameter);
        if (variable) source = homes_[actual->a];
        bool apart = IsOwn(program, *actual, parameter, call.program);
        for (std::uint32_t cell = 0; cell < count; ++cell)
          apart = references.insert(source.cell + cell).second && apart;
        if (!apart) {
          Refuse(module_.RangeOf(block, word),
                 fmt::format("argument {} by reference to what the callee may reach another way",
                             module_.View(parameter.name)));
          continue;
        }
        if ((variable ? CellCount(module_.variables[VariableId{std::size_t{actual->a}}]) : 1) != count) {
          Refuse(module_.RangeOf(block, word),
                 fmt::format("argument {} by reference of another size", module_.View(parameter.name)));
          continue;
        }
        for (std::uint32_t cell = 0; cell < count; ++cell) {
          const auto copy = [&](std::uint32_t to, std::uint32_t from) {
            Word made;
            made.op = WordOp::kAssign;
            made.phase = DefaultPhaseOf(WordOp::kAssign);
            made.extra = make_.Cell(space_, to).value;
            made.value = make_.Cell(space_, from);
            Block copy_block = editor.MakeBlock(id);
            editor.SetWords(copy_block, {made});
            return copy_block;
          };
          Block in = copy(home.cell + cell, source.cell + cell);
          if (module_.blocks[id].number != Block::kNoNumber) {
            in.number = block.number;
            in.number_digits = block.number_digits;
            module_.blocks[id].number = Block::kNoNumber;
          }
          editor.InsertBefore(id, in);
          editor.InsertAfter(id, copy(source.cell + cell, home.cell + cell));
        }
      }
      call.args = {static_cast<std::uint32_t>(module_.args.Size()), static_cast<std::uint32_t>(args.size())};
      for (const Arg& arg : args) module_.args.Add(arg);
      module_.calls[word.Extra<CallId>()] = call;
    }
  }
  editor.Apply();
}

ExprId Allocation::CellOf(ExprId id) {
  const Expr expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kVariable: {
      const auto home = homes_.find(expr.a);
      return home == homes_.end() ? id : make_.Cell(space_, home->second.cell);
    }
    case ExprOp::kElement: {
      const auto home = homes_.find(expr.a);
      if (home == homes_.end()) return id;
      const Variable variable = module_.variables[VariableId{expr.a}];
      // Row by row, the last index fastest (sinumerik-3.5).
      LinearForm index;
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        LinearForm scaled;
        scaled = Sum(module_, scaled, index, i == 0 ? 1 : variable.dimensions[i]);
        index = Sum(module_, scaled, FormOf(module_, module_.Item(expr.b + i)));
      }
      index.constant += home->second.cell;
      if (index.IsConstant()) return make_.Cell(space_, static_cast<std::uint32_t>(index.constant));
      return make_.CellAt(space_, ExprOf(module_, index));
    }
    case ExprOp::kCell: {
      if (SpaceId{expr.a} == space_) return id;
      const auto offset = offsets_.find(expr.a);
      if (offset != offsets_.end()) return make_.Cell(space_, static_cast<std::uint32_t>(expr.b + offset->second));
      const auto cell = cells_.find(static_cast<std::uint64_t>(expr.a) << 32U | expr.b);
      return cell == cells_.end() ? id : make_.Cell(space_, cell->second);
    }
    case ExprOp::kCellAt: {
      if (SpaceId{expr.b} == space_) return id;
      const auto offset = offsets_.find(expr.b);
      if (offset == offsets_.end()) return id;
      LinearForm index = FormOf(module_, ExprId{expr.a});
      index.constant += static_cast<double>(offset->second);
      return make_.CellAt(space_, ExprOf(module_, index));
    }
    default:
      return id;
  }
}

void Allocation::ReplaceNames(ProgramId program) {
  RewriteProgram(module_, program, [this](Module&, ExprId id) { return CellOf(id); });
}

NamesToNumbersResult Allocation::Run() {
  result_.ok = true;
  space_ =
      AddSpace(module_, config_.space, config_.cells.first, config_.cells.last, Type::kNumber, StartValue::kVacant);
  FindUses();
  KeepLocals();
  ReservePins();
  PlaceSpaces();
  for (const ProgramId program : module_.programs.Ids()) {
    const auto group = std::find_if(config_.parts.begin(), config_.parts.end(), [&](const auto& parts) {
      return std::find(parts.begin(), parts.end(), program) != parts.end();
    });
    if (group == config_.parts.end()) ChooseLetters({program});
    if (group != config_.parts.end() && group->front() == program) ChooseLetters(*group);
  }
  for (const ProgramId program : module_.programs.Ids()) PlaceProgram(program);
  for (std::uint32_t i = 0; i < module_.variables.Size(); ++i) {
    if (!module_.variables[VariableId{i}].owner.Valid()) PlaceLocal({}, VariableId{i});
  }
  if (!result_.ok) return std::move(result_);
  const analysis::FlowGraphs graphs(module_);
  for (const ProgramId program : module_.programs.Ids()) {
    LowerDefinitions(program, graphs.Of(program));
    LowerCalls(program);
  }
  for (const ProgramId program : module_.programs.Ids()) ReplaceNames(program);
  return std::move(result_);
}

}  // namespace

NamesToNumbersResult NamesToNumbers(Module& module, const NamesToNumbersConfig& config, diag::Sink& sink) {
  return Allocation(module, config, sink).Run();
}

}  // namespace ncport::ir::transform
