// One class, one method a rule of the grammar: long, but each method writes the steps of its rule and nothing else.
#include "frontend/sinumerik/compile.h"

#include <vector>

#include "SinumerikParser.h"
#include "base/result.h"
#include "frontend/sinumerik/recipe.h"
#include "frontend/sinumerik/token_kind.h"
#include "ir/nodes.h"

namespace ncport::frontend::sinumerik {

namespace {

using P = grammar::sinumerik::SinumerikParser;
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

ExprOp BinaryOp(std::size_t kind) {
  switch (kind) {
    case P::Star:
      return ExprOp::kMultiply;
    case P::Slash:
      return ExprOp::kDivide;
    case P::DivideInteger:
      return ExprOp::kDivideInteger;
    case P::Modulo:
      return ExprOp::kModulo;
    case P::Plus:
      return ExprOp::kAdd;
    case P::Minus:
      return ExprOp::kSubtract;
    case P::BitAnd:
      return ExprOp::kBitAnd;
    case P::BitXor:
      return ExprOp::kBitXor;
    case P::BitOr:
      return ExprOp::kBitOr;
    case P::And:
      return ExprOp::kAnd;
    case P::Xor:
      return ExprOp::kXor;
    case P::Or:
      return ExprOp::kOr;
    case P::Concat:
      return ExprOp::kConcat;
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
      NCPORT_BUG("token kind {} is no binary operator", kind);
  }
}

std::uint8_t UnaryOp(std::size_t kind) {
  switch (kind) {
    case P::Not:
      return static_cast<std::uint8_t>(ExprOp::kNot);
    case P::BitNot:
      return static_cast<std::uint8_t>(ExprOp::kBitNot);
    case P::Minus:
      return static_cast<std::uint8_t>(ExprOp::kNegate);
    case P::Plus:
      return static_cast<std::uint8_t>(ExprOp::kPlus);
    case P::Concat:
      return kToText;
    default:
      NCPORT_BUG("token kind {} is no unary operator", kind);
  }
}

/// Walks the tree of one block. One function a rule; `dynamic_cast` tells the labelled alternatives apart.
class Compiler {
 public:
  explicit Compiler(Recipe& recipe) : recipe_(recipe) {}

  void Block(P::BlockContext& block) {
    if (block.Skip() != nullptr) Add(Step::kSkip, Index(block.Skip()));
    if (block.BlockNumber() != nullptr) Add(Step::kBlockNumber, Index(block.BlockNumber()));
    if (block.MainNumber() != nullptr) Add(Step::kMainNumber, Index(block.MainNumber()));
    if (block.Label() != nullptr) Add(Step::kLabel, Index(block.Label()));
    auto* statement = block.statement();
    if (statement == nullptr) return;
    if (statement->definition() != nullptr) {
      Definition(statement->definition());
    } else if (statement->structure() != nullptr) {
      Structure(statement->structure());
    } else if (statement->call() != nullptr) {
      Call(statement->call());
    } else {
      for (auto* item : statement->item()) Item(item);
    }
  }

 private:
  void Add(Step step, std::uint16_t first, std::uint16_t last, std::uint8_t arg = 0, std::size_t count = 0) {
    recipe_.actions.push_back({static_cast<std::uint8_t>(step), arg, static_cast<std::uint16_t>(count), first, last});
  }
  void Add(Step step, std::uint16_t token) { Add(step, token, token); }
  void Add(Step step, Rule* rule, std::uint8_t arg = 0, std::size_t count = 0) {
    Add(step, First(rule), Last(rule), arg, count);
  }

  // --- words
  void Item(P::ItemContext* item) {
    if (auto* code = dynamic_cast<P::CodeItemContext*>(item)) {
      Add(Step::kCode, Index(code->Code()));
    } else if (auto* axis_value = dynamic_cast<P::AxisValueItemContext*>(item)) {
      Add(Step::kConstant, Index(axis_value->AxisValue()));
    } else if (auto* address_value = dynamic_cast<P::AddressValueItemContext*>(item)) {
      Add(Step::kConstant, Index(address_value->AddressValue()));
    } else if (auto* axis = dynamic_cast<P::AxisItemContext*>(item)) {
      Value(axis->value());
      Add(Step::kAxis, item);
    } else if (auto* axis_at = dynamic_cast<P::AxisAtItemContext*>(item)) {
      Expression(axis_at->expression());
      Value(axis_at->value());
      Add(Step::kAxisAt, item);
    } else if (auto* address = dynamic_cast<P::AddressItemContext*>(item)) {
      if (address->expression() != nullptr) Expression(address->expression());
      Value(address->value());
      Add(Step::kAddress, item, address->expression() != nullptr ? 1 : 0);
    } else if (auto* assign = dynamic_cast<P::AssignItemContext*>(item)) {
      Place(assign->place());
      Assigned(assign->assigned(), item);
    } else {
      OtherItem(item);
    }
  }

