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

namespace {

void AddAction(Recipe& recipe, antlr4::ParserRuleContext& rule, antlr4::Token* first) {
  const antlr4::Token* last = rule.getStop() != nullptr ? rule.getStop() : first;
  recipe.actions.push_back({static_cast<std::uint8_t>(first->getType()), 0, 0,
                            static_cast<std::uint16_t>(first->getTokenIndex()),
                            static_cast<std::uint16_t>(last->getTokenIndex())});
}

class FlatBlocks final : public GrammarParser<Parser> {
  void Compile(Parser::BlockContext& block, Recipe& recipe) override {
    Parser::StatementContext* statement = block.statement();
    if (statement == nullptr) return;
    if (statement->word().empty()) {
      AddAction(recipe, *statement, statement->getStart());
    } else {
      for (Parser::WordContext* word : statement->word()) AddAction(recipe, *word, word->getStart());
    }
  }
};

}  // namespace

std::unique_ptr<BlockParser> MakeParser() { return std::make_unique<FlatBlocks>(); }

}  // namespace ncport::frontend::iso
