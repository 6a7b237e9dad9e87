// DEF, PROC, EXTERN in full form (card 3.2, 3.7, 7.2).
#include "backends/sinumerik/printer.h"
#include "base/number_text.h"
#include "base/result.h"
#include "dialects/sinumerik/words.h"

namespace ncport::backends::sinumerik {

void Printer::Type(ir::Type type, std::uint32_t string_length) {
  for (const dialects::sinumerik::TypeRow& row : dialects::sinumerik::Types()) {
    if (row.type != type) continue;
    out_.Append(row.text);
    if (type == ir::Type::kString && string_length != 0) {
      out_.Append('[');
      AppendInteger(out_, string_length);
      out_.Append(']');
    }
    return;
  }
  NCPORT_BUG("SINUMERIK has no type {}", ir::NameOf(type));
}

/// An open dimension is empty: `[]`, `[,3]`.
void Printer::Dimensions(std::uint8_t count, const std::uint32_t* dimensions) {
  if (count == 0) return;
  out_.Append('[');
  for (std::uint8_t i = 0; i < count; ++i) {
    if (i != 0) out_.Append(',');
    if (dimensions[i] != 0) AppendInteger(out_, dimensions[i]);
  }
  out_.Append(']');
}

void Printer::AssignList(ir::AssignListId id) {
  const ir::AssignList& list = module_.assign_lists[id];
  out_.Append(list.repeat ? "REP(" : "SET(");
  List(list.values.begin, list.values.count);
  if (list.count.Valid()) {
    out_.Append(',');
    Expr(list.count);
  }
  out_.Append(')');
}

void Printer::Define(const ir::Word& word, bool first) {
  const ir::Variable& variable = module_.variables[word.Extra<ir::VariableId>()];
  if (first) {
    out_.Append("DEF ");
    if (variable.scope == ir::Scope::kChannel) out_.Append("CHAN ");
    if (variable.scope == ir::Scope::kGlobal) out_.Append("NCK ");
    Type(variable.type, variable.string_length);
    out_.Append(' ');
    if (word.spelling != 0) {
      out_.Append(SpellingOf(word));
      out_.Append(' ');
    }
    const auto limit = [&](std::string_view name, ir::ExprId value) {
      if (!value.Valid()) return;
      out_.Append(name);
      Expr(value);
      out_.Append(' ');
    };
    limit("LLI ", variable.lower_limit);
    limit("ULI ", variable.upper_limit);
  } else {
    out_.Append(", ");
  }
  out_.Append(module_.View(variable.name));
  Dimensions(variable.dimension_count, variable.dimensions);
  if (variable.initial.Valid()) {
    out_.Append('=');
    Expr(variable.initial);
  } else if (variable.initial_list.Valid()) {
    out_.Append('=');
    AssignList(variable.initial_list);
  }
}

void Printer::Header(const ir::Word& word) {
  const ir::Program& program = module_.programs[word.Extra<ir::ProgramId>()];
  out_.Append("PROC ");
  out_.Append(module_.View(program.name));
  if (!program.parameters.Empty()) {
    out_.Append('(');
    for (std::uint32_t i = 0; i < program.parameters.count; ++i) {
      if (i != 0) out_.Append(", ");
      const ir::Variable& parameter = module_.variables[program.parameters[i]];
      if (parameter.by_reference) out_.Append("VAR ");
      Type(parameter.type, parameter.string_length);
      out_.Append(' ');
      out_.Append(module_.View(parameter.name));
      Dimensions(parameter.dimension_count, parameter.dimensions);
      if (!parameter.initial.Valid()) continue;
      out_.Append('=');
      Expr(parameter.initial);
    }
    out_.Append(')');
  }
  if (word.spelling != 0) {
    out_.Append(' ');
    out_.Append(SpellingOf(word));
  } else if (program.saves_modal_state) {
    out_.Append(" SAVE");
  }
}

void Printer::Extern(ir::ExternId id) {
  const ir::Extern& record = module_.externs[id];
  out_.Append("EXTERN ");
  out_.Append(module_.View(record.name));
  if (record.param_count == 0) return;
  out_.Append('(');
  for (std::uint32_t i = 0; i < record.param_count; ++i) {
    if (i != 0) out_.Append(", ");
    const ir::ExternParam& parameter = module_.extern_params[record.first_param + i];
    if (parameter.by_reference) out_.Append("VAR ");
    Type(parameter.type, parameter.string_length);
    Dimensions(parameter.dimension_count, parameter.dimensions);
  }
  out_.Append(')');
}

}  // namespace ncport::backends::sinumerik
