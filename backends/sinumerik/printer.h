// The printer of one module; print_*.cc hold its parts.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/text_buffer.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::backends::sinumerik {

class Printer {
 public:
  Printer(const ir::Module& module, const dialects::Profile& profile, TextBuffer& out)
      : module_(module), profile_(profile), out_(out) {}

  void Block(const ir::Block& block);

  /// `in`: binding strength of what stands around; the expression gets brackets when it binds weaker.
  void Expr(ir::ExprId id, int in = kAny);

 private:
  // Binding strength, tightest first (card 4.1). Comparisons bind weakest.
  static constexpr int kPrimary = 0, kUnary = 1, kSum = 3, kToText = 10, kConcat = 11, kAny = 100;

  // print_expr.cc
  static int StrengthOf(const ir::Expr& expr);
  static std::string_view OperatorOf(ir::ExprOp op);
  [[nodiscard]] bool IsSigned(ir::ExprId id) const;
  void Operand(const ir::Expr& expr);
  void Literal(const ir::Expr& expr);
  void Text(std::string_view text);
  void List(std::uint32_t first, std::uint32_t count);
  void AxisName(std::uint8_t axis);

  // print_words.cc
  void Word(const ir::Word& word);
  void Code(const ir::Word& word);
  void Axis(const ir::Word& word);
  void Address(const ir::Word& word);
  void AuxiliaryM(const ir::Word& word);
  void Value(const ir::Word& word);
  [[nodiscard]] bool NeedsEqualSign(const ir::Word& word, std::string_view name) const;
  std::string_view SpellingOf(const ir::Word& word) const {
    return module_.View(module_.spellings[word.spelling].text);
  }
  void PutNumber(std::uint32_t number, std::uint8_t digits);

  // print_flow.cc
  void Flow(const ir::Word& word);
  void Jump(ir::JumpId id);
  void Target(const ir::Target& target);
  void Switch(const ir::Word& word);
  void Call(ir::CallId id);
  void Arguments(IdRange<ir::ArgId> args);
  void Passes(ir::ExprId passes);
  void RepeatPart(const ir::Word& word);

  // print_definitions.cc
  void Define(const ir::Word& word, bool first);
  void Header(const ir::Word& word);
  void Extern(ir::ExternId id);
  void Type(ir::Type type, std::uint32_t string_length);
  void Dimensions(std::uint8_t count, const std::uint32_t* dimensions);
  void AssignList(ir::AssignListId id);

  const ir::Module& module_;
  const dialects::Profile& profile_;
  TextBuffer& out_;
};

}  // namespace ncport::backends::sinumerik
