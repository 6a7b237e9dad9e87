#include "ir/transform/cell_allocation.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/letter_case.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

bool SameName(std::string_view a, std::string_view b, bool ignore_case) {
  return ignore_case ? EqualIgnoringCase(a, b) : a == b;
}

/// True if the expression holds a cell of the space whose number is computed.
bool HasIndex(const Module& module, ExprId id, SpaceId space) {
  const Expr& expr = module.exprs[id];
  if (expr.op == ExprOp::kCellAt && expr.b == space.value) return true;
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return false;
    case Operands::kUnary:
      return HasIndex(module, ExprId{std::size_t{expr.a}}, space);
    case Operands::kBinary:
      return HasIndex(module, ExprId{std::size_t{expr.a}}, space) ||
             HasIndex(module, ExprId{std::size_t{expr.b}}, space);
    case Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        if (HasIndex(module, module.Item(expr.b + i), space)) return true;
      }
      return false;
  }
  return false;
}

}  // namespace

std::uint32_t CellCount(const Variable& variable) {
  std::uint32_t count = 1;
  for (std::uint8_t i = 0; i < variable.dimension_count; ++i) count *= variable.dimensions[i];
  return count;
}

bool CellAllocation::Run() {
  KeepLocals();
  ReservePins();
  PlaceIndexedSpaces();
  PlaceCells();
  ChooseAllLetters();
  for (const ProgramId program : module_.programs.Ids()) PlaceProgram(program);
  for (std::uint32_t i = 0; i < module_.variables.Size(); ++i) {
    if (!module_.variables[VariableId{i}].owner.Valid()) PlaceLocal({}, VariableId{i});
  }
  return ok_;
}

std::optional<CellAllocation::Home> CellAllocation::HomeOf(VariableId variable) const {
  const auto home = homes_.find(variable.value);
  return home == homes_.end() ? std::nullopt : std::optional(home->second);
}

