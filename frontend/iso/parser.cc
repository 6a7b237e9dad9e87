// The header of the runtime stands last: EOF is a macro of the C library until ANTLR takes it away.
#include "frontend/iso/parser.h"

#include "IsoParser.h"
#include "frontend/common/parse_session.h"
#include "frontend/iso/token_kind.h"

namespace ncport::frontend::iso {

using Parser = grammar::iso::IsoParser;

#define NCPORT_TOKEN(Name)                                                                              \
  static_assert(static_cast<std::size_t>(TokenKind::k##Name) == static_cast<std::size_t>(Parser::Name), \
                "token_kinds.def and the grammar differ at " #Name);
#include "frontend/iso/token_kinds.def"

struct BlockParser::Session : ParseSession<Parser> {};

BlockParser::BlockParser() = default;
BlockParser::~BlockParser() = default;

namespace {

void AddAction(Recipe& recipe, antlr4::ParserRuleContext& rule, antlr4::Token* first) {
  const antlr4::Token* last = rule.getStop() != nullptr ? rule.getStop() : first;
  recipe.actions.push_back({static_cast<std::uint8_t>(first->getType()), 0, 0,
                            static_cast<std::uint16_t>(first->getTokenIndex()),
                            static_cast<std::uint16_t>(last->getTokenIndex())});
}

}  // namespace

Recipe BlockParser::Parse(std::span<const Token> tokens) {
  if (session_ == nullptr) session_ = std::make_unique<Session>();
  Recipe recipe;
  Parser::BlockContext* block = session_->Parse(tokens);
  if (block == nullptr) {
    recipe.failed = true;
    recipe.error.token = static_cast<std::uint16_t>(session_->Strategy().ErrorToken());
    recipe.error.code = diag::Code::kUnexpectedText;
    return recipe;
  }
  Parser::StatementContext* statement = block->statement();
  if (statement == nullptr) return recipe;
  if (statement->word().empty()) {
    AddAction(recipe, *statement, statement->getStart());
  } else {
    for (Parser::WordContext* word : statement->word()) AddAction(recipe, *word, word->getStart());
  }
  return recipe;
}

}  // namespace ncport::frontend::iso
