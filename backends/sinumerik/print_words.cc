// Words: codes, axes, addresses with a value, assignments.
#include <fmt/format.h>

#include "backends/sinumerik/printer.h"
#include "base/number_text.h"
#include "base/result.h"
#include "dialects/sinumerik/words.h"

namespace ncport::backends::sinumerik {

namespace words = dialects::sinumerik;
using ir::ExprOp;
using ir::ValueMode;
using ir::WordOp;

void Printer::Word(const ir::Word& word) {
  switch (word.op) {
    case WordOp::kAxis:
      return Axis(word);
    case WordOp::kAxisComputed:
      out_.Append("AX[");
      Expr(word.Extra<ir::ExprId>());
      out_.Append("]=");
      Value(word);
      return;
    case WordOp::kComputedG:
      out_.Append("G=");
      Expr(word.value);
      return;
    case WordOp::kComputedM:
    case WordOp::kAux:
      return AuxiliaryM(word);
    case WordOp::kAssign:
      Expr(word.Extra<ir::ExprId>());
      out_.Append('=');
      Expr(word.value);
      return;
    case WordOp::kAssignList: {
      const auto id = word.Extra<ir::AssignListId>();
      Expr(module_.assign_lists[id].place);
      out_.Append('=');
      AssignList(id);
      return;
    }
    case WordOp::kMessage:
      out_.Append("MSG(");
      if (word.value.Valid()) Expr(word.value);
      if (word.Extra<ir::ExprId>().Valid()) {
        out_.Append(',');
        Expr(word.Extra<ir::ExprId>());
      }
      out_.Append(')');
      return;
    case WordOp::kAlarm:
      out_.Append("SETAL(");
      Expr(word.value);
      if (word.Extra<ir::ExprId>().Valid()) {
        out_.Append(',');
        Expr(word.Extra<ir::ExprId>());
      }
      out_.Append(')');
      return;
    case WordOp::kPreprocessStop:
      out_.Append("STOPRE");
      return;
    case WordOp::kHeader:
      return Header(word);
    case WordOp::kExtern:
      return Extern(word.Extra<ir::ExternId>());
    case WordOp::kFileMark:
      out_.Append(SpellingOf(word));
      return;
    case WordOp::kVerbatim:
      out_.Append(module_.View(word.Extra<StringId>()));
      return;
    case WordOp::kInert:
      // An address with a value, a word, or text that is kept as it was written.
      return word.value.Valid() ? Address(word) : Code(word);
    case WordOp::kWorkpiece:
    case WordOp::kJump:
    case WordOp::kSwitch:
    case WordOp::kCall:
    case WordOp::kModalCall:
    case WordOp::kRepeatPart:
    case WordOp::kReturn:
    case WordOp::kIf:
    case WordOp::kElse:
    case WordOp::kEndIf:
    case WordOp::kWhile:
    case WordOp::kEndWhile:
    case WordOp::kLoop:
    case WordOp::kEndLoop:
    case WordOp::kRepeat:
    case WordOp::kUntil:
    case WordOp::kFor:
    case WordOp::kEndFor:
      return Flow(word);
    default:
      break;
  }
  if (word.value.Valid()) return Address(word);
  Code(word);
}

/// A code: its row's text, with as many digits as were written (G01).
void Printer::Code(const ir::Word& word) {
  std::string_view text = SpellingOf(word);
  if (word.spelling == 0) {
    const dialects::CodeRow* row = words::Codes().FindMeaning(word.op, word.index, word.extra);
    // The extension of a spindle is no part of the meaning that the table holds.
    if (row == nullptr && word.op == WordOp::kSpindle) row = words::Codes().FindMeaning(word.op, 0, word.extra);
    NCPORT_CHECK(row != nullptr, "SINUMERIK has no word for {} {} {}", ir::NameOf(word.op), word.index, word.extra);
    text = row->text;
  }
  if (word.op == WordOp::kSpindle && (word.index != 0 || (word.flags & ir::Word::kEqualSign) != 0)) {
    // M2=3: the spindle is an extension of M.
    out_.Append('M');
    if (word.index != 0) AppendInteger(out_, word.index);
    out_.Append('=');
    out_.Append(text.substr(1));
    return;
  }
  if ((word.flags & ir::Word::kEqualSign) != 0 && text.size() > 1 && text[0] == 'M') {
    out_.Append("M=");
    out_.Append(text.substr(1));
    return;
  }
  if (word.digits == 0) {
    out_.Append(text);
    return;
  }
  out_.Append(text[0]);
  for (std::size_t digits = text.size() - 1; digits < word.digits; ++digits) out_.Append('0');
  out_.Append(text.substr(1));
}

void Printer::AuxiliaryM(const ir::Word& word) {
  out_.Append('M');
  if (word.index != 0) AppendInteger(out_, word.index);
  const ir::Expr& value = module_.exprs[word.value];
  const bool plain =
      word.op == WordOp::kAux && value.op == ExprOp::kLiteral && word.index == 0 && word.mode == ValueMode::kModal;
  if (!plain || (word.flags & ir::Word::kEqualSign) != 0) out_.Append('=');
  Value(word);
}

void Printer::Axis(const ir::Word& word) {
  const std::size_t begin = out_.size();
  AxisName(word.index);
  if (NeedsEqualSign(word, out_.View().substr(begin))) out_.Append('=');
  Value(word);
}

/// F100, CR=20, S2=500, LIMS[2]=3000.
void Printer::Address(const ir::Word& word) {
  std::string_view name = SpellingOf(word);
  bool numbered = false;
  if (word.spelling == 0) {
    // G4 turns F and S of its block into the dwell. Blocks that were read hold it as a word of its own.
    if (word.op == WordOp::kDwellSeconds || word.op == WordOp::kDwellRevolutions) out_.Append("G4 ");
    const WordOp op = word.op == WordOp::kDwellSeconds       ? WordOp::kFeed
                      : word.op == WordOp::kDwellRevolutions ? WordOp::kSpeed
                                                             : word.op;
    const words::AddressRow* row = words::FindAddress(op, word.index);
    NCPORT_CHECK(row != nullptr, "SINUMERIK has no address for {} {}", ir::NameOf(word.op), word.index);
    name = row->text;
    numbered = row->extension != words::Extension::kNone;
  } else {
    for (const words::AddressRow& row : words::Addresses()) {
      if (row.text == name) numbered = row.extension != words::Extension::kNone;
    }
  }
  const std::size_t begin = out_.size();
  out_.Append(name);
  if (numbered && word.index != 0) {
    // Letters take the number directly, words in brackets.
    out_.Append(name.size() == 1 ? fmt::format("{}", word.index) : fmt::format("[{}]", word.index));
  }
  if (NeedsEqualSign(word, out_.View().substr(begin))) out_.Append('=');
  Value(word);
}

/// Card 2.2: only a single letter with one constant goes without.
bool Printer::NeedsEqualSign(const ir::Word& word, std::string_view name) const {
  if ((word.flags & ir::Word::kEqualSign) != 0 || name.size() != 1) return true;
  if (word.mode != ValueMode::kModal && word.mode != ValueMode::kStep) return true;
  const ir::Expr* value = &module_.exprs[word.value];
  while (value->op == ExprOp::kConvert) value = &module_.exprs[ir::ExprId{value->a}];
  return value->op != ExprOp::kLiteral || value->type == ir::Type::kBool;
}

/// The value of a word, in its mode: AC(..), IC(..).
void Printer::Value(const ir::Word& word) {
  if (word.mode != ValueMode::kModal && word.mode != ValueMode::kStep) {
    for (const words::ModeRow& row : words::ValueModes()) {
      if (row.mode != word.mode) continue;
      out_.Append(row.text);
      out_.Append('(');
      Expr(word.value);
      out_.Append(')');
      return;
    }
    NCPORT_BUG("SINUMERIK has no value mode {}", static_cast<int>(word.mode));
  }
  Expr(word.value);
}

}  // namespace ncport::backends::sinumerik
