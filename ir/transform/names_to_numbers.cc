#include "ir/transform/names_to_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/cell_allocation.h"
#include "ir/transform/cell_uses.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

/// The text of the programs, once each name has its cell.
class NameLowering {
 public:
  NameLowering(Module& module, const CellAllocation& allocation, const CellUses& uses, const analysis::CallGraph& calls,
               SpaceId space, diag::Sink& sink)
      : module_(module),
        allocation_(allocation),
        uses_(uses),
        calls_(calls),
        space_(space),
        sink_(sink),
        make_(module) {}

  /// False if a call or a definition cannot be said: each is a finding.
  bool Run();

 private:
  using Home = CellAllocation::Home;

  void LowerDefinitions(ProgramId program, const analysis::Cfg& cfg);
  [[nodiscard]] std::uint32_t RepeatCount(const AssignList& list, std::uint32_t all) const;
  bool WrittenBeforeRead(const analysis::Cfg& cfg, BlockId definition, VariableId variable);
  void LowerCalls(ProgramId program);
  [[nodiscard]] bool MayReach(ProgramId callee, std::uint32_t space, std::uint32_t cell) const;
  [[nodiscard]] bool IsOwn(ProgramId program, const Expr& actual, const Variable& parameter, ProgramId callee) const;
  void ReplaceNames(ProgramId program);
  ExprId CellOf(ExprId id);
  void Refuse(const SourceRange& at, std::string_view what);

  Module& module_;
  const CellAllocation& allocation_;
  const CellUses& uses_;
  const analysis::CallGraph& calls_;
  SpaceId space_;
  diag::Sink& sink_;
  ExprBuilder make_;
  std::size_t steps_left_ = 1'000'000;  // of WrittenBeforeRead
  bool ok_ = true;
};

void NameLowering::Refuse(const SourceRange& at, std::string_view what) {
  ok_ = false;
  sink_.Report(diag::Code::kNotExpressible, at, what, "a language with numbered variables");
}

bool NameLowering::Run() {
  const analysis::FlowGraphs graphs(module_);
  for (const ProgramId program : module_.programs.Ids()) {
    LowerDefinitions(program, graphs.Of(program));
    LowerCalls(program);
  }
  for (const ProgramId program : module_.programs.Ids()) ReplaceNames(program);
  return ok_;
}

/// From the definition on, on every way: is the variable assigned before anything reads it?
bool NameLowering::WrittenBeforeRead(const analysis::Cfg& cfg, BlockId definition, VariableId variable) {
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
std::uint32_t NameLowering::RepeatCount(const AssignList& list, std::uint32_t all) const {
  if (!list.count.Valid()) return all;
  const Expr& count = module_.exprs[list.count];
  return count.op == ExprOp::kLiteral && count.number < all ? static_cast<std::uint32_t>(std::lround(count.number))
                                                            : all;
}

/// A definition sets its variable at each call: that becomes an assignment, unless the next lines set it anyway.
void NameLowering::LowerDefinitions(ProgramId program, const analysis::Cfg& cfg) {
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
      const std::optional<Home> home = allocation_.HomeOf(variable_id);
      if (!home) continue;
      const bool plain = !variable.initial.Valid() || module_.exprs[variable.initial].op == ExprOp::kLiteral;
      const bool idle = plain && !variable.initial_list.Valid() && WrittenBeforeRead(cfg, id, variable_id);
      if (idle) continue;
      if (uses_.modal.contains(program.value) && uses_.MayWrite(program, variable_id)) {
        Refuse(module_.RangeOf(block, word),
               fmt::format("{}, which keeps its value between the runs of a modal call", module_.View(variable.name)));
        continue;
      }
      const auto assign = [&](ExprId place, ExprId value) { assignments.push_back(MakeAssignment(place, value)); };
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
        assign(make_.Cell(space_, home->cell + i), value);
      }
    }
    if (!definition) continue;
    for (const Word& assignment : assignments) editor.PutInFront(id, {assignment}, {.comments = true, .skip = false});
    if (!assignments.empty()) {
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
bool NameLowering::MayReach(ProgramId callee, std::uint32_t space, std::uint32_t cell) const {
  std::set<std::uint32_t> seen;
  std::vector<ProgramId> work{callee};
  while (!work.empty()) {
    const ProgramId program = work.back();
    work.pop_back();
    if (!program.Valid()) return true;
    if (!seen.insert(program.value).second) continue;
    const auto cells = uses_.cells_of.find(program.value);
    if (cells != uses_.cells_of.end() && cells->second.contains(CellUses::Key(space, cell))) return true;
    const auto spaces = uses_.spaces_of.find(program.value);
    if (spaces != uses_.spaces_of.end() && spaces->second.contains(space)) return true;
    for (const analysis::CallSite& site : calls_.SitesOf(program)) work.push_back(site.callee);
  }
  return false;
}

/// What the call gives by reference is of the parameter's type, and nothing below the call names it.
bool NameLowering::IsOwn(ProgramId program, const Expr& actual, const Variable& parameter, ProgramId callee) const {
  if (actual.op != ExprOp::kCell) {
    const Variable& variable = module_.variables[VariableId{std::size_t{actual.a}}];
    return variable.owner == program && !uses_.seen_elsewhere.contains(actual.a) && variable.type == parameter.type;
  }
  // A modal call runs its program behind blocks of any other.
  for (const analysis::CallSite& site : calls_.AllSites()) {
    if (site.modal && MayReach(site.callee, actual.a, actual.b)) return false;
  }
  return module_.spaces[SpaceId{std::size_t{actual.a}}].type == parameter.type && !MayReach(callee, actual.a, actual.b);
}

void NameLowering::LowerCalls(ProgramId program) {
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
      if (!letters) call.new_level = allocation_.OwnsLocals(call.program);
      const IdRange<VariableId> parameters = module_.programs[call.program].parameters;
      std::vector<Arg> args;
      for (const ArgId arg : call.args) {
        if (module_.args[arg].letter != 0) args.push_back(module_.args[arg]);
      }
      std::set<std::uint32_t> references;
      for (std::uint32_t i = 0; i < parameters.count; ++i) {
        const Variable parameter = module_.variables[parameters[i]];
        const std::optional<Home> home = allocation_.HomeOf(parameters[i]);
        if (!home) continue;
        ExprId given;
        for (const ArgId arg : call.args) {
          if (module_.args[arg].letter == 0 && module_.args[arg].position == i) given = module_.args[arg].value;
        }
        if (!parameter.by_reference) {
          Arg arg;
          arg.position = static_cast<std::uint16_t>(i);
          const std::vector<CellMapping>& map = allocation_.Map();
          const auto mapping =
              std::find_if(map.begin(), map.end(), [&](const CellMapping& m) { return m.variable == parameters[i]; });
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
        if (variable) source = allocation_.HomeOf(VariableId{std::size_t{actual->a}}).value_or(Home{});
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
            return std::vector<Word>{MakeAssignment(make_.Cell(space_, to), make_.Cell(space_, from))};
          };
          editor.PutInFront(id, copy(home->cell + cell, source.cell + cell));
          editor.PutBehind(id, copy(source.cell + cell, home->cell + cell));
        }
      }
      call.args = {static_cast<std::uint32_t>(module_.args.Size()), static_cast<std::uint32_t>(args.size())};
      for (const Arg& arg : args) module_.args.Add(arg);
      module_.calls[word.Extra<CallId>()] = call;
    }
  }
  editor.Apply();
}

