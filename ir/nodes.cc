#include "ir/nodes.h"

#include <array>
#include <cstddef>

namespace ncport::ir {

namespace {

struct WordRow {
  std::string_view name;
  ValueUse value;
  Phase phase;
};
constexpr WordRow kWords[] = {
#define NCPORT_WORD(Name, text, value, phase) {text, ValueUse::value, Phase::phase},
#include "ir/nodes.def"
};

struct ExprRow {
  std::string_view name;
  Operands operands;
};
constexpr ExprRow kExprs[] = {
#define NCPORT_EXPR(Name, text, operands) {text, Operands::operands},
#include "ir/nodes.def"
};

struct FunctionRow {
  std::string_view name;
  Arity arity;
};
constexpr FunctionRow kFunctions[] = {
#define NCPORT_FUNCTION(Name, text, min_args, max_args) {text, {min_args, max_args}},
#include "ir/nodes.def"
};

constexpr std::string_view kTypes[] = {"none",   "int",  "real",  "bool",   "char",
                                       "string", "axis", "frame", "number", "any"};
static_assert(std::size(kTypes) == static_cast<std::size_t>(Type::kAny) + 1);

// Modules under verification may hold values outside the lists: their names are empty.
template <class Row, std::size_t kCount, class Enum>
constexpr const Row* Find(const Row (&rows)[kCount], Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < kCount ? &rows[index] : nullptr;
}

}  // namespace

std::string_view NameOf(WordOp op) {
  const WordRow* const row = Find(kWords, op);
  return row != nullptr ? row->name : std::string_view{};
}

std::string_view NameOf(ExprOp op) {
  const ExprRow* const row = Find(kExprs, op);
  return row != nullptr ? row->name : std::string_view{};
}

std::string_view NameOf(Function function) {
  const FunctionRow* const row = Find(kFunctions, function);
  return row != nullptr ? row->name : std::string_view{};
}

std::string_view NameOf(Type type) {
  const auto index = static_cast<std::size_t>(type);
  return index < std::size(kTypes) ? kTypes[index] : std::string_view{};
}

ValueUse ValueUseOf(WordOp op) {
  const WordRow* const row = Find(kWords, op);
  return row != nullptr ? row->value : ValueUse::kMay;
}

Phase DefaultPhaseOf(WordOp op) {
  const WordRow* const row = Find(kWords, op);
  return row != nullptr ? row->phase : Phase::kImmediate;
}

Operands OperandsOf(ExprOp op) {
  const ExprRow* const row = Find(kExprs, op);
  return row != nullptr ? row->operands : Operands::kLeaf;
}

Arity ArityOf(Function function) {
  const FunctionRow* const row = Find(kFunctions, function);
  return row != nullptr ? row->arity : Arity{};
}

bool IsStructureMark(WordOp op) { return op >= WordOp::kIf && op <= WordOp::kEndFor; }

}  // namespace ncport::ir
