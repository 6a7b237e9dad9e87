#include "frontend/fanuc/compile.h"

#include <vector>

#include "FanucParser.h"
#include "base/result.h"
#include "frontend/fanuc/recipe.h"
#include "frontend/fanuc/token_kind.h"
#include "ir/nodes.h"

namespace ncport::frontend::fanuc {

namespace {

using P = grammar::fanuc::FanucParser;
using Node = antlr4::tree::TerminalNode;
using Rule = antlr4::ParserRuleContext;
using ir::ExprOp;
using ir::WordOp;

std::uint16_t Index(Node* node) { return static_cast<std::uint16_t>(node->getSymbol()->getTokenIndex()); }
std::uint16_t First(Rule* rule) { return static_cast<std::uint16_t>(rule->getStart()->getTokenIndex()); }
std::uint16_t Last(Rule* rule) {
  const auto* stop = rule->getStop() != nullptr ? rule->getStop() : rule->getStart();
  return static_cast<std::uint16_t>(stop->getTokenIndex());
}

// AND OR XOR stand for the operation on numbers; lowering sees whether their operands are conditions.
ExprOp BinaryOp(std::size_t kind) {
  switch (kind) {
    case P::Star:
      return ExprOp::kMultiply;
    case P::Slash:
      return ExprOp::kDivide;
    case P::Modulo:
      return ExprOp::kModulo;
    case P::Plus:
      return ExprOp::kAdd;
    case P::Minus:
      return ExprOp::kSubtract;
    case P::And:
      return ExprOp::kBitAnd;
    case P::Or:
      return ExprOp::kBitOr;
    case P::Xor:
      return ExprOp::kBitXor;
    case P::BothTrue:
      return ExprOp::kAnd;
    case P::OneTrue:
      return ExprOp::kOr;
    case P::EqualTo:
      return ExprOp::kEqual;
    case P::NotEqual:
      return ExprOp::kNotEqual;
    case P::Less:
      return ExprOp::kLess;
    case P::LessEqual:
      return ExprOp::kLessEqual;
    case P::Greater:
      return ExprOp::kGreater;
    case P::GreaterEqual:
      return ExprOp::kGreaterEqual;
    default:
      NCPORT_BUG("token kind {} is no operator", kind);
  }
}

/// Walks the tree of one block. One function a rule; `dynamic_cast` tells the labelled alternatives apart.
class Compiler {
 public:
  explicit Compiler(Recipe& recipe) : recipe_(recipe) {}

  void Block(P::BlockContext& block) {
    for (auto* skip : block.Skip()) Add(Step::kSkip, Index(skip));
    if (block.BlockNumber() != nullptr) Add(Step::kBlockNumber, Index(block.BlockNumber()));
    if (auto* head = block.head(); head != nullptr) {
      if (head->ProgramNumber() != nullptr) Add(Step::kProgramNumber, Index(head->ProgramNumber()));
      if (head->Name() != nullptr) Add(Step::kProgramName, Index(head->Name()));
    }
    if (block.statement() != nullptr) Statement(block.statement());
  }

 private:
  void Add(Step step, std::uint16_t first, std::uint16_t last, std::uint8_t arg = 0, std::size_t count = 0) {
    recipe_.actions.push_back({static_cast<std::uint8_t>(step), arg, static_cast<std::uint16_t>(count), first, last});
  }
  void Add(Step step, std::uint16_t token) { Add(step, token, token); }
  void Add(Step step, Rule* rule, std::uint8_t arg = 0, std::size_t count = 0) {
    Add(step, First(rule), Last(rule), arg, count);
  }