ExprId NameLowering::CellOf(ExprId id) {
  const Expr expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kVariable: {
      const std::optional<Home> home = allocation_.HomeOf(VariableId{expr.a});
      return home ? make_.Cell(space_, home->cell) : id;
    }
    case ExprOp::kElement: {
      const std::optional<Home> home = allocation_.HomeOf(VariableId{expr.a});
      if (!home) return id;
      const Variable variable = module_.variables[VariableId{expr.a}];
      // Row by row, the last index fastest (sinumerik-3.5).
      LinearForm index;
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        LinearForm scaled;
        scaled = Sum(module_, scaled, index, i == 0 ? 1 : variable.dimensions[i]);
        index = Sum(module_, scaled, FormOf(module_, module_.Item(expr.b + i)));
      }
      index.constant += home->cell;
      if (index.IsConstant()) return make_.Cell(space_, static_cast<std::uint32_t>(index.constant));
      return make_.CellAt(space_, ExprOf(module_, index));
    }
    case ExprOp::kCell: {
      if (SpaceId{expr.a} == space_) return id;
      const std::optional<std::uint32_t> cell = allocation_.CellOf(expr.a, expr.b);
      return cell ? make_.Cell(space_, *cell) : id;
    }
    case ExprOp::kCellAt: {
      if (SpaceId{expr.b} == space_) return id;
      const std::optional<std::int64_t> offset = allocation_.OffsetOf(expr.b);
      if (!offset) return id;
      LinearForm index = FormOf(module_, ExprId{expr.a});
      index.constant += static_cast<double>(*offset);
      return make_.CellAt(space_, ExprOf(module_, index));
    }
    default:
      return id;
  }
}

void NameLowering::ReplaceNames(ProgramId program) {
  RewriteProgram(module_, program, [this](Module&, ExprId id) { return CellOf(id); });
}

}  // namespace

NamesToNumbersResult NamesToNumbers(Module& module, const NamesToNumbersConfig& config, diag::Sink& sink) {
  const analysis::CallGraph calls(module);
  const SpaceId space =
      AddSpace(module, config.space, config.cells.first, config.cells.last, Type::kNumber, StartValue::kVacant);
  const CellUses uses(module, config.modal_keeps_locals);
  CellAllocation allocation(module, config, uses, calls, space, sink);
  const bool ok = allocation.Run() && NameLowering(module, allocation, uses, calls, space, sink).Run();
  return {ok, allocation.Map()};
}

}  // namespace ncport::ir::transform
