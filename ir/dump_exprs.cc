// Names, literals and expressions of dumps.
#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "base/number_text.h"
#include "ir/axis_names.h"
#include "ir/dump_syntax.h"
#include "ir/dump_writer.h"

namespace ncport::ir {

void DumpWriter::Number(std::uint64_t value) {
  const fmt::format_int text(value);
  Put(std::string_view{text.data(), text.size()});
}

void DumpWriter::Unknown(std::uint64_t value) {
  Put('?');
  Number(value);
}

void DumpWriter::Ordinal(std::uint32_t ordinal) {
  if (ordinal <= 1) return;
  Put('~');
  Number(ordinal);
}

void DumpWriter::Quoted(std::string_view text) {
  Put('"');
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      Put('\\');
      Put(c);
    } else if (byte < 0x20 || byte == 0x7F) {
      constexpr std::string_view kHex = "0123456789ABCDEF";
      Put("\\x");
      Put(kHex[byte >> 4U]);
      Put(kHex[byte & 15U]);
    } else {
      Put(c);
    }
  }
  Put('"');
}

void DumpWriter::BareOrQuoted(std::string_view text) { IsBareName(text) ? Put(text) : Quoted(text); }

void DumpWriter::Name(StringId id) {
  if (!id.Valid()) return Put('-');
  if (id.value >= module_.strings.Size()) return Unknown(id.value);
  BareOrQuoted(module_.strings.View(id));
}

void DumpWriter::ProgramRef(ProgramId id) { Ref(module_.programs, programs_, id); }

void DumpWriter::AxisRef(std::uint32_t axis) {
  if (axis < kLetterAxes) return Put(kAxisLetters[axis]);
  const std::uint32_t named = axis - kFirstNamedAxis;
  if (named >= module_.axis_names.size() || axis >= kMaxAxes) return Unknown(axis);
  // Axes are few: those of the same name before this one are counted.
  const StringId name = module_.axis_names[named];
  const std::string_view text = name.value < module_.strings.Size() ? module_.strings.View(name) : std::string_view{};
  std::uint32_t ordinal = AxisOf(text) ? 2 : 1;
  for (std::uint32_t before = 0; before < named; ++before) ordinal += module_.axis_names[before] == name ? 1U : 0U;
  Name(name);
  Ordinal(ordinal);
}

void DumpWriter::VariableRef(VariableId id) {
  if (!id.Valid()) return Put('-');
  if (!module_.variables.Contains(id)) return Unknown(id.value);
  const StringId name = module_.variables[id].name;
  const auto find = [&](ProgramId owner) {
    const auto found = by_owner_.find(static_cast<std::uint64_t>(owner.value) << 32U | name.value);
    return found == by_owner_.end() ? VariableId{} : found->second;
  };
  VariableId plain = program_.Valid() ? find(program_) : VariableId{};
  if (!plain.Valid()) plain = find(ProgramId{});
  Name(name);
  if (plain == id) return;
  Put('~');
  Number(variables_.Of(id));
}

void DumpWriter::Suffixes(ExprId id) {
  const ir::Expr& expr = module_.exprs[id];
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((expr.flags >> bit & 1U) == 0) continue;
    Put('!');
    bit < std::size(kExprFlagNames) ? Put(kExprFlagNames[bit]) : Unknown(bit);
  }
  if (expr.type != Type::kNone) {
    Put(':');
    Known(expr.type);
  }
  if (!options_.places) return;
  const ExprPlace place = module_.expr_places.Of(id);
  if (place.begin == 0 && place.length == 0) return;
  Put('@');
  Number(place.begin);
  Put('+');
  Number(place.length);
}