  void Statement(P::StatementContext* statement) {
    if (auto* opening = dynamic_cast<P::IfStatementContext*>(statement)) {
      Condition(opening->condition());
      Add(Step::kMark, statement, static_cast<std::uint8_t>(WordOp::kIf));
    } else if (auto* guarded = dynamic_cast<P::GuardedStatementContext*>(statement)) {
      Guarded(guarded);
    } else if (auto* bare = dynamic_cast<P::GuardedStatement2Context*>(statement)) {
      Condition(bare->condition());
      Add(Step::kWhen, bare->condition(), kWhenBare);
      for (auto* item : bare->item()) Item(item);
    } else if (dynamic_cast<P::ElseStatementContext*>(statement) != nullptr) {
      Add(Step::kMark, statement, static_cast<std::uint8_t>(WordOp::kElse));
    } else if (dynamic_cast<P::EndIfStatementContext*>(statement) != nullptr) {
      Add(Step::kMark, statement, static_cast<std::uint8_t>(WordOp::kEndIf));
    } else if (auto* loop = dynamic_cast<P::WhileStatementContext*>(statement)) {
      Condition(loop->condition());
      Add(Step::kMark, statement, static_cast<std::uint8_t>(WordOp::kWhile), Index(loop->Number()));
    } else if (auto* endless = dynamic_cast<P::DoStatementContext*>(statement)) {
      Add(Step::kMark, statement, static_cast<std::uint8_t>(WordOp::kLoop), Index(endless->Number()));
    } else if (auto* end = dynamic_cast<P::EndStatementContext*>(statement)) {
      Add(Step::kMark, statement, static_cast<std::uint8_t>(WordOp::kEndWhile), Index(end->Number()));
    } else {
      for (auto* item : static_cast<P::ItemsStatementContext*>(statement)->item()) Item(item);
    }
  }

  void Guarded(P::GuardedStatementContext* guarded) {
    Condition(guarded->condition());
    const auto items = guarded->item();
    auto* jump = items.size() == 1 ? dynamic_cast<P::JumpItemContext*>(items[0]) : nullptr;
    if (jump != nullptr && guarded->Then() == nullptr && guarded->EndIf() == nullptr) {
      Jump(jump, First(guarded), true);
      return;
    }
    std::uint8_t arg = guarded->Then() != nullptr ? kWhenThen : 0;
    if (guarded->EndIf() != nullptr) arg |= kWhenClosed;
    const std::uint16_t last = guarded->Then() != nullptr ? Index(guarded->Then()) : Last(guarded->condition());
    Add(Step::kWhen, First(guarded), last, arg);
    for (auto* item : items) Item(item);
  }

  void Item(P::ItemContext* item) {
    if (dynamic_cast<P::ConstantItemContext*>(item) != nullptr) {
      Add(Step::kConstant, First(item));
    } else if (auto* word = dynamic_cast<P::WordItemContext*>(item)) {
      Add(Step::kEnterWord, First(item));
      const bool bracketed = IsPlain(word->expression());
      Expression(word->expression());
      Add(Step::kWord, item, bracketed ? 0 : 1);
    } else if (dynamic_cast<P::NameItemContext*>(item) != nullptr) {
      Add(Step::kName, First(item));
    } else if (dynamic_cast<P::SkipItemContext*>(item) != nullptr) {
      Add(Step::kSkipRest, First(item));
    } else if (auto* assign = dynamic_cast<P::AssignItemContext*>(item)) {
      Variable(assign->variable(), true);
      Joined(assign->joined());
      Add(Step::kAssign, item);
    } else if (auto* jump = dynamic_cast<P::JumpItemContext*>(item)) {
      Jump(jump, First(item), false);
    } else if (auto* print = dynamic_cast<P::PrintItemContext*>(item)) {
      for (auto* printed : print->printed()) Printed(printed);
      Add(Step::kPrint, item, 0, print->printed().size());
    } else {
      Add(dynamic_cast<P::OpenItemContext*>(item) != nullptr ? Step::kOpen : Step::kClose, First(item));
    }
  }

  void Printed(P::PrintedContext* printed) {
    if (printed->PrintText() != nullptr) {
      Add(Step::kPrintText, Index(printed->PrintText()));
      return;
    }
    Variable(printed->variable(), false);
    Add(Step::kPrintValue, printed);
  }

  // The target lies above the condition on the stack.
  void Jump(P::JumpItemContext* jump, std::uint16_t first, bool conditional) {
    if (jump->target()->Number() != nullptr) {
      Add(Step::kJump, first, Last(jump), static_cast<std::uint8_t>(JumpForm::kNumber), conditional ? 1 : 0);
      return;
    }
    Expression(jump->target()->expression());
    Add(Step::kJump, first, Last(jump), static_cast<std::uint8_t>(JumpForm::kValue), conditional ? 1 : 0);
  }

