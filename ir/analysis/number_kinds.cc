#include "ir/analysis/number_kinds.h"

#include <algorithm>
#include <cmath>

#include "ir/analysis/cfg.h"
#include "ir/analysis/unwritten_cells.h"

namespace ncport::ir::analysis {

namespace {

constexpr int kDigits = 12;

NumberKind Join(NumberKind a, NumberKind b) { return std::max(a, b); }

bool IsCount(Type type) { return type == Type::kInt || type == Type::kBool || type == Type::kChar; }

NumberKind OfLiteral(const Expr& literal) {
  if (literal.number == std::floor(literal.number) && std::fabs(literal.number) < 1e12) return NumberKind::kWhole;
  const bool plain = (literal.format.flags & (NumberFormat::kAsText | NumberFormat::kComputed)) == 0;
  return plain && literal.format.int_digits + literal.format.decimals <= kDigits ? NumberKind::kWritten
                                                                                   : NumberKind::kComputed;
}

}  // namespace

NumberKinds::NumberKinds(const Module& module, const CallGraph& calls, bool counters_round)
    : module_(module),
      counters_round_(counters_round),
      variables_(module.variables.Size(), NumberKind::kNever),
      any_cell_(module.spaces.Size(), NumberKind::kNever),
      whole_space_(module.spaces.Size(), NumberKind::kNever),
      input_space_(module.spaces.Size(), false) {
  const FlowGraphs graphs(module);
  for (const UnwrittenRead& read : UnwrittenCells(module, graphs, calls)) {
    if (read.cell == UnwrittenRead::kComputed) {
      input_space_[read.space.value] = true;
    } else {
      inputs_.emplace(read.space.value, read.cell);
    }
  }
  std::vector<bool> called(module.programs.Size(), false);
  for (const CallSite& site : calls.AllSites()) {
    if (site.callee.Valid()) called[site.callee.value] = true;
  }
  for (const ProgramId program : module.programs.Ids()) {
    const IdRange<VariableId> parameters = module.programs[program].parameters;
    if (called[program.value]) continue;
    // Callers that are not known: a person wrote the arguments.
    for (const VariableId parameter : parameters) Give(parameter, NumberKind::kWritten);
  }
  Run();
}

void NumberKinds::Give(VariableId variable, NumberKind kind) {
  const Variable& known = module_.variables[variable];
  // What is handed over by reference is written under another name too.
  if (known.by_reference) kind = NumberKind::kComputed;
  if (IsCount(known.type)) kind = NumberKind::kWhole;
  NumberKind& held = variables_[variable.value];
  if (Join(held, kind) == held) return;
  held = Join(held, kind);
  changed_ = true;
}

void NumberKinds::Give(ExprId place, NumberKind kind) {
  const Expr& expr = module_.exprs[place];
  const auto raise = [&](NumberKind& held) {
    if (Join(held, kind) == held) return;
    held = Join(held, kind);
    changed_ = true;
  };
  switch (expr.op) {
    case ExprOp::kVariable:
    case ExprOp::kElement:
      return Give(VariableId{expr.a}, kind);
    case ExprOp::kCell:
      raise(cells_[{expr.a, expr.b}]);
      return raise(whole_space_[expr.a]);
    case ExprOp::kCellAt:
      raise(any_cell_[expr.b]);
      return raise(whole_space_[expr.b]);
    case ExprOp::kGroup:
    case ExprOp::kConvert:
      return Give(ExprId{expr.a}, kind);
    default:
      return;  // system variables are computed anyhow
  }
}

NumberKind NumberKinds::OfCell(SpaceId space, std::uint32_t cell) const {
  if (IsCount(module_.spaces[space].type)) return NumberKind::kWhole;
  const auto known = cells_.find({space.value, cell});
  NumberKind kind = Join(known == cells_.end() ? NumberKind::kNever : known->second, any_cell_[space.value]);
  if (input_space_[space.value] || inputs_.contains({space.value, cell})) kind = Join(kind, NumberKind::kWritten);
  return kind;
}

NumberKind NumberKinds::Of(ExprId id) const {
  const Expr& expr = module_.exprs[id];
  const auto left = [&] { return Of(ExprId{expr.a}); };
  switch (expr.op) {
    case ExprOp::kLiteral:
      return OfLiteral(expr);
    case ExprOp::kVariable:
    case ExprOp::kElement: {
      if (IsCount(expr.type)) return NumberKind::kWhole;
      // Never written: the zero it starts with.
      return expr.a < variables_.size() ? Join(variables_[expr.a], NumberKind::kWhole) : NumberKind::kComputed;
    }
    case ExprOp::kCell:
      return Join(OfCell(SpaceId{expr.a}, expr.b), NumberKind::kWhole);
    case ExprOp::kCellAt: {
      if (IsCount(module_.spaces[SpaceId{expr.b}].type)) return NumberKind::kWhole;
      return Join(whole_space_[expr.b], NumberKind::kWritten);
    }
    case ExprOp::kConvert:
      return IsCount(expr.type) ? NumberKind::kWhole : left();
    case ExprOp::kGroup:
    case ExprOp::kNegate:
    case ExprOp::kPlus:
      return left();
    case ExprOp::kAdd:
    case ExprOp::kSubtract:
    case ExprOp::kModulo: {
      // A sum of counts is a count; a product may grow beyond what doubles tell apart.
      const NumberKind both = Join(left(), Of(ExprId{expr.b}));
      return both <= NumberKind::kWhole ? both : NumberKind::kComputed;
    }
    case ExprOp::kMultiply: {
      const NumberKind both = Join(left(), Of(ExprId{expr.b}));
      if (both == NumberKind::kNever) return both;
      const bool literal = module_.exprs[ExprId{expr.a}].op == ExprOp::kLiteral ||
                           module_.exprs[ExprId{expr.b}].op == ExprOp::kLiteral || IsCount(expr.type);
      return both == NumberKind::kWhole && literal ? both : NumberKind::kComputed;
    }
    case ExprOp::kDivideInteger:
    case ExprOp::kBitAnd:
    case ExprOp::kBitOr:
    case ExprOp::kBitXor:
    case ExprOp::kBitNot:
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
    case ExprOp::kLess:
    case ExprOp::kLessEqual:
    case ExprOp::kGreater:
    case ExprOp::kGreaterEqual:
    case ExprOp::kAnd:
    case ExprOp::kOr:
    case ExprOp::kXor:
    case ExprOp::kNot:
      return NumberKind::kWhole;
    case ExprOp::kFunction:
      switch (static_cast<Function>(expr.a)) {
        case Function::kTruncate:
        case Function::kRound:
        case Function::kRoundUp:
        case Function::kRoundAway:
          return NumberKind::kWhole;
        case Function::kAbs:
        case Function::kMinimum:
        case Function::kMaximum:
        case Function::kBound: {
          NumberKind kind = NumberKind::kNever;
          for (std::uint32_t i = 0; i < expr.count; ++i) kind = Join(kind, Of(module_.Item(expr.b + i)));
          return kind;
        }
        default:
          return NumberKind::kComputed;
      }
    default:
      return NumberKind::kComputed;
  }
}

void NumberKinds::ReadCall(const Call& call) {
  // An argument may be handed over by reference, which the caller's text does not always tell.
  const IdRange<VariableId> parameters =
      call.program.Valid() ? module_.programs[call.program].parameters : IdRange<VariableId>{};
  std::vector<bool> given(parameters.count, false);
  for (const ArgId id : call.args) {
    const Arg& arg = module_.args[id];
    if (!arg.value.Valid()) continue;
    if (arg.letter == 0 && arg.position < parameters.count) {
      const VariableId parameter = parameters[arg.position];
      given[arg.position] = true;
      if (module_.variables[parameter].by_reference) Give(arg.value, NumberKind::kComputed);
      // The call may be written anew by hand: its argument is at least a written number.
      Give(parameter, Join(Of(arg.value), NumberKind::kWritten));
    } else {
      Give(arg.value, NumberKind::kComputed);
    }
  }
  for (std::uint32_t i = 0; i < parameters.count; ++i) {
    const Variable& parameter = module_.variables[parameters[i]];
    if (given[i]) continue;
    Give(parameters[i], parameter.initial.Valid() ? Of(parameter.initial) : NumberKind::kWhole);
  }
}

void NumberKinds::Read(const Block& block) {
  for (const WordId id : block.words) {
    const Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kAssign:
        Give(word.Extra<ExprId>(), Of(word.value));
        break;
      case WordOp::kAssignList: {
        const AssignList& list = module_.assign_lists[word.Extra<AssignListId>()];
        if (list.place.Valid()) Give(list.place, NumberKind::kComputed);
        break;
      }
      case WordOp::kDefine: {
        const VariableId variable = word.Extra<VariableId>();
        const Variable& known = module_.variables[variable];
        if (known.initial.Valid()) Give(variable, Of(known.initial));
        if (known.initial_list.Valid()) Give(variable, NumberKind::kComputed);
        break;
      }
      case WordOp::kFor: {
        const For& loop = module_.fors[word.Extra<ForId>()];
        const NumberKind start = counters_round_ ? NumberKind::kWhole : Of(word.value);
        const NumberKind step = loop.step.Valid() ? Of(loop.step) : NumberKind::kWhole;
        const NumberKind both = Join(start, step);
        Give(loop.variable, both <= NumberKind::kWhole ? NumberKind::kWhole : NumberKind::kComputed);
        break;
      }
      case WordOp::kCall:
      case WordOp::kModalCall:
        if (word.Extra<CallId>().Valid()) ReadCall(module_.calls[word.Extra<CallId>()]);
        break;
      default:
        break;
    }
  }
}

void NumberKinds::Run() {
  // Each kind only climbs, so this ends.
  do {
    changed_ = false;
    for (const Program& program : module_.programs.All()) {
      for (const BlockId id : program.blocks) Read(module_.blocks[id]);
    }
  } while (changed_);
}

}  // namespace ncport::ir::analysis
