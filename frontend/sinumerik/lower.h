// Replays a recipe on the tokens of a block: the one way from text to IR.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "dialects/profile.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/line_error.h"
#include "frontend/common/shape_cache.h"
#include "frontend/common/text_tables.h"
#include "frontend/common/token.h"
#include "frontend/sinumerik/reader_state.h"
#include "frontend/sinumerik/recipe.h"
#include "frontend/sinumerik/token_kind.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

class Lowering {
 public:
  Lowering(ir::Module& module, const dialects::Profile& profile, ReaderState& state);

  /// Adds the words of the block to the module and fills the head of `block`. False: Error() says why, and the records
  /// added must be taken back.
  bool Replay(const Recipe& recipe, std::span<const Token> tokens, std::string_view line, std::uint32_t line_number,
              ir::Block& block);
  /// Number, label and skip level only: for blocks that are refused.
  void ReplayHead(std::span<const Token> tokens, ir::Block& block);
  [[nodiscard]] const LineError& Error() const { return error_; }
  /// The block was a definition or nothing: definitions may follow.
  [[nodiscard]] bool OnlyDefinitions() const { return only_definitions_; }
  /// The block holds a definition behind executable blocks: a finding, though its words are kept. Null = none.
  [[nodiscard]] const LineError* Warning() const { return late_ ? &late_error_ : nullptr; }

 private:
  using Row = dialects::sinumerik::AddressRow;

  bool Do(const Action& action);
  bool DoValue(const Action& action);
  bool DoWord(const Action& action);
  bool DoFlow(const Action& action);
  bool DoCall(const Action& action);
  bool DoDefinition(const Action& action);
  bool Finish();

  // Values (lower_expression.cc).
  ir::ExprId PushExpr(const ir::Expr& expr, std::uint32_t begin, std::uint32_t length);
  ir::ExprId Literal(const Token& token);
  void List(ir::ExprOp op, std::uint32_t a, std::uint16_t count, const Action& action, ir::Type type = ir::Type::kNone);
  ir::ExprId Pop();
  bool AxisOf(const Token& token, std::uint8_t& axis);
  ir::SpaceId SpaceOf(std::uint8_t which);
  ir::SystemId SystemOf(const Token& token);
  [[nodiscard]] bool IsLiteral(ir::ExprId id) const;
  [[nodiscard]] bool LiteralInt(ir::ExprId id, std::uint32_t most, std::uint32_t& value) const;

  // Words (lower_words.cc).
  ir::Word& AddWord(ir::WordOp op, std::uint32_t first, std::uint32_t last);
  bool AddCode(const Token& token);
  bool AddConstant(const Token& token);
  bool AddAxis(const Action& action);
  bool AddAddress(const Action& action);
  bool AddComputedM(const Action& action);
  bool AddInertText(const Action& action);
  bool AddInertCall(const Action& action);
  bool OnceAxis(std::uint8_t axis, const Token& token);
  bool OnceAddress(std::uint32_t row, const Token& token);
  bool TakeMode(ir::Word& word, std::uint8_t allowed);
  std::uint16_t SpellingOf(std::string_view text, std::string_view rule) { return texts_.SpellingOf(text, rule); }
  std::uint16_t CodeSpelling(std::uint32_t row);
  std::uint16_t AddressSpelling(std::uint32_t row);

  // Calls and flow (lower_flow.cc).
  ir::Target TakeTarget();
  ir::JumpId AddJump(const Token& word);
  IdRange<ir::ArgId> TakeArguments(std::uint16_t count);

  // Definitions (lower_definitions.cc).
  bool Declare(const Action& action);
  void ClearDimensions();
  bool CheckName(const Token& token);
  bool TakeInitializer(const Action& action, ir::Variable& variable);
  bool EndProgramHeader(const Action& action);
  bool AddMacro(const Action& action);
  void NeedsDefinitionSection(const Token& token);

  [[nodiscard]] const Token& At(std::size_t index) const { return tokens_[index]; }
  [[nodiscard]] std::string_view TextOf(std::uint32_t begin, std::uint32_t end) const {
    return line_.substr(begin, end - begin);
  }
  [[nodiscard]] std::string_view TextOf(const Token& token) const { return TextOf(token.offset, token.End()); }
  /// Text of tokens `first` to `last` with the blanks between them.
  [[nodiscard]] std::string_view TextOf(const Action& action) const {
    return TextOf(At(action.first).offset, At(action.last).End());
  }
  bool Fail(diag::Code code, const Token& token, const char* help = nullptr, const char* detail = nullptr);

  ir::Module& module_;
  TextTables texts_;
  const dialects::Profile& profile_;
  ReaderState& state_;
  LineError error_;
  LineError late_error_;
  bool late_ = false;
  bool only_definitions_ = false;

  // Of the block at hand.
  std::span<const Token> tokens_;
  std::string_view line_;
  std::uint32_t line_number_ = 0;
  ir::Block* block_ = nullptr;
  std::uint32_t first_word_ = 0;
  const Token* mode_ = nullptr;
  const Token* dwell_ = nullptr;  // G4
  std::uint64_t groups_ = 0;      // G groups seen
  std::uint64_t addresses_ = 0;   // rows of Addresses() seen
  std::uint32_t axes_ = 0;
  std::vector<ir::ExprId> values_;
  std::vector<ir::Target> targets_;
  std::vector<ir::SwitchArm> arms_;
  struct Definition {
    ir::Scope scope = ir::Scope::kLocal;
    bool scoped = false;
    std::string attributes;
    ir::ExprId lower, upper;
    ir::Type type = ir::Type::kReal;
    std::uint32_t string_length = 0;
    std::uint32_t dimensions[3] = {0, 0, 0};
    std::uint8_t dimension_count = 0;
    std::uint8_t names = 0;
    StringId name;            // PROC, EXTERN
    std::uint32_t first = 0;  // first parameter
    bool saves = false;
  };
  Definition definition_;

  // Caches over all blocks: numbers of the module's records.
  std::vector<std::uint16_t> code_spellings_;
  std::vector<std::uint16_t> address_spellings_;
  std::unordered_map<std::uint32_t, ir::SystemId> systems_;  // StringId of the name in upper case
  ir::SpaceId spaces_[2];
};

}  // namespace ncport::frontend::sinumerik
