// DEF, PROC, EXTERN, DEFINE (card 3.2, 3.7, 3.8, 7.2).
#include "base/result.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/lower.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::ExprId;
using ir::Type;
using ir::Word;
using ir::WordOp;

namespace {

constexpr std::uint32_t kMaxDimension = 1U << 20U;  // cells of one array; the control has far fewer
constexpr std::uint32_t kMaxText = 200;             // card 2.5

}  // namespace

void Lowering::NeedsDefinitionSection(const Token& token) {
  only_definitions_ = true;
  if (state_.definitions_open) return;
  late_ = true;
  late_error_ = {.code = Code::kLateDefinition, .begin = token.offset, .length = token.length};
}

void Lowering::ClearDimensions() {
  definition_.dimension_count = 0;
  for (std::uint32_t& dimension : definition_.dimensions) dimension = 0;
}

bool Lowering::CheckName(const Token& token) {
  const auto most = static_cast<std::size_t>(profile_.names.max_length.Or(31));
  if (most != 0 && module_.View(token.Text()).size() > most) {
    Fail(Code::kNameTooLong, token);
    error_.limit = static_cast<std::uint32_t>(most);
    return false;
  }
  return true;
}

bool Lowering::TakeInitializer(const Action& action, ir::Variable& variable) {
  const auto kind = static_cast<Initializer>(action.arg);
  if (kind == Initializer::kNone) return true;
  ir::AssignList list;
  if (kind == Initializer::kValue) {
    const ExprId value = Pop();
    if (variable.dimension_count == 0) {
      variable.initial = value;
      return true;
    }
    // `=(5)` is a list of one; `=5` without brackets is printed in no source.
    if (module_.exprs[value].op != ir::ExprOp::kGroup) {
      return Fail(Code::kTypeMismatch, At(action.first), "write SET(..), REP(..) or a list in brackets", "one value");
    }
    list.values = {static_cast<std::uint32_t>(module_.expr_items.size()), 1};
    ExprId inner;
    inner.value = module_.exprs[value].a;
    module_.expr_items.push_back(inner);
  } else {
    list.repeat = kind == Initializer::kRepeated;
    const std::size_t count = list.repeat ? 1 : action.count;
    if (list.repeat && action.count == 2) list.count = Pop();
    list.values = {static_cast<std::uint32_t>(module_.expr_items.size()), static_cast<std::uint32_t>(count)};
    for (std::size_t i = values_.size() - count; i < values_.size(); ++i) module_.expr_items.push_back(values_[i]);
    values_.resize(values_.size() - count);
    if (variable.dimension_count == 0) {
      return Fail(Code::kTypeMismatch, At(action.first), nullptr, "a list");
    }
  }
  variable.initial_list = module_.assign_lists.Add(list);
  return true;
}

bool Lowering::Declare(const Action& action) {
  const Token& token = At(action.first);
  if (!CheckName(token)) return false;
  ir::Variable variable;
  variable.name = token.Text();
  variable.type = definition_.type;
  variable.scope = definition_.scope;
  variable.dimension_count = definition_.dimension_count;
  variable.definition = definition_.names;
  variable.string_length = definition_.string_length;
  variable.owner = definition_.scoped ? ir::ProgramId{} : state_.program;
  variable.lower_limit = definition_.lower;
  variable.upper_limit = definition_.upper;
  variable.line = line_number_;
  variable.begin = token.offset;
  variable.length = token.length;
  variable.file = module_.programs[state_.program].file;
  for (int i = 0; i < 3; ++i) {
    variable.dimensions[i] = definition_.dimensions[i];
    if (i < variable.dimension_count && variable.dimensions[i] == 0) return Fail(Code::kMissingValue, token);
  }
  if (!TakeInitializer(action, variable)) return false;
  const ir::VariableId id = module_.variables.Add(variable);
  Word& word = AddWord(WordOp::kDefine, action.first, action.last);
  word.extra = id.value;
  if (definition_.names == 0) {
    NeedsDefinitionSection(token);
    if (!definition_.attributes.empty()) word.spelling = SpellingOf(definition_.attributes, "sinumerik-3.2");
  }
  ++definition_.names;
  ClearDimensions();
  return true;
}

bool Lowering::EndProgramHeader(const Action& action) {
  const Token& token = At(action.first);
  ir::Program& program = module_.programs[state_.program];
  NeedsDefinitionSection(token);
  if (program.has_header) {
    late_ = true;
    late_error_ = {.code = Code::kLateDefinition, .begin = token.offset, .length = token.length};
  }
  program.has_header = true;
  program.header_line = line_number_;
  program.saves_modal_state = definition_.saves;
  program.parameters = {definition_.first, static_cast<std::uint32_t>(module_.variables.Size()) - definition_.first};
  if (!state_.named_by_header) program.name = definition_.name;
  Word& word = AddWord(WordOp::kHeader, action.first, action.last);
  word.extra = state_.program.value;
  if (!definition_.attributes.empty()) word.spelling = SpellingOf(definition_.attributes, "sinumerik-1.2");
  return true;
}