void DumpWriter::Literal(const ir::Expr& expr) {
  const NumberFormat format = expr.format;
  const bool plain = (format.flags & ~(NumberFormat::kPoint | NumberFormat::kPlusSign)) == 0 && expr.count == 0 &&
                     std::isfinite(expr.number);
  if (plain) {
    const std::size_t start = out_.size();
    const bool plus = (format.flags & NumberFormat::kPlusSign) != 0;
    const bool point = (format.flags & NumberFormat::kPoint) != 0;
    if (plus) Put('+');
    AppendNumber(out_, expr.number, format.int_digits, format.decimals, point);
    // As written, if that says everything.
    const std::string_view text = out_.View().substr(start);
    const char* p = text.data();
    DecimalText read;
    if (ParseDecimal(p, text.data() + text.size(), read) && p == text.data() + text.size() &&
        std::bit_cast<std::uint64_t>(read.value) == std::bit_cast<std::uint64_t>(expr.number) &&
        read.int_digits == format.int_digits && read.decimals == format.decimals && read.has_point == point) {
      return;
    }
    out_.Truncate(start);
  }
  Put(NameOf(ExprOp::kLiteral));
  Put('(');
  Put(fmt::format("{}", expr.number));
  if (format.int_digits != 0 || format.decimals != 0) {
    Put(", digits ");
    Number(format.int_digits);
    Put(' ');
    Number(format.decimals);
  }
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((format.flags >> bit & 1U) == 0) continue;
    if (1U << bit == NumberFormat::kAsText && expr.count != 0) continue;  // said by `as`
    Put(", ");
    bit < std::size(kNumberFlagNames) ? Put(kNumberFlagNames[bit]) : Unknown(bit);
  }
  if (expr.count != 0) {
    Put(", as ");
    expr.count < module_.literal_texts.size() ? Name(module_.literal_texts[expr.count]) : Unknown(expr.count);
  }
  Put(')');
}

void DumpWriter::List(const ir::Expr& expr, unsigned depth) {
  Put('(');
  for (std::uint32_t i = 0; i < expr.count; ++i) {
    if (i != 0) Put(", ");
    const std::uint64_t item = std::uint64_t{expr.b} + i;
    item < module_.expr_items.size() ? Expr(module_.expr_items[item], depth + 1) : Unknown(item);
  }
  Put(')');
}

void DumpWriter::Expr(ExprId id, unsigned depth) {
  if (!id.Valid()) return Put('-');
  if (!module_.exprs.Contains(id)) return Unknown(id.value);
  if (depth == 0) budget_ = 1U << 20U;
  // Only broken modules come here: cycles, or nodes shared a million times.
  if (depth > kMaxExprDepth || budget_ == 0) return Unknown(id.value);
  --budget_;
  const ir::Expr& expr = module_.exprs[id];
  if (expr.op == ExprOp::kLiteral) {
    Literal(expr);
    return Suffixes(id);
  }
  const auto operand = [](std::uint32_t value) {
    ExprId result;
    result.value = value;
    return result;
  };
  const auto space = [&](std::uint32_t value) {
    SpaceId result;
    result.value = value;
    Put(' ');
    Ref(module_.spaces, spaces_, result);
  };
  StringId string;
  string.value = expr.a;
  if (expr.op == ExprOp::kText) {
    string.value < module_.strings.Size() ? Quoted(module_.strings.View(string)) : Unknown(string.value);
    return Suffixes(id);
  }
  Known(expr.op);
  Suffixes(id);
  switch (expr.op) {
    case ExprOp::kLiteral:
    case ExprOp::kText:
    case ExprOp::kVacant:
      return;
    case ExprOp::kAxisName:
      Put(' ');
      return AxisRef(expr.a);
    case ExprOp::kVariable:
    case ExprOp::kElement: {
      VariableId variable;
      variable.value = expr.a;
      Put(' ');
      VariableRef(variable);
      if (expr.op == ExprOp::kElement) List(expr, depth);
      return;
    }
    case ExprOp::kCell:
      space(expr.a);
      Put('[');
      Number(expr.b);
      return Put(']');
    case ExprOp::kCellAt:
      space(expr.b);
      Put('[');
      Expr(operand(expr.a), depth + 1);
      return Put(']');
    case ExprOp::kSystem: {
      SystemId system;
      system.value = expr.a;
      Put(' ');
      Ref(module_.systems, systems_, system);
      return List(expr, depth);
    }
    case ExprOp::kName:
      Put(' ');
      Name(string);
      return List(expr, depth);
    case ExprOp::kFunction:
      Put(' ');
      expr.a < 256 ? Known(static_cast<Function>(expr.a)) : Unknown(expr.a);
      return List(expr, depth);
    default:
      break;
  }
  Put('(');
  Expr(operand(expr.a), depth + 1);
  if (OperandsOf(expr.op) == Operands::kBinary) {
    Put(", ");
    Expr(operand(expr.b), depth + 1);
  }
  Put(')');
}

}  // namespace ncport::ir
