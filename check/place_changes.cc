#include "check/place_changes.h"

#include <algorithm>

namespace ncport::check {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

PlaceChanges::PlaceChanges(const ir::Module& module)
    : module_(module), has_modal_(std::ranges::any_of(module.words.All(), [](const ir::Word& word) {
        return word.op == WordOp::kModalCall;
      })) {}

PlacesRead PlaceChanges::ReadsOf(ir::ProgramId program, ExprId expr) const {
  PlacesRead read;
  Read(program, expr, read);
  return read;
}

void PlaceChanges::Read(ir::ProgramId program, ExprId id, PlacesRead& read) const {
  const Expr& expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kVariable: {
      const ir::Variable& variable = module_.variables[ir::VariableId{std::size_t{expr.a}}];
      if (variable.by_reference) read.known = false;
      read.shared = read.shared || variable.owner != program ||
                    (variable.scope != ir::Scope::kLocal && variable.scope != ir::Scope::kParameter);
      read.places.emplace(0, expr.a);
      return;
    }
    case ExprOp::kCell:
      read.shared = true;
      read.places.emplace(1, std::uint64_t{expr.a} << 32U | expr.b);
      return;
    case ExprOp::kElement:
    case ExprOp::kCellAt:
    case ExprOp::kSystem:
    case ExprOp::kName:
    case ExprOp::kText:
    case ExprOp::kConcat:
      read.known = false;
      return;
    case ExprOp::kFunction:
      if (static_cast<ir::Function>(expr.a) > ir::Function::kAddDecimalPoint) {
        read.known = false;
        return;
      }
      break;
    default:
      break;
  }
  ForOperands(module_, expr, [&](ExprId operand) { Read(program, operand, read); });
}

bool PlaceChanges::Writes(ExprId place, const PlacesRead& read) const {
  const Expr& expr = module_.exprs[place];
  switch (expr.op) {
    case ExprOp::kVariable:
      return read.places.contains({0, expr.a});
    case ExprOp::kCell:
      return read.places.contains({1, std::uint64_t{expr.a} << 32U | expr.b});
    case ExprOp::kElement:
      return false;
    default:
      return true;
  }
}

bool PlaceChanges::Changes(const ir::Word& word, const PlacesRead& read) const {
  switch (word.op) {
    case WordOp::kAssign:
      return Writes(word.Extra<ExprId>(), read);
    case WordOp::kFor:
      return Writes(module_.fors[word.Extra<ir::ForId>()].variable, read);
    case WordOp::kDefine:
      return read.places.contains({0, word.extra});
    case WordOp::kAssignList:
    case WordOp::kVerbatim:
      return true;
    case WordOp::kModalCall:
      return read.shared;
    case WordOp::kCall: {
      if (read.shared) return true;
      if (!word.Extra<ir::CallId>().Valid()) return true;
      const ir::Call& call = module_.calls[word.Extra<ir::CallId>()];
      if (call.form == ir::CallForm::kBlockRange || call.from_block) return true;
      for (const ir::ArgId arg : call.args) {
        const ExprId value = module_.args[arg].value;
        if (value.Valid() && module_.exprs[value].op == ExprOp::kVariable && Writes(value, read)) return true;
      }
      return false;
    }
    default:
      // Motion runs a modal subprogram, which may write what all see.
      return read.shared && word.phase == ir::Phase::kMotion && has_modal_;
  }
}

bool PlaceChanges::AnyChanges(BlockId first, BlockId last, const PlacesRead& read) const {
  for (std::uint32_t i = first.value; i <= last.value; ++i) {
    for (const ir::WordId id : module_.blocks[BlockId{std::size_t{i}}].words) {
      if (Changes(module_.words[id], read)) return true;
    }
  }
  return false;
}

bool PlaceChanges::Unchanged(ir::ProgramId program, ExprId expr, BlockId first, BlockId last) const {
  const PlacesRead read = ReadsOf(program, expr);
  return read.known && !AnyChanges(first, last, read);
}

}  // namespace ncport::check