  void OtherItem(P::ItemContext* item) {
    if (auto* g = dynamic_cast<P::ComputedGItemContext*>(item)) {
      Expression(g->expression());
      Add(Step::kComputedG, item);
    } else if (auto* m = dynamic_cast<P::ComputedMItemContext*>(item)) {
      if (m->expression() != nullptr) Expression(m->expression());
      Value(m->value());
      Add(Step::kComputedM, item, m->expression() != nullptr ? 1 : 0);
    } else if (auto* jump = dynamic_cast<P::JumpItemContext*>(item)) {
      Jump(jump->jump(), item, false);
    } else if (auto* conditional = dynamic_cast<P::ConditionalJumpItemContext*>(item)) {
      Expression(conditional->expression());
      Jump(conditional->jump(), item, true);
    } else if (auto* switch_item = dynamic_cast<P::CaseItemContext*>(item)) {
      Case(switch_item);
    } else if (auto* message = dynamic_cast<P::MessageItemContext*>(item)) {
      Add(Step::kMessage, item, 0, Arguments(message->arguments()));
    } else if (auto* alarm = dynamic_cast<P::AlarmItemContext*>(item)) {
      for (auto* value : alarm->expression()) Expression(value);
      Add(Step::kAlarm, item, 0, alarm->expression().size());
    } else if (dynamic_cast<P::PreprocessStopItemContext*>(item) != nullptr) {
      Add(Step::kPreprocessStop, item);
    } else if (auto* workpiece = dynamic_cast<P::WorkpieceItemContext*>(item)) {
      Add(Step::kWorkpiece, item, 0, Arguments(workpiece->arguments()));
    } else if (auto* inert = dynamic_cast<P::InertCallItemContext*>(item)) {
      Add(Step::kInertCall, item, 0, inert->arguments() != nullptr ? Arguments(inert->arguments()) : 0);
    } else if (dynamic_cast<P::AttributeItemContext*>(item) != nullptr) {
      Add(Step::kInertText, item);
    } else if (auto* ret = dynamic_cast<P::ReturnItemContext*>(item)) {
      Add(Step::kReturn, item, 0, ret->arguments() != nullptr ? Arguments(ret->arguments()) : 0);
    } else {
      NCPORT_BUG("an item of the grammar has no recipe");
    }
  }

  void Value(P::ValueContext* value) {
    if (value->Mode() != nullptr) Add(Step::kMode, Index(value->Mode()));
    Expression(value->expression());
  }

  void Assigned(P::AssignedContext* assigned, Rule* item) {
    if (auto* set = dynamic_cast<P::SetAssignedContext*>(assigned)) {
      Add(Step::kAssignList, item, 0, ListItems(set->listItem()));
    } else if (auto* list = dynamic_cast<P::ListAssignedContext*>(assigned)) {
      Add(Step::kAssignList, item, 0, ListItems(list->listItem()));
    } else if (auto* rep = dynamic_cast<P::RepAssignedContext*>(assigned)) {
      for (auto* value : rep->expression()) Expression(value);
      Add(Step::kAssignRepeated, item, 0, rep->expression().size());
    } else {
      Expression(static_cast<P::PlainAssignedContext*>(assigned)->expression());
      Add(Step::kAssign, item);
    }
  }
  std::size_t ListItems(const std::vector<P::ListItemContext*>& items) {
    for (auto* item : items) Optional(item->expression(), First(item));
    return items.size();
  }
  std::size_t Arguments(P::ArgumentsContext* arguments) {
    const auto all = arguments->argument();
    if (all.size() == 1 && all[0]->expression() == nullptr) return 0;  // `()`
    for (auto* argument : all) Optional(argument->expression(), 0);
    return all.size();
  }
  void Optional(P::ExpressionContext* expression, std::uint16_t at) {
    if (expression != nullptr) {
      Expression(expression);
    } else {
      Add(Step::kMissing, at);
    }
  }