// DEFINE name AS text: kept as text for printing; the text stands for the name in the rest of the program.
bool Lowering::AddMacro(const Action& action) {
  const Token& name = At(action.first);
  const auto last = static_cast<std::uint16_t>(tokens_.size() - 1);
  // The parser takes the end of the line for the text where none stands.
  if (action.last > last)
    return Fail(Code::kMissingValue, At(last), "write the text that the name stands for behind AS");
  const std::string_view text = TextOf(At(action.last).offset, At(last).End());
  if (!state_.macros.Add(TextOf(name), text)) return Fail(Code::kDoubleName, name);
  NeedsDefinitionSection(name);
  Action whole = action;
  whole.first = static_cast<std::uint16_t>(action.first - 1);
  whole.last = last;
  return AddInertText(whole);
}

bool Lowering::DoDefinition(const Action& action) {
  const Token& token = At(action.first);
  const auto add_text = [&](std::string_view text) {
    if (!definition_.attributes.empty()) definition_.attributes += ' ';
    definition_.attributes += text;
  };
  switch (static_cast<Step>(action.op)) {
    case Step::kDef:
      definition_ = {};
      definition_.scoped = state_.definition_file;
      definition_.scope = state_.definition_file                                            ? ir::Scope::kGlobal
                          : module_.programs[state_.program].kind == ir::ProgramKind::kMain ? ir::Scope::kProgram
                                                                                            : ir::Scope::kLocal;
      return true;
    case Step::kDefScope:
      definition_.scope = static_cast<ir::Scope>(token.sub);
      definition_.scoped = true;
      return true;
    case Step::kDefTextDrop:
      values_.pop_back();
      [[fallthrough]];
    case Step::kDefText:
      add_text(TextOf(action));
      return true;
    case Step::kLowerLimit:
      definition_.lower = Pop();
      return true;
    case Step::kUpperLimit:
      definition_.upper = Pop();
      return true;
    case Step::kType:
    case Step::kStringType:
      definition_.type = static_cast<Type>(token.sub);
      definition_.string_length = 0;
      ClearDimensions();
      if (action.arg != 0 && !LiteralInt(Pop(), kMaxText, definition_.string_length)) {
        const bool number = action.first + 2U < tokens_.size();  // STRING [ 300
        return Fail(Code::kOutOfRange, number ? At(action.first + 2U) : token, "write a constant up to 200",
                    "the lengths of STRING");
      }
      return true;
    case Step::kDimension: {
      const ExprId size = Pop();
      std::uint32_t count = 0;
      if (size.Valid() && (!LiteralInt(size, kMaxDimension, count) || count == 0)) {
        return Fail(Code::kOutOfRange, token, "write a constant from 1", "the sizes of an array");
      }
      if (definition_.dimension_count == 3)
        return Fail(Code::kUnexpectedText, token, "arrays have up to three dimensions");
      definition_.dimensions[definition_.dimension_count++] = count;
      return true;
    }
    case Step::kDeclare:
      return Declare(action);
    case Step::kProgram:
    case Step::kExtern:
      definition_ = {};
      definition_.name = token.Text();
      definition_.first = static_cast<std::uint32_t>(
          static_cast<Step>(action.op) == Step::kProgram ? module_.variables.Size() : module_.extern_params.size());
      return true;
    case Step::kParameter: {
      const ExprId initial = (action.arg & 2U) != 0 ? Pop() : ExprId{};
      if (!CheckName(token)) return false;
      ir::Variable parameter;
      parameter.name = token.Text();
      parameter.type = definition_.type;
      parameter.scope = ir::Scope::kParameter;
      parameter.by_reference = (action.arg & 1U) != 0;
      parameter.dimension_count = definition_.dimension_count;
      for (int i = 0; i < 3; ++i) parameter.dimensions[i] = definition_.dimensions[i];
      parameter.string_length = definition_.string_length;
      parameter.owner = state_.program;
      parameter.initial = initial;
      parameter.line = line_number_;
      parameter.begin = token.offset;
      parameter.length = token.length;
      parameter.file = module_.programs[state_.program].file;
      module_.variables.Add(parameter);
      return true;
    }
    case Step::kProgramText:
      add_text(TextOf(token));
      if (dialects::sinumerik::ProgramAttributes()[token.data] == "SAVE") definition_.saves = true;
      return true;
    case Step::kProgramEnd:
      return EndProgramHeader(action);
    case Step::kExternParameter: {
      ir::ExternParam parameter;
      parameter.type = definition_.type;
      parameter.by_reference = (action.arg & 1U) != 0;
      parameter.dimension_count = definition_.dimension_count;
      for (int i = 0; i < 3; ++i) parameter.dimensions[i] = definition_.dimensions[i];
      parameter.string_length = definition_.string_length;
      module_.extern_params.push_back(parameter);
      return true;
    }
    case Step::kExternEnd: {
      NeedsDefinitionSection(token);
      ir::Extern record;
      record.name = definition_.name;
      record.first_param = definition_.first;
      record.param_count = static_cast<std::uint32_t>(module_.extern_params.size()) - definition_.first;
      const ir::ExternId id = module_.externs.Add(record);
      AddWord(WordOp::kExtern, action.first, action.last).extra = id.value;
      return true;
    }
    case Step::kMacro:
      return AddMacro(action);
    default:
      NCPORT_BUG("step {} is no definition", action.op);
  }
}

}  // namespace ncport::frontend::sinumerik