  // --- expressions
  void Condition(P::ConditionContext* condition) {
    const auto brackets = condition->bracket();
    Bracket(brackets[0]);
    for (std::size_t i = 1; i < brackets.size(); ++i) {
      Bracket(brackets[i]);
      Add(Step::kBinary, First(condition), Last(brackets[i]),
          static_cast<std::uint8_t>(BinaryOp(condition->op[i - 1]->getType())));
    }
  }
  void Bracket(P::BracketContext* bracket) {
    Joined(bracket->joined());
    Add(Step::kGroup, bracket);
  }
  void Joined(P::JoinedContext* joined) {
    const auto comparisons = joined->comparison();
    Comparison(comparisons[0]);
    for (std::size_t i = 1; i < comparisons.size(); ++i) {
      Comparison(comparisons[i]);
      Add(Step::kBinary, First(joined), Last(comparisons[i]),
          static_cast<std::uint8_t>(BinaryOp(joined->op[i - 1]->getType())));
    }
  }
  void Comparison(P::ComparisonContext* comparison) {
    for (auto* side : comparison->expression()) Expression(side);
    if (comparison->op != nullptr)
      Add(Step::kBinary, comparison, static_cast<std::uint8_t>(BinaryOp(comparison->op->getType())));
  }

  static bool IsPlain(P::ExpressionContext* expression) {
    P::PrimaryContext* primary = nullptr;
    if (auto* plain = dynamic_cast<P::PrimaryExpressionContext*>(expression)) primary = plain->primary();
    if (auto* sign = dynamic_cast<P::UnaryExpressionContext*>(expression)) primary = sign->primary();
    return dynamic_cast<P::VariablePrimaryContext*>(primary) != nullptr ||
           dynamic_cast<P::GroupPrimaryContext*>(primary) != nullptr;
  }

  void Expression(P::ExpressionContext* expression) {
    if (auto* primary = dynamic_cast<P::PrimaryExpressionContext*>(expression)) {
      Primary(primary->primary());
    } else if (auto* unary = dynamic_cast<P::UnaryExpressionContext*>(expression)) {
      Primary(unary->primary());
      const ExprOp op = unary->op->getType() == P::Minus ? ExprOp::kNegate : ExprOp::kPlus;
      Add(Step::kUnary, expression, static_cast<std::uint8_t>(op));
    } else {
      auto* binary = static_cast<P::BinaryExpressionContext*>(expression);
      Expression(binary->expression(0));
      Expression(binary->expression(1));
      Add(Step::kBinary, expression, static_cast<std::uint8_t>(BinaryOp(binary->op->getType())));
    }
  }

  void Primary(P::PrimaryContext* primary) {
    if (auto* variable = dynamic_cast<P::VariablePrimaryContext*>(primary)) {
      Variable(variable->variable(), false);
    } else if (auto* group = dynamic_cast<P::GroupPrimaryContext*>(primary)) {
      Bracket(group->bracket());
    } else if (auto* atan = dynamic_cast<P::AtanPrimaryContext*>(primary)) {
      for (auto* argument : atan->expression()) Expression(argument);
      Add(Step::kFunction, primary, atan->Slash() != nullptr ? 1 : 0, atan->expression().size());
    } else if (auto* function = dynamic_cast<P::FunctionPrimaryContext*>(primary)) {
      for (auto* argument : function->expression()) Expression(argument);
      Add(Step::kFunction, primary, function->Slash() != nullptr ? 1 : 0, function->expression().size());
    } else {
      Add(Step::kNumber, First(primary));
    }
  }

  void Variable(P::VariableContext* variable, bool written) {
    if (auto* at = dynamic_cast<P::CellAtVariableContext*>(variable)) {
      Add(Step::kIndex, First(variable));
      Expression(at->expression());
      Add(Step::kCellAt, variable);
      return;
    }
    Add(Step::kCell, First(variable), First(variable), written ? 1 : 0);
  }

  Recipe& recipe_;
};

}  // namespace

void CompileBlock(antlr4::ParserRuleContext& block, Recipe& recipe) {
  Compiler(recipe).Block(dynamic_cast<P::BlockContext&>(block));
}

}  // namespace ncport::frontend::fanuc