  // --- jumps
  // Leaves the target waiting; returns the token of the GOTO word.
  std::uint16_t Target(P::JumpContext* jump) {
    if (jump->GotoStart() != nullptr) {
      Add(Step::kTargetStart, Index(jump->GotoStart()));
      return Index(jump->GotoStart());
    }
    Target(jump->target());
    return Index(jump->Goto());
  }
  void Target(P::TargetContext* target) {
    if (dynamic_cast<P::NumberTargetContext*>(target) != nullptr) {
      Add(Step::kTargetNumber, First(target));
    } else if (dynamic_cast<P::MainNumberTargetContext*>(target) != nullptr) {
      Add(Step::kTargetMainNumber, First(target));
    } else if (auto* value = dynamic_cast<P::ExpressionTargetContext*>(target)) {
      Expression(value->expression());
      Add(Step::kTargetValue, target);
    } else {
      Add(Step::kTargetName, First(target));
    }
  }
  void Jump(P::JumpContext* jump, Rule* item, bool conditional) {
    const std::uint16_t word = Target(jump);
    const std::uint8_t start = jump->GotoStart() != nullptr ? 2 : 0;
    Add(Step::kJump, item, static_cast<std::uint8_t>(start | (conditional ? 1 : 0)), word);
  }
  void Case(P::CaseItemContext* item) {
    Expression(item->expression());
    for (auto* arm : item->caseArm()) {
      Expression(arm->expression());
      const std::uint16_t word = Target(arm->jump());
      Add(Step::kCaseArm, arm, 0, word);
    }
    if (item->jump() != nullptr) {
      const std::uint16_t word = Target(item->jump());
      Add(Step::kCaseArm, item->jump(), 1, word);
    }
    Add(Step::kCase, item);
  }

  // --- structure marks
  void Structure(P::StructureContext* mark) {
    if (mark->For() != nullptr) {
      Place(mark->place());
      for (auto* value : mark->expression()) Expression(value);
      Add(Step::kFor, mark);
      return;
    }
    for (auto* value : mark->expression()) Expression(value);
    WordOp op = WordOp::kIf;
    switch (mark->getStart()->getType()) {
      case P::If:
        op = WordOp::kIf;
        break;
      case P::Else:
        op = WordOp::kElse;
        break;
      case P::EndIf:
        op = WordOp::kEndIf;
        break;
      case P::While:
        op = WordOp::kWhile;
        break;
      case P::EndWhile:
        op = WordOp::kEndWhile;
        break;
      case P::EndFor:
        op = WordOp::kEndFor;
        break;
      case P::Loop:
        op = WordOp::kLoop;
        break;
      case P::EndLoop:
        op = WordOp::kEndLoop;
        break;
      case P::Repeat:
        op = WordOp::kRepeat;
        break;
      case P::Until:
        op = WordOp::kUntil;
        break;
      default:
        NCPORT_BUG("a structure of the grammar has no recipe");
    }
    Add(Step::kMark, mark, static_cast<std::uint8_t>(op), mark->expression().size());
  }

