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

struct BlockParser::Session : ParseSession<Parser> {};

BlockParser::BlockParser() = default;
BlockParser::~BlockParser() = default;

namespace {

// What a person would call the only kind that fits.
const char* NameOfKind(std::size_t kind) {
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

}  // namespace

Recipe BlockParser::Parse(std::span<const Token> tokens) {
  if (session_ == nullptr) session_ = std::make_unique<Session>();
  Recipe recipe;
  auto* block = session_->Parse(tokens);
  if (block == nullptr) {
    recipe.failed = true;
    const FirstErrorStrategy& strategy = session_->Strategy();
    recipe.error.token = static_cast<std::uint16_t>(strategy.ErrorToken());
    recipe.error.expected = NameOfKind(strategy.OnlyExpected());
    recipe.error.code = recipe.error.expected != nullptr ? diag::Code::kExpectedText : diag::Code::kUnexpectedText;
    if (recipe.error.token < tokens.size()) {
      switch (static_cast<TokenKind>(tokens[recipe.error.token].kind)) {
        case TokenKind::kBlockNumber:
          recipe.error.help = "the block number stands at the start of the block";
          break;
        case TokenKind::kEqualTo:
        case TokenKind::kNotEqual:
        case TokenKind::kLess:
        case TokenKind::kLessEqual:
        case TokenKind::kGreater:
        case TokenKind::kGreaterEqual:
          recipe.error.help = "one comparison a pair of brackets";
          break;
        default:
          break;
      }
    }
    return recipe;
  }
  CompileBlock(*block, recipe);
  return recipe;
}

}  // namespace ncport::frontend::fanuc