std::optional<std::uint32_t> CellAllocation::CellOf(std::uint32_t space, std::uint32_t cell) const {
  if (const std::optional<std::int64_t> offset = OffsetOf(space)) return static_cast<std::uint32_t>(cell + *offset);
  const auto found = cells_.find(CellUses::Key(space, cell));
  return found == cells_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::int64_t> CellAllocation::OffsetOf(std::uint32_t space) const {
  const auto offset = offsets_.find(space);
  return offset == offsets_.end() ? std::nullopt : std::optional(offset->second);
}

bool CellAllocation::OwnsLocals(ProgramId program) const {
  return std::ranges::any_of(homes_, [&](const auto& home) {
    return module_.variables[VariableId{home.first}].owner == program && !home.second.common;
  });
}

void CellAllocation::Refuse(const SourceRange& at, std::string_view what) {
  ok_ = false;
  sink_.Report(diag::Code::kNotExpressible, at, what, "a language with numbered variables");
}

const NamesToNumbersConfig::Pin* CellAllocation::PinOf(ProgramId program, std::string_view name) const {
  for (const NamesToNumbersConfig::Pin& pin : config_.pins) {
    if (SameName(pin.source, name, config_.ignore_case)) return &pin;
    if (!program.Valid()) continue;
    const std::string full = fmt::format("{}.{}", module_.View(module_.programs[program].name), name);
    if (SameName(pin.source, full, config_.ignore_case)) return &pin;
  }
  return nullptr;
}

bool CellAllocation::TakeCommon(std::uint32_t count, std::uint32_t& cell) {
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

bool CellAllocation::TakeLocal(ProgramId program, std::uint32_t count, std::uint32_t& cell) {
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
void CellAllocation::ReservePin(const NamesToNumbersConfig::Pin& pin, std::string_view name, std::uint32_t count,
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

void CellAllocation::ReservePins() {
  for (const auto& [space, cells] : uses_.cells) {
    const Space& source = module_.spaces[SpaceId{std::size_t{space}}];
    if (SpaceId{std::size_t{space}} == space_ || source.visibility == Visibility::kLevel ||
        uses_.indexed_spaces.contains(space))
      continue;
    for (const std::uint32_t number : cells) {
      const std::string name = fmt::format("{}{}", module_.View(source.name), number);
      if (const auto* pin = PinOf({}, name)) ReservePin(*pin, name, 1, {});
    }
  }
  for (const std::uint32_t space : uses_.indexed_spaces) {
    const Space& source = module_.spaces[SpaceId{std::size_t{space}}];
    if (SpaceId{std::size_t{space}} == space_ || source.visibility == Visibility::kLevel) continue;
    const std::string name = fmt::format("{}{}", module_.View(source.name), source.first);
    if (const auto* pin = PinOf({}, name)) ReservePin(*pin, name, source.last - source.first + 1, {});
  }
  for (const VariableId id : module_.variables.Ids()) {
    const Variable& variable = module_.variables[id];
    if (variable.scope == Scope::kParameter || !uses_.variables.contains(id.value)) continue;
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
void CellAllocation::KeepLocals() {
  for (const SpaceId space : module_.spaces.Ids()) {
    if (space == space_ || module_.spaces[space].visibility != Visibility::kLevel) continue;
    offsets_[space.value] = 0;
    std::set<std::uint32_t> cells;
    if (const auto named = uses_.cells.find(space.value); named != uses_.cells.end()) cells = named->second;
    if (uses_.indexed_spaces.contains(space.value)) {
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

/// Of the first word with a cell of the space whose number is computed.
SourceRange CellAllocation::PlaceOfIndex(SpaceId space) const {
  for (const Block& block : module_.blocks.All()) {
    for (const WordId id : block.words) {
      bool found = false;
      VisitWordExprs(module_, module_.words[id],
                     [&](ExprId root, bool) { found = found || HasIndex(module_, root, space); });
      if (found) return module_.RangeOf(block, module_.words[id]);
    }
  }
  return {};
}

void CellAllocation::PlaceIndexedSpaces() {
  for (const std::uint32_t space : uses_.indexed_spaces) {
    if (SpaceId{space} == space_ || offsets_.contains(space)) continue;
    // An index may reach any cell: the space moves as one piece with one offset, or not at all.
    const Space& source = module_.spaces[SpaceId{space}];
    std::uint32_t first = 0;
    const std::uint32_t count = source.last - source.first + 1;
    if (const NamesToNumbersConfig::Pin* pin =
            PinOf({}, fmt::format("{}{}", module_.View(source.name), source.first))) {
      first = pin->cell;
    } else if (!TakeCommon(count, first)) {
      Refuse(PlaceOfIndex(SpaceId{space}), fmt::format("{}[..] with a computed number ({} cells that move together)",
                                                       module_.View(source.name), count));
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
    Add(mapping);
  }
}

void CellAllocation::PlaceCells() {
  for (const auto& [space, cells] : uses_.cells) {
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
      cells_[CellUses::Key(space, number)] = cell;
      CellMapping mapping;
      mapping.source = name;
      mapping.first = cell;
      mapping.common = true;
      mapping.outlives = source.lifetime == Lifetime::kKept;
      mapping.source_space = SpaceId{space};
      mapping.source_cell = number;
      Add(mapping);
    }
  }
}

void CellAllocation::Add(CellMapping mapping) {
  mapping.target = fmt::format("{}{}", config_.space, mapping.first);
  map_.push_back(std::move(mapping));
}

/// Evaluating the argument again or not at all makes no difference: no call can end in an alarm there.
bool CellAllocation::ArgumentsAreHarmless(ProgramId program, std::uint32_t position) const {
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

void CellAllocation::ChooseAllLetters() {
  for (const ProgramId program : module_.programs.Ids()) {
    const auto group = std::ranges::find_if(
        config_.parts, [&](const auto& parts) { return std::ranges::find(parts, program) != parts.end(); });
    if (group == config_.parts.end()) ChooseLetters({program});
    if (group != config_.parts.end() && group->front() == program) ChooseLetters(*group);
  }
}

/// One letter for each parameter, the same in all parts of a cut program; the feed has its own.
void CellAllocation::ChooseLetters(const std::vector<ProgramId>& parts) {
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
      const bool read = any([&](ProgramId part) { return uses_.variables.contains(variable(part, i).value); });
      const bool harmless = ArgumentsAreHarmless(parts.front(), i);
      for (std::size_t part = 0; part < parts.size(); ++part) {
        if (uses_.variables.contains(variable(parts[part], i).value)) continue;
        if (part == 0 ? read && harmless : true) unread_parts_.insert(variable(parts[part], i).value);
      }
    }
    ArgumentLetter letter;
    const bool feed = any([&](ProgramId part) { return uses_.feeds.contains(variable(part, i).value); });
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

bool CellAllocation::PlaceParameter(ProgramId program, VariableId id) {
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
  Add(mapping);
  return true;
}

void CellAllocation::PlaceLocal(ProgramId program, VariableId id) {
  const Variable variable = module_.variables[id];
  const std::string name(module_.View(variable.name));
  if (!uses_.variables.contains(id.value)) return;
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
  Add(mapping);
}

void CellAllocation::PlaceProgram(ProgramId program) {
  for (const VariableId id : module_.programs[program].parameters) {
    if (!PlaceParameter(program, id)) return;
  }
  for (std::uint32_t i = 0; i < module_.variables.Size(); ++i) {
    const Variable& variable = module_.variables[VariableId{i}];
    if (variable.owner == program && variable.scope != Scope::kParameter) PlaceLocal(program, VariableId{i});
  }
}

}  // namespace ncport::ir::transform