  // --- calls
  std::uint8_t Passes(P::PassesContext* passes) {
    if (passes == nullptr) return 0;
    if (passes->expression() != nullptr) {
      Expression(passes->expression());
    } else {
      Add(Step::kNumber, Index(passes->PassesValue()));
    }
    return kCallPasses;
  }
  void Call(P::CallContext* call) {
    if (auto* name = dynamic_cast<P::NameCallContext*>(call)) {
      const std::size_t count = name->arguments() != nullptr ? Arguments(name->arguments()) : 0;
      const std::uint8_t brackets = name->arguments() != nullptr ? kCallBrackets : 0;
      const std::uint8_t passes = Passes(name->passes());
      Add(Step::kCall, First(name->callee()), Last(call), brackets | passes, count);
    } else if (auto* modal = dynamic_cast<P::ModalCallContext*>(call)) {
      const std::size_t count = modal->arguments() != nullptr ? Arguments(modal->arguments()) : 0;
      const std::uint8_t brackets = modal->arguments() != nullptr ? kCallBrackets : 0;
      const bool named = modal->callee() != nullptr;
      Add(Step::kModalCall, named ? First(modal->callee()) : First(call), Last(call),
          brackets | (named ? kCallNamed : 0), count);
    } else if (auto* text = dynamic_cast<P::TextCallContext*>(call)) {
      TextCall(text);
    } else if (auto* path = dynamic_cast<P::PathCallContext*>(call)) {
      const std::size_t count = path->arguments() != nullptr ? Arguments(path->arguments()) : 0;
      const std::uint8_t brackets = path->arguments() != nullptr ? kCallBrackets : 0;
      const std::uint8_t passes = Passes(path->passes());
      Add(Step::kPathCall, Index(path->Path()), Last(call), brackets | passes, count);
    } else if (auto* external = dynamic_cast<P::ExternalCallContext*>(call)) {
      Expression(external->expression());
      Add(Step::kExternalCall, call);
    } else if (auto* part = dynamic_cast<P::RepeatPartContext*>(call)) {
      for (auto* target : part->target()) Target(target);
      const std::uint8_t passes = Passes(part->passes());
      Add(Step::kRepeatPart, call, passes | (part->target().size() > 1 ? kPartLast : 0));
    } else if (auto* block = dynamic_cast<P::RepeatBlockContext*>(call)) {
      Target(block->target());
      const std::uint8_t passes = Passes(block->passes());
      Add(Step::kRepeatPart, call, passes | kPartSingle);
    } else {
      NCPORT_BUG("a call of the grammar has no recipe");
    }
  }
  void TextCall(P::TextCallContext* call) {
    std::uint8_t arg = 0;
    std::size_t count = 0;
    std::uint16_t first = First(call);
    if (call->callee() != nullptr) {
      first = First(call->callee());
      count = Arguments(call->arguments());
      arg = kCallBrackets | kCallNamed;
    } else if (call->SubName() != nullptr) {
      first = Index(call->SubName());
      arg = kCallNamed | kCallSubName;
    } else if (call->expression() != nullptr) {
      Expression(call->expression());
      arg = kCallWithName;
    }
    for (auto* target : call->target()) Target(target);
    if (!call->target().empty()) arg |= kCallRange;
    arg |= Passes(call->passes());
    Add(Step::kTextCall, first, Last(call), arg, count);
  }

  // --- definitions
  void Definition(P::DefinitionContext* definition) {
    if (auto* def = dynamic_cast<P::DefDefinitionContext*>(definition)) {
      Add(Step::kDef, Index(def->Def()));
      if (def->DefScope() != nullptr) Add(Step::kDefScope, Index(def->DefScope()));
      for (auto* attribute : def->defAttribute()) Attribute(attribute);
      Type(def->type());
      for (auto* declarator : def->declarator()) Declarator(declarator);
    } else if (auto* proc = dynamic_cast<P::ProcDefinitionContext*>(definition)) {
      Add(Step::kProgram, First(proc->callee()));
      for (auto* parameter : proc->parameter()) Parameter(parameter);
      for (auto* attribute : proc->Attribute()) Add(Step::kProgramText, Index(attribute));
      Add(Step::kProgramEnd, definition);
    } else if (auto* ext = dynamic_cast<P::ExternDefinitionContext*>(definition)) {
      Add(Step::kExtern, First(ext->callee()));
      for (auto* parameter : ext->externParameter()) ExternParameter(parameter);
      Add(Step::kExternEnd, definition);
    } else {
      // DEFINE name AS text: the children are DEFINE, the name, AS, the text.
      const auto first = First(definition);
      Add(Step::kMacro, static_cast<std::uint16_t>(first + 1), static_cast<std::uint16_t>(first + 3));
    }
  }
  void Attribute(P::DefAttributeContext* attribute) {
    if (attribute->LowerLimit() != nullptr || attribute->UpperLimit() != nullptr) {
      Expression(attribute->expression());
      Add(attribute->LowerLimit() != nullptr ? Step::kLowerLimit : Step::kUpperLimit, attribute);
    } else if (attribute->expression() != nullptr) {
      Expression(attribute->expression());
      Add(Step::kDefTextDrop, attribute);
    } else {
      Add(Step::kDefText, attribute);
    }
  }
  void Type(P::TypeContext* type) {
    if (type->Type() != nullptr) {
      Add(Step::kType, Index(type->Type()));
      return;
    }
    Expression(type->expression());
    Add(Step::kStringType, First(type), Last(type), 1);
  }
  void Dimensions(P::DimensionsContext* dimensions) {
    if (dimensions == nullptr) return;
    for (auto* dimension : dimensions->dimension()) {
      Optional(dimension->expression(), First(dimensions));
      Add(Step::kDimension, dimensions);
    }
  }
  void Declarator(P::DeclaratorContext* declarator) {
    Dimensions(declarator->dimensions());
    auto kind = Initializer::kNone;
    std::size_t count = 0;
    if (auto* set = dynamic_cast<P::SetAssignedContext*>(declarator->assigned())) {
      kind = Initializer::kList;
      count = ListItems(set->listItem());
    } else if (auto* list = dynamic_cast<P::ListAssignedContext*>(declarator->assigned())) {
      kind = Initializer::kList;
      count = ListItems(list->listItem());
    } else if (auto* rep = dynamic_cast<P::RepAssignedContext*>(declarator->assigned())) {
      kind = Initializer::kRepeated;
      count = rep->expression().size();
      for (auto* value : rep->expression()) Expression(value);
    } else if (auto* plain = dynamic_cast<P::PlainAssignedContext*>(declarator->assigned())) {
      kind = Initializer::kValue;
      Expression(plain->expression());
    }
    Add(Step::kDeclare, First(declarator), Last(declarator), static_cast<std::uint8_t>(kind), count);
  }
  void Parameter(P::ParameterContext* parameter) {
    Type(parameter->type());
    Dimensions(parameter->dimensions());
    std::uint8_t arg = parameter->Var() != nullptr ? 1 : 0;
    if (parameter->expression() != nullptr) {
      Expression(parameter->expression());
      arg |= 2;
    }
    Add(Step::kParameter, Index(parameter->Name()), Last(parameter), arg);
  }
  void ExternParameter(P::ExternParameterContext* parameter) {
    if (parameter->Type() != nullptr) {
      Add(Step::kType, Index(parameter->Type()));
    } else {
      if (parameter->expression() != nullptr) Expression(parameter->expression());
      const std::uint16_t token = Index(parameter->StringType());
      Add(Step::kStringType, token, token, parameter->expression() != nullptr ? 1 : 0);
    }
    Dimensions(parameter->dimensions());
    Add(Step::kExternParameter, parameter, parameter->Var() != nullptr ? 1 : 0);
  }

