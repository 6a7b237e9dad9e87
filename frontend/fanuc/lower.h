// Replays a recipe on the tokens of a block: the one way from text to IR. Words with a letter are collected first; what
// they mean together is decided at the end of the block (fanuc-1: the order of the words is free).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "dialects/fanuc/system_variables.h"
#include "dialects/fanuc/words.h"
#include "dialects/profile.h"
#include "frontend/common/line_error.h"
#include "frontend/common/shape_cache.h"
#include "frontend/common/text_tables.h"
#include "frontend/common/token.h"
#include "frontend/fanuc/code_index.h"
#include "frontend/fanuc/reader_state.h"
#include "frontend/fanuc/recipe.h"
#include "frontend/fanuc/token_source.h"
#include "ir/module.h"

namespace ncport::frontend::fanuc {

class Lowering {
 public:
  Lowering(ir::Module& module, const dialects::Profile& profile, dialects::fanuc::System system, ReaderState& state);

  /// Adds the words of the block to the module and fills the head of `block`. False: Error() says why, and the records
  /// added must be taken back.
  bool Replay(const Recipe& recipe, std::span<const Token> tokens, std::span<const CommentPart> comments,
              std::string_view line, ir::Block& block);
  /// Number and skip level only: for blocks that are refused.
  void ReplayHead(std::span<const Token> tokens, ir::Block& block);
  [[nodiscard]] const LineError& Error() const { return error_; }
  /// True if Replay() went through and left a word out for which Error() warns.
  [[nodiscard]] bool Repeated() const { return repeated_; }
  /// Comment that is the text of an alarm or message, by its number; kNoComment = none.
  static constexpr std::uint32_t kNoComment = 0xFFFFFFFFU;
  [[nodiscard]] std::uint32_t TextComment() const { return text_comment_; }

 private:
  using Special = dialects::fanuc::Special;

  /// A word with a letter that waits for the end of the block.
  struct Pending {
    char letter = 0;  // kNameLetter, kSkipLetter for what is no letter
    std::uint16_t first = 0, last = 0;
    ir::ExprId value;     // invalid: a literal
    CodeMeaning meaning;  // of G and M literals
  };
  static constexpr char kNameLetter = '<';
  static constexpr char kSkipLetter = '/';
  /// What the codes of the block make of its letters.
  struct Context {
    const Pending* call = nullptr;  // G65 G66 G66.1
    const Pending* data = nullptr;  // G10, G22 with limits
    Special call_kind = Special::kMacroCall;
    bool dwell = false, frame = false, rotation = false, scaling = false, preset = false;
    bool extended_offset = false, subprogram = false, local_call = false, returns = false, quiet = false;
    bool reference = false, arc = false, thread = false, spindle = false, offset = false, diameter_switch = false;
    bool length_switch = false;   // G43, G44
    bool turning_offset = false;  // G43 P1 of a multi-tasking machine
    const dialects::fanuc::CycleRow* cycle = nullptr;
    bool cycle_block_numbers = false;  // a repetitive cycle with P and Q: its second block
    const Pending* subprogram_word = nullptr;
    std::uint8_t spindle_index = kMainSpindle;
  };

  bool Do(const Action& action);
  bool DoValue(const Action& action);
  bool DoStatement(const Action& action);
  bool Finish();

  // Values (lower_expression.cc).
  ir::ExprId PushExpr(const ir::Expr& expr, std::uint32_t begin, std::uint32_t length);
  ir::ExprId Literal(const Token& token);
  ir::ExprId Implied(double number);
  ir::ExprId Text(std::string_view text);
  ir::ExprId Pop();
  bool PushCell(const Token& token, bool written);
  bool PushSystem(const Token& token, const dialects::fanuc::SystemRange& range);
  bool Unary(const Action& action);
  bool Binary(const Action& action);
  bool CallFunction(const Action& action);
  [[nodiscard]] bool IsCondition(ir::ExprId id) const;
  bool NeedCondition(ir::ExprId id, const Action& action);
  bool NeedNumber(ir::ExprId id);
  ir::ExprId List(ir::ExprOp op, std::uint32_t a, std::span<const ir::ExprId> items, ir::Type type, std::uint8_t flags);
  [[nodiscard]] ir::SpaceId SpaceOf(std::uint32_t number) const;
  ir::SystemId SystemOf(std::uint32_t number, const dialects::fanuc::SystemRange& range);

  // Statements (lower_statement.cc).
  bool Assign(const Action& action);
  bool AddControl(dialects::fanuc::Control control, ir::ExprId value, const Action& action);
  bool Jump(const Action& action);
  bool When(const Action& action);
  bool Mark(const Action& action);

