// The header of the runtime stands last: EOF is a macro of the C library until ANTLR takes it away.
#include "frontend/sinumerik/parser.h"

#include "SinumerikParser.h"
#include "frontend/common/parse_session.h"
#include "frontend/sinumerik/compile.h"
#include "frontend/sinumerik/token_kind.h"

namespace ncport::frontend::sinumerik {

using Parser = grammar::sinumerik::SinumerikParser;

#define NCPORT_TOKEN(Name)                                                                              \
  static_assert(static_cast<std::size_t>(TokenKind::k##Name) == static_cast<std::size_t>(Parser::Name), \
                "token_kinds.def and the grammar differ at " #Name);
#include "frontend/sinumerik/token_kinds.def"

namespace {

class SinumerikBlocks final : public GrammarParser<Parser> {
  void Compile(Parser::BlockContext& block, Recipe& recipe) override { CompileBlock(block, recipe); }
  const char* NameOfKind(std::size_t kind) const override;
  void Explain(std::span<const Token> tokens, std::size_t expected, ShapeError& error) const override;
};

const char* SinumerikBlocks::NameOfKind(std::size_t kind) const {
  switch (static_cast<TokenKind>(kind)) {
    case TokenKind::kEquals:
      return "=";
    case TokenKind::kLeftParen:
      return "(";
    case TokenKind::kRightParen:
      return ")";
    case TokenKind::kLeftBracket:
      return "[";
    case TokenKind::kRightBracket:
      return "]";
    case TokenKind::kComma:
      return ",";
    case TokenKind::kTo:
      return "TO";
    case TokenKind::kOf:
      return "OF";
    case TokenKind::kAs:
      return "AS";
    case TokenKind::kName:
      return "a name";
    case TokenKind::kPath:
      return "a path";
    default:
      return nullptr;
  }
}

/// Kinds that words of the language make, as against numbers, addresses, operators.
bool IsReserved(TokenKind kind) {
  switch (kind) {
    case TokenKind::kAxisAt:
    case TokenKind::kBoolean:
    case TokenKind::kDivideInteger:
    case TokenKind::kModulo:
      return true;
    default:
      return kind >= TokenKind::kFunction && kind <= TokenKind::kInertCall && kind != TokenKind::kPath;
  }
}

void SinumerikBlocks::Explain(std::span<const Token> tokens, std::size_t expected, ShapeError& error) const {
  const auto kind_at = [&](std::size_t token) {
    return token < tokens.size() ? static_cast<TokenKind>(tokens[token].kind) : TokenKind::kNone;
  };
  const std::size_t at = error.token;
  // A name in the middle of a block that no `=` follows is a call that does not stand alone, or a word nobody knows.
  const bool call_before = at > 0 && expected == Parser::Equals && kind_at(at - 1) == TokenKind::kName;
  if (call_before || kind_at(at) == TokenKind::kSubName) {
    error.code = diag::Code::kNotAlone;
    error.token = static_cast<std::uint16_t>(call_before ? at - 1 : at);
    error.expected = nullptr;
    error.help = "a subprogram call has a block of its own; a variable is set with =";
  } else if (expected == Parser::Name && IsReserved(kind_at(at))) {
    error.code = diag::Code::kReservedName;
    const bool second_type = kind_at(at) == TokenKind::kType && at > 0 && kind_at(at - 1) == TokenKind::kComma;
    if (second_type && kind_at(0) == TokenKind::kDef)
      error.help = "a DEF names one type: the next one begins a DEF of its own";
  } else if (expected == Parser::Equals && at > 0 && at >= tokens.size() && kind_at(at - 1) == TokenKind::kAxis) {
    error.code = diag::Code::kMissingValue;
    error.token = static_cast<std::uint16_t>(at - 1);
    error.expected = nullptr;
  } else if (kind_at(at) == TokenKind::kBlockNumber) {
    error.help = "the block number stands at the start of the block";
  }
}

}  // namespace

std::unique_ptr<BlockParser> MakeParser() { return std::make_unique<SinumerikBlocks>(); }

}  // namespace ncport::frontend::sinumerik