  // --- expressions
  void Place(P::PlaceContext* place) {
    if (auto* name = dynamic_cast<P::NamePlaceContext*>(place)) {
      for (auto* index : name->expression()) Expression(index);
      Add(Step::kName, place, 0, name->expression().size());
    } else if (auto* at = dynamic_cast<P::CellAtPlaceContext*>(place)) {
      Expression(at->expression());
      Add(Step::kCellAt, place);
    } else if (auto* system = dynamic_cast<P::SystemPlaceContext*>(place)) {
      for (auto* index : system->expression()) Expression(index);
      Add(Step::kSystem, place, 0, system->expression().size());
    } else {
      Add(Step::kCell, First(place));
    }
  }

  void Expression(P::ExpressionContext* expression) {
    if (auto* primary = dynamic_cast<P::PrimaryExpressionContext*>(expression)) {
      Primary(primary->primary());
    } else if (auto* unary = dynamic_cast<P::UnaryExpressionContext*>(expression)) {
      Expression(unary->expression());
      Add(Step::kUnary, expression, UnaryOp(unary->op->getType()));
    } else {
      auto* binary = static_cast<P::BinaryExpressionContext*>(expression);
      Expression(binary->expression(0));
      Expression(binary->expression(1));
      Add(Step::kBinary, expression, static_cast<std::uint8_t>(BinaryOp(binary->op->getType())));
    }
  }

  void Primary(P::PrimaryContext* primary) {
    if (auto* place = dynamic_cast<P::PlacePrimaryContext*>(primary)) {
      Place(place->place());
    } else if (auto* group = dynamic_cast<P::GroupPrimaryContext*>(primary)) {
      Expression(group->expression());
      Add(Step::kGroup, primary);
    } else if (auto* function = dynamic_cast<P::FunctionPrimaryContext*>(primary)) {
      for (auto* argument : function->expression()) Expression(argument);
      Add(Step::kFunction, primary, 0, function->expression().size());
    } else {
      switch (primary->getStart()->getType()) {
        case P::Number:
          Add(Step::kNumber, First(primary));
          break;
        case P::Text:
          Add(Step::kText, First(primary));
          break;
        case P::Boolean:
          Add(Step::kBoolean, First(primary));
          break;
        default:
          Add(Step::kAxisName, First(primary));
          break;
      }
    }
  }

  Recipe& recipe_;
};

}  // namespace

void CompileBlock(antlr4::ParserRuleContext& block, Recipe& recipe) {
  Compiler(recipe).Block(dynamic_cast<P::BlockContext&>(block));
}

}  // namespace ncport::frontend::sinumerik
