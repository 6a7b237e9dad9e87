// Names, literals and expressions of dumps.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "base/number_text.h"
#include "ir/axis_names.h"
#include "ir/dump.h"
#include "ir/dump_parser.h"
#include "ir/dump_syntax.h"

namespace ncport::ir {

namespace {

constexpr std::uint32_t kMaxNumber = 0xFFFFFFFEU;
constexpr std::size_t kMaxCount = std::numeric_limits<std::uint16_t>::max();

}  // namespace

StringId DumpParser::Name() {
  if (scan_.Take("-")) return {};
  return NeedName();
}

StringId DumpParser::NeedName() {
  const std::string_view name = scan_.Name();
  return scan_.Failed() ? StringId{} : module_.strings.Intern(name);
}

template <class IdType>
IdType DumpParser::Ref(const NameMap<IdType>& map) {
  if (scan_.Take("-")) return {};
  scan_.Peek();
  const std::uint32_t begin = scan_.Begin();
  const std::string name(scan_.Name());
  const std::uint32_t ordinal = scan_.Ordinal();
  if (scan_.Failed()) return {};
  const auto found = map.find(module_.strings.Find(name).value);
  if (found == map.end() || ordinal == 0 || ordinal > found->second.size()) {
    scan_.FailAt(begin, "a declared name");
    return {};
  }
  return found->second[ordinal - 1];
}

template Id<Spelling> DumpParser::Ref(const NameMap<Id<Spelling>>& map);

ProgramId DumpParser::ProgramRef() { return Ref(programs_); }

FileId DumpParser::FileRef() {
  scan_.Need("@");
  const FileId file = Ref(files_);
  scan_.Need(":");
  return file;
}

VariableId DumpParser::VariableRef() {
  if (scan_.Take("-")) return {};
  scan_.Peek();
  const std::uint32_t begin = scan_.Begin();
  const std::string name(scan_.Name());
  if (scan_.Failed()) return {};
  const StringId id = module_.strings.Find(name);
  const auto ahead = scan_.Rest();
  if (!ahead.empty() && ahead.front() == '~') {
    const std::uint32_t ordinal = scan_.Ordinal();
    const auto found = variables_.find(id.value);
    if (found != variables_.end() && ordinal >= 1 && ordinal <= found->second.size()) return found->second[ordinal - 1];
  } else {
    const auto find = [&](ProgramId owner) {
      const auto found = by_owner_.find(static_cast<std::uint64_t>(owner.value) << 32U | id.value);
      return found == by_owner_.end() ? VariableId{} : found->second;
    };
    VariableId variable = program_.Valid() ? find(program_) : VariableId{};
    if (!variable.Valid()) variable = find(ProgramId{});
    if (variable.Valid()) return variable;
  }
  scan_.FailAt(begin, "a declared variable");
  return {};
}

std::uint8_t DumpParser::AxisRef() {
  scan_.Peek();
  const std::uint32_t begin = scan_.Begin();
  const std::string name(scan_.Name());
  std::uint32_t ordinal = scan_.Ordinal();
  if (scan_.Failed()) return 0;
  if (const auto letter = AxisOf(name)) {
    if (ordinal == 1) return *letter;
    --ordinal;
  }
  const StringId id = module_.strings.Find(name);
  for (std::size_t axis = 0; axis < module_.axis_names.size(); ++axis) {
    if (module_.axis_names[axis] == id && ordinal-- == 1) return static_cast<std::uint8_t>(kFirstNamedAxis + axis);
  }
  scan_.FailAt(begin, "a declared axis");
  return 0;
}

IdRange<ExprItemId> DumpParser::AddItems(const std::vector<ExprId>& items) {
  const auto begin = static_cast<std::uint32_t>(module_.expr_items.size());
  module_.expr_items.insert(module_.expr_items.end(), items.begin(), items.end());
  return {begin, static_cast<std::uint32_t>(items.size())};
}

void DumpParser::ItemList(Expr& expr, unsigned depth) {
  std::vector<ExprId> items;
  scan_.Need("(");
  if (!scan_.Take(")")) {
    do {
      items.push_back(ExprText(depth + 1));
    } while (!scan_.Failed() && scan_.Take(","));
    scan_.Need(")");
  }
  if (items.size() > kMaxCount) scan_.Fail("fewer operands");
  const auto range = AddItems(items);
  expr.b = range.begin;
  expr.count = static_cast<std::uint16_t>(range.count);
}

bool DumpParser::IsNumberAhead() {
  const char c = scan_.Peek();
  const auto is_digit = [](char d) { return d >= '0' && d <= '9'; };
  if (is_digit(c)) return true;
  if (c != '.' && c != '+' && c != '-') return false;
  const char second = scan_.PeekSecond();
  return is_digit(second) || (c != '.' && second == '.');
}

void DumpParser::LiteralText(Expr& expr) {
  const std::string_view rest = scan_.Rest();
  const char* p = rest.data();
  DecimalText number;
  if (rest.empty() || !ParseDecimal(p, rest.data() + rest.size(), number) || !std::isfinite(number.value)) {
    return scan_.Fail("a number");
  }
  expr.number = number.value;
  expr.format.int_digits = number.int_digits;
  expr.format.decimals = number.decimals;
  if (number.has_point) expr.format.flags |= NumberFormat::kPoint;
  if (rest.front() == '+') expr.format.flags |= NumberFormat::kPlusSign;
  scan_.Advance(static_cast<std::size_t>(p - rest.data()));
}

void DumpParser::LiteralFields(Expr& expr) {
  scan_.Need("(");
  expr.number = scan_.Double();
  while (!scan_.Failed() && scan_.Take(",")) {
    const std::string_view name = scan_.Keyword();
    if (name == "digits") {
      expr.format.int_digits = static_cast<std::uint8_t>(scan_.Number(255));
      expr.format.decimals = static_cast<std::uint8_t>(scan_.Number(255));
    } else if (name == "as") {
      const StringId text = NeedName();
      const auto [entry, added] =
          literal_texts_.try_emplace(text.value, static_cast<std::uint16_t>(module_.literal_texts.size()));
      if (added) {
        if (module_.literal_texts.size() > kMaxCount) return scan_.Fail("fewer spelled literals");
        module_.literal_texts.push_back(text);
      }
      expr.count = entry->second;
      expr.format.flags |= NumberFormat::kAsText;
    } else {
      const auto* const flag = std::ranges::find(kNumberFlagNames, name);
      if (flag == std::end(kNumberFlagNames)) return scan_.Fail("a property of a literal");
      expr.format.flags |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(flag - std::begin(kNumberFlagNames)));
    }
  }
  scan_.Need(")");
}