  // Codes (lower_codes.cc).
  [[nodiscard]] bool IsRepeated(const Pending& before, const Pending& pending) const;
  void DropRepeated();
  bool Scan(Context& context);
  bool AddCode(const Pending& pending, const Context& context);
  bool AddSpecial(const Pending& pending, const Context& context);
  bool AddTurningOffset(const Pending& pending);

  // Words (lower_words.cc).
  bool AddPending(const Pending& pending, const Context& context);
  bool AddAxis(const Pending& pending, const Context& context, const dialects::fanuc::AddressRow& row);
  bool AddLetter(const Pending& pending, const Context& context, const dialects::fanuc::AddressRow& row);
  bool AddTool(const Pending& pending);
  bool AddFeed(const Pending& pending);
  bool AddStartAngle(const Pending& pending, std::string_view rule);
  bool AddOption(const Pending& pending);
  bool AddCycleWord(const Pending& pending, const Context& context, bool& done);
  bool Meaningless(const Pending& pending);
  /// Value of a word whose number is a length or an angle (`scaled`) or whole.
  bool SetValue(ir::Word& word, const Pending& pending, bool scaled);
  bool Whole(const Pending& pending);
  [[nodiscard]] bool IsLiteral(const Pending& pending) const { return !pending.value.Valid(); }
  [[nodiscard]] double NumberOf(const Pending& pending) const { return At(pending.first).number; }
  [[nodiscard]] bool HasPoint(const Pending& pending) const {
    return (At(pending.first).format.flags & ir::NumberFormat::kPoint) != 0;
  }
  [[nodiscard]] bool AxisExists(std::uint8_t axis) const { return axis < 16 && (axes_ >> axis & 1U) != 0; }
  ir::Word& AddWord(ir::WordOp op, const Pending& pending);
  ir::Word& AddWord(ir::WordOp op, std::uint32_t first, std::uint32_t last);
  std::uint16_t SpellingOf(std::string_view text, std::string_view rule) { return texts_.SpellingOf(text, rule); }

  // Calls (lower_calls.cc).
  bool MacroCall(const Context& context);
  bool MacroArguments(const Context& context, IdRange<ir::ArgId>& args);
  bool Subprogram(const Context& context);
  bool Callee(const Pending* program, const Pending* name, const Pending& at, ir::Call& call);
  bool Return(const Context& context, const Pending& pending);
  bool DataSetting(const Context& context);
  [[nodiscard]] const Pending* FindLetter(char letter) const;
  /// Some word of the block has the letter of an axis.
  [[nodiscard]] bool NamesAxes() const;
  ir::ExprId ValueOf(const Pending& pending, std::uint8_t& flags);

  [[nodiscard]] const Token& At(std::size_t index) const { return tokens_[index]; }
  [[nodiscard]] std::string_view TextOf(const Token& token) const { return line_.substr(token.offset, token.length); }
  bool Fail(diag::Code code, const Token& token, const char* help = nullptr, const char* detail = nullptr);
  bool Fail(diag::Code code, const Pending& pending, const char* help = nullptr, const char* detail = nullptr);

  ir::Module& module_;
  TextTables texts_;
  const dialects::Profile& profile_;
  const dialects::fanuc::System system_;
  ReaderState& state_;
  CodeIndex codes_;
  std::uint16_t axes_ = 0;  // bit per axis of the profile
  std::vector<std::uint8_t> axis_order_;
  bool increments_ = true;  // profile `point`
  LineError error_;

  // Of the block at hand.
  std::span<const Token> tokens_;
  std::span<const CommentPart> comments_;
  std::string_view line_;
  ir::Block* block_ = nullptr;
  std::uint32_t first_word_ = 0;
  std::uint32_t text_comment_ = kNoComment;
  std::vector<ir::ExprId> values_;
  std::vector<Pending> pending_;
  const Token* statement_ = nullptr;  // first assignment, jump or print
  bool macro_block_ = false;          // G65 or G66: its words are arguments
  std::uint8_t index_depth_ = 0;      // inside #[..]
  const Token* word_ = nullptr;       // letter of the word whose value is made
  bool skips_ = false;                // an inner skip mark stands in the block
  bool repeated_ = false;             // an address stood twice

  // Caches over all blocks: numbers of the module's records.
  std::unordered_map<std::uint32_t, ir::SystemId> systems_;  // by number
};

}  // namespace ncport::frontend::fanuc
