// The header of the runtime stands last: EOF is a macro of the C library until ANTLR takes it away.
#include "frontend/sinumerik/parser.h"

#include "frontend/sinumerik/compile.h"
#include "frontend/sinumerik/token_kind.h"

#include "frontend/common/parse_session.h"

#include "SinumerikParser.h"

namespace ncport::frontend::sinumerik {

using Parser = grammar::sinumerik::SinumerikParser;

#define NCPORT_TOKEN(Name)                                                                       \
  static_assert(static_cast<std::size_t>(TokenKind::k##Name) == static_cast<std::size_t>(Parser::Name), \
                "token_kinds.def and the grammar differ at " #Name);
#include "frontend/sinumerik/token_kinds.def"

struct BlockParser::Session : ParseSession<Parser> {};

BlockParser::BlockParser() = default;
BlockParser::~BlockParser() = default;

namespace {

// What a person would call the only kind that fits.
const char* NameOfKind(std::size_t kind) {
  switch (static_cast<TokenKind>(kind)) {
    case TokenKind::kEquals: return "=";
    case TokenKind::kLeftParen: return "(";
    case TokenKind::kRightParen: return ")";
    case TokenKind::kLeftBracket: return "[";
    case TokenKind::kRightBracket: return "]";
    case TokenKind::kComma: return ",";
    case TokenKind::kTo: return "TO";
    case TokenKind::kOf: return "OF";
    case TokenKind::kAs: return "AS";
    case TokenKind::kName: return "a name";
    case TokenKind::kPath: return "a path";
    default: return kind == antlr4::Token::EOF ? "the end of the block" : nullptr;
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
    // Why words that look right do not fit where they stand.
    if (recipe.error.token < tokens.size()) {
      switch (static_cast<TokenKind>(tokens[recipe.error.token].kind)) {
        case TokenKind::kName:
        case TokenKind::kSubName: recipe.error.help = "a subprogram call stands alone in its block"; break;
        case TokenKind::kBlockNumber: recipe.error.help = "the block number stands at the start of the block"; break;
        default: break;
      }
    }
    return recipe;
  }
  CompileBlock(*block, recipe);
  return recipe;
}

}  // namespace ncport::frontend::sinumerik