ExprPlace DumpParser::Suffixes(Expr& expr) {
  while (!scan_.Failed() && scan_.Take("!")) {
    const auto* const flag = std::ranges::find(kExprFlagNames, scan_.Keyword());
    if (flag == std::end(kExprFlagNames)) {
      scan_.Fail("a flag of an expression");
      return {};
    }
    expr.flags |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(flag - std::begin(kExprFlagNames)));
  }
  if (scan_.Take(":")) expr.type = Value<Type>("a type");
  ExprPlace place;
  if (scan_.Take("@")) {
    place.begin = scan_.Number(kMaxNumber);
    scan_.Need("+");
    place.length = scan_.Number(kMaxNumber);
  }
  return place;
}

ExprId DumpParser::ExprText(unsigned depth) {
  if (depth >= kMaxExprDepth) {
    scan_.Fail("an expression of less than " + std::to_string(kMaxExprDepth) + " levels");
    return {};
  }
  Expr expr;
  ExprPlace place;
  if (IsNumberAhead()) {
    LiteralText(expr);
    place = Suffixes(expr);
  } else if (scan_.Peek() == '"') {
    expr.op = ExprOp::kText;
    expr.a = module_.strings.Intern(scan_.Text()).value;
    expr.b = 0;
    place = Suffixes(expr);
  } else {
    expr.op = Value<ExprOp>("an expression");
    if (expr.op == ExprOp::kLiteral) {
      LiteralFields(expr);
      place = Suffixes(expr);
    } else {
      place = Suffixes(expr);
      expr.b = 0;
      switch (expr.op) {
        case ExprOp::kLiteral:
          break;
        case ExprOp::kText:
          scan_.Fail("a text in quotes");
          break;
        case ExprOp::kVacant:
          expr.a = 0;
          break;
        case ExprOp::kAxisName:
          expr.a = AxisRef();
          break;
        case ExprOp::kVariable:
          expr.a = VariableRef().value;
          break;
        case ExprOp::kElement:
          expr.a = VariableRef().value;
          ItemList(expr, depth);
          break;
        case ExprOp::kCell:
          expr.a = Ref(spaces_).value;
          scan_.Need("[");
          expr.b = scan_.Number(0xFFFFFFFFU);
          scan_.Need("]");
          break;
        case ExprOp::kCellAt:
          expr.b = Ref(spaces_).value;
          scan_.Need("[");
          expr.a = ExprText(depth + 1).value;
          scan_.Need("]");
          break;
        case ExprOp::kSystem:
          expr.a = Ref(systems_).value;
          ItemList(expr, depth);
          break;
        case ExprOp::kName:
          expr.a = Name().value;
          ItemList(expr, depth);
          break;
        case ExprOp::kFunction:
          expr.a = static_cast<std::uint32_t>(Value<Function>("a function"));
          ItemList(expr, depth);
          break;
        default:
          scan_.Need("(");
          expr.a = ExprText(depth + 1).value;
          if (OperandsOf(expr.op) == Operands::kBinary) {
            scan_.Need(",");
            expr.b = ExprText(depth + 1).value;
          }
          scan_.Need(")");
          break;
      }
    }
  }
  return scan_.Failed() ? ExprId{} : module_.AddExpr(expr, place);
}

}  // namespace ncport::ir
