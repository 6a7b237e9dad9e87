// The header of the runtime stands last: EOF is a macro of the C library until ANTLR takes it away.
#include "frontend/fanuc/parser.h"

#include "FanucParser.h"
#include "frontend/common/parse_session.h"
#include "frontend/fanuc/compile.h"
#include "frontend/fanuc/token_kind.h"

namespace ncport::frontend::fanuc {

using Parser = grammar::fanuc::FanucParser;

#define NCPORT_TOKEN(Name)                                                                              \
  static_assert(static_cast<std::size_t>(TokenKind::k##Name) == static_cast<std::size_t>(Parser::Name), \
                "token_kinds.def and the grammar differ at " #Name);
#include "frontend/fanuc/token_kinds.def"

namespace {

class FanucBlocks final : public GrammarParser<Parser> {
  void Compile(Parser::BlockContext& block, Recipe& recipe) override { CompileBlock(block, recipe); }
  const char* NameOfKind(std::size_t kind) const override;
  void Explain(std::span<const Token> tokens, std::size_t expected, ShapeError& error) const override;
};

const char* FanucBlocks::NameOfKind(std::size_t kind) const {
  switch (static_cast<TokenKind>(kind)) {
    case TokenKind::kEquals:
      return "=";
    case TokenKind::kLeftBracket:
      return "[";
    case TokenKind::kRightBracket:
      return "]";
    case TokenKind::kComma:
      return ",";
    case TokenKind::kDo:
      return "DO";
    case TokenKind::kNumber:
      return "a number";
    default:
      return kind == antlr4::Token::EOF ? "the end of the block" : nullptr;
  }
}

void FanucBlocks::Explain(std::span<const Token> tokens, std::size_t /*expected*/, ShapeError& error) const {
  if (error.token >= tokens.size()) return;
  switch (static_cast<TokenKind>(tokens[error.token].kind)) {
    case TokenKind::kBlockNumber:
      error.help = "the block number stands at the start of the block";
      break;
    case TokenKind::kEqualTo:
    case TokenKind::kNotEqual:
    case TokenKind::kLess:
    case TokenKind::kLessEqual:
    case TokenKind::kGreater:
    case TokenKind::kGreaterEqual:
      error.help = "one comparison a pair of brackets";
      break;
    default:
      break;
  }
}

}  // namespace

std::unique_ptr<BlockParser> MakeParser() { return std::make_unique<FanucBlocks>(); }

}  // namespace ncport::frontend::fanuc
