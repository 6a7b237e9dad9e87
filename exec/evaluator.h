// Values of expressions and the places they are stored in.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "base/text_buffer.h"
#include "exec/channel.h"
#include "exec/memory.h"
#include "exec/session.h"
#include "exec/texts.h"

namespace ncport::exec {

/// What the flow of calls tells about the program that is running.
struct CallFacts {
  ir::ProgramId program;
  Memory::Address frame = 0;       // named variables of the program
  Memory::Address level = 0;       // cells of the call level
  Memory::Address main_frame = 0;  // of the entry program
  ir::ProgramId main_program;
  std::uint32_t depth = 0;  // 0 = main program
  bool modal_call = false;  // one is active
  std::uint64_t given = 0;  // bit per parameter that the call gave, from 0
};

/// A place that can be written.
struct Place {
  enum class Kind : std::uint8_t { kNone, kCell, kCharacter, kSystem, kVacant /* #0: always empty */ };
  Kind kind = Kind::kNone;
  ir::Type type = ir::Type::kAny;  // kCell: type that a stored value gets
  Memory::Address address = 0;
  std::uint32_t string_length = 0;               // of a STRING; 0 = the machine's longest
  std::uint32_t index = 0;                       // kCharacter
  ir::VariableId variable;                       // for limits and messages
  ir::ExprId expr;                               // kSystem: a named one
  const ir::NumberedSystem* numbered = nullptr;  // kSystem: one by number
  std::uint32_t number = 0;                      // of it
  std::uint32_t room = 1;                        // elements from here to the end of the array
  double cell_max = 0;                           // numbered cells: largest magnitude, 0 = any
};

class Evaluator {
 public:
  Evaluator(Session& session, Memory& memory, Texts& texts, const Channel& channel, const CallFacts& facts);

  /// Value of an expression. After an error the session is halted and the value is harmless.
  Value Eval(ir::ExprId id);
  /// Value as a number; vacant counts as 0.
  double Number(ir::ExprId id) { return ToNumber(Eval(id)); }
  bool Truth(ir::ExprId id) { return ToTruth(Eval(id)); }
  [[nodiscard]] bool ToTruth(const Value& value) const;
  double ToNumber(const Value& value);
  /// Text of any value as `<<` writes it.
  void AppendText(TextBuffer& buffer, const Value& value);
  [[nodiscard]] std::string_view TextOf(const Value& value) const { return texts_.View(value); }

  /// Least increment of the word that is being evaluated, in its unit.
  [[nodiscard]] double WordIncrement() const;
  /// The place that an expression names; kNone after an error.
  Place PlaceOf(ir::ExprId id);
  /// The first element of a variable, by its definition.
  Place VariablePlace(ir::VariableId id);
  /// A number as it is written.
  static Value LiteralOf(const ir::Expr& expr) { return {LiteralType(expr), 0, expr.number}; }
  static ir::Type LiteralType(const ir::Expr& expr) {
    const bool typed = expr.type == ir::Type::kInt || expr.type == ir::Type::kBool || expr.type == ir::Type::kChar;
    return typed ? expr.type : ir::Type::kReal;
  }
  /// The value at a place.
  Value Load(const Place& place);
  /// Element `offset` behind the one that the place names.
  void Store(const Place& place, const Value& value, std::uint32_t offset = 0);
  /// `value` as a value of `type`; alarms when it does not fit.
  Value Converted(const Value& value, ir::Type type, std::uint32_t string_length = 0);

  /// A variable as a by-reference argument: the address of its first element and how many follow.
  static constexpr ir::Type kReference = ir::Type::kFrame;  // tag of such a cell; FRAME values do not live in memory
  Value ReferenceTo(ir::ExprId id);

  std::string_view AxisName(std::uint8_t axis) const;

 private:
  Value EvalStored(ir::ExprId id, const ir::Expr& expr);
  Value EvalUnary(const ir::Expr& expr);
  Value EvalArithmetic(ir::ExprId id, const ir::Expr& expr);
  Value EvalComparison(const ir::Expr& expr);
  Value EvalBits(const ir::Expr& expr);
  Value EvalFunction(const ir::Expr& expr);
  Value EvalTextFunction(const ir::Expr& expr);
  Value EvalFormat(const ir::Expr& expr);
  Value EvalConcat(const ir::Expr& expr);
  Value EvalSystem(const ir::Expr& expr);
  Value ModalGroup(double group) const;
  bool IsKnownVariable(std::string_view name) const;

  Place ElementPlace(const ir::Expr& expr);
  Place CellPlace(ir::SpaceId space, double number);
  Memory::Address AddressOf(ir::VariableId id, const ir::Variable& variable);
  std::uint32_t Index(ir::ExprId id, std::uint32_t count, std::string_view name, bool& ok);
  void StoreSystem(const Place& place, const Value& value);
  Value ReadSystem(const ir::System& system, std::uint32_t key, std::string_view name, const Value* indices,
                   std::size_t count);
  Value ReadNumbered(const Place& place);
  void StoreNumbered(const Place& place, const Value& value);
  void StoreCharacter(const Place& place, const Value& value);
  bool WithinLimits(const ir::Variable& variable, const Value& value);
  double Operand(const Value& value, const ir::Expr& expr);
  Value Finished(ir::ops::Number number, const ir::Expr& expr, bool integer);
  void NoteQuotient(ir::ExprId id, double numerator, double denominator);
  Value NewText(std::string_view text);

  Session& session_;
  const ir::Module& module_;
  const ir::Machine& machine_;
  Memory& memory_;
  Texts& texts_;
  const Channel& channel_;
  const CallFacts& facts_;

  std::unordered_map<std::uint64_t, Value> user_cells_;  // SystemKind::kUserMemory: system << 32 | index
};

}  // namespace ncport::exec
