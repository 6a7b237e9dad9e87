// Builds modules by hand: for tests, passes and the generator of random programs.
//
//   ExprBuilder e(module);
//   ProgramBuilder program(module, "RING", ProgramKind::kSub);
//   program.Block(1).Motion(Motion::kLinear).Axis(0, e.Number("10.5")).Finish();
//   program.Finish();
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "ir/module.h"

namespace ncport::ir {

/// Makes expressions. Types are those of the operands' language: where none is given, numbers are kReal.
class ExprBuilder {
 public:
  explicit ExprBuilder(Module& module) : module_(module) {}

  /// A literal with the digits of `written` ("010.50", "-.5", "+3."). Anything else is a bug of the caller.
  ExprId Number(std::string_view written, Type type = Type::kReal);
  /// A value that no source wrote: printers choose its decimals. Must be finite.
  ExprId Literal(double value, Type type = Type::kReal);
  /// A number whose written form no digits describe (exponent, hexadecimal): `spelling` is printed.
  ExprId Spelled(std::string_view spelling, double value, Type type = Type::kReal);
  ExprId Text(std::string_view text);
  ExprId Vacant();
  ExprId AxisName(std::uint8_t axis);
  ExprId Variable(VariableId variable);
  ExprId Element(VariableId variable, std::initializer_list<ExprId> indices);
  ExprId Cell(SpaceId space, std::uint32_t number);
  ExprId CellAt(SpaceId space, ExprId number);
  ExprId System(SystemId system, std::initializer_list<ExprId> indices = {});
  ExprId Name(std::string_view name, std::initializer_list<ExprId> indices = {});
  ExprId Convert(ExprId operand, Type type);
  /// Group, Plus, Negate, Not, BitNot. The type is the operand's.
  ExprId Unary(ExprOp op, ExprId operand);
  /// Comparisons and And, Or, Xor are kBool; the others take the type of the left side.
  ExprId Binary(ExprOp op, ExprId left, ExprId right, std::uint8_t flags = 0);
  ExprId Function(ir::Function function, std::initializer_list<ExprId> arguments, Type type = Type::kReal);

 private:
  ExprId List(ExprOp op, std::uint32_t a, Type type, std::initializer_list<ExprId> items);

  Module& module_;
};

/// One block, added to the module by Finish(). What a method sets stands in the block in the order of the calls.
class BlockBuilder {
 public:
  explicit BlockBuilder(Module& module, OriginId origin = {}) : module_(module) { block_.origin = origin; }

  BlockBuilder& Number(std::uint32_t number);
  BlockBuilder& Label(std::string_view label);
  BlockBuilder& Skip(std::uint8_t level);
  BlockBuilder& Indent(std::uint16_t blanks);
  BlockBuilder& Flags(std::uint8_t flags);
  /// `word`: index of the word that a kBeforeWord comment stands before.
  BlockBuilder& Comment(std::string_view text, CommentPlace place = CommentPlace::kEndOfBlock, std::uint16_t word = 0);

  /// Any word as it is.
  BlockBuilder& Add(const Word& word);
  /// A word with the phase of its row in nodes.def.
  BlockBuilder& Add(WordOp op, ExprId value = {}, std::uint8_t index = 0, std::uint32_t extra = Id<void>::kNone);
  BlockBuilder& Motion(ir::Motion motion) { return Add(WordOp::kMotion, {}, static_cast<std::uint8_t>(motion)); }
  BlockBuilder& Axis(std::uint8_t axis, ExprId value, ValueMode mode = ValueMode::kModal);
  BlockBuilder& Assign(ExprId place, ExprId value) { return Add(WordOp::kAssign, value, 0, place.value); }
  BlockBuilder& Jump(std::string_view label, Search search, ExprId condition = {});
  BlockBuilder& JumpToNumber(std::uint32_t number, Search search, ExprId condition = {});
  /// Positional arguments; an invalid one is missing.
  BlockBuilder& Call(ProgramId program, std::initializer_list<ExprId> arguments = {}, ExprId passes = {});
  BlockBuilder& RepeatPart(std::string_view first, std::string_view last, ExprId count);
  BlockBuilder& For(ExprId variable, ExprId start, ExprId end, ExprId step = {});
  /// Changes the last word: attributes that the calls above leave at their defaults.
  Word& Last() { return words_.back(); }

  /// Ends the block and returns its id. Nothing may be added afterwards.
  BlockId Finish();

 private:
  Module& module_;
  ir::Block block_;
  std::vector<Word> words_;
  std::vector<ir::Comment> comments_;
};

/// One program at the end of the module. Its blocks are made through it, one after the other.
class ProgramBuilder {
 public:
  ProgramBuilder(Module& module, std::string_view name, ProgramKind kind = ProgramKind::kMain, FileId file = {});

  [[nodiscard]] ProgramId Id() const { return id_; }
  /// Parameters stand together: all of them before the first local.
  VariableId Parameter(std::string_view name, Type type = Type::kReal, bool by_reference = false);
  VariableId Local(std::string_view name, Type type = Type::kReal, std::span<const std::uint32_t> dimensions = {});
  /// The next block, from line `line` of the program's file (0: the line after that of the block before).
  BlockBuilder Block(std::uint32_t line = 0);
  /// Gives the program the blocks made since its start.
  void Finish();

 private:
  VariableId AddVariable(std::string_view name, Type type, Scope scope);

  Module& module_;
  ProgramId id_;
  std::uint32_t line_ = 0;
};

/// The file of that name, new if it is not known.
FileId AddFile(Module& module, std::string_view name);
SpaceId AddSpace(Module& module, std::string_view name, std::uint32_t first, std::uint32_t last,
                 Type type = Type::kReal, StartValue start = StartValue::kZero);
SystemId AddSystem(Module& module, std::string_view name, SystemKind kind, Type type = Type::kReal);
/// Index for Word::spelling; each pair stands once. 0 when the table is full (65,535 rows).
std::uint16_t AddSpelling(Module& module, std::string_view text, std::string_view rule);
OriginId AddOrigin(Module& module, FileId file, std::uint32_t line, OriginId via = {}, std::uint32_t turn = 0,
                   std::string_view pass = {});

}  // namespace ncport::ir
