// Words of a block: codes, axes, addresses, assignments.
#include "base/result.h"
#include "frontend/sinumerik/lower.h"
#include "frontend/sinumerik/word_index.h"
#include "ir/modes.h"

namespace ncport::frontend::sinumerik {

namespace words = dialects::sinumerik;
using diag::Code;
using ir::ExprId;
using ir::ValueMode;
using ir::Word;
using ir::WordOp;

Word& Lowering::AddWord(WordOp op, std::uint32_t first, std::uint32_t last) {
  Word& word = module_.words.Emplace();
  word.op = op;
  word.phase = ir::DefaultPhaseOf(op);
  word.begin = tokens_[first].offset;
  word.length = tokens_[last].End() - word.begin;
  return word;
}

std::uint16_t Lowering::CodeSpelling(std::uint32_t row) {
  std::uint16_t& spelling = code_spellings_[row];
  if (spelling == 0) {
    const auto& code = words::Codes().Rows()[row];
    spelling = SpellingOf(code.text, code.rule);
  }
  return spelling;
}

std::uint16_t Lowering::AddressSpelling(std::uint32_t row) {
  std::uint16_t& spelling = address_spellings_[row];
  if (spelling == 0) {
    const auto& address = words::Addresses()[row];
    spelling = SpellingOf(address.text, address.rule);
  }
  return spelling;
}

bool Lowering::OnceAxis(std::uint8_t axis, const Token& token) {
  const std::uint32_t bit = 1U << axis;
  if ((axes_ & bit) != 0) return Fail(Code::kDoubleWord, token);
  axes_ |= bit;
  return true;
}

bool Lowering::OnceAddress(std::uint32_t row, const Token& token) {
  const std::uint64_t bit = std::uint64_t{1} << row;
  const bool counts = words::Addresses()[row].extension == words::Extension::kNone;
  if (counts && (addresses_ & bit) != 0) return Fail(Code::kDoubleWord, token);
  addresses_ |= bit;
  return true;
}

bool Lowering::TakeMode(Word& word, std::uint8_t allowed) {
  if (mode_ == nullptr) return true;
  const auto& row = words::ValueModes()[mode_->data];
  if ((row.needs & allowed) == 0) return Fail(Code::kUnexpectedText, *mode_);
  word.mode = row.mode;
  mode_ = nullptr;
  return true;
}

bool Lowering::AddCode(const Token& token) {
  if (token.data == kAuxiliaryRow) {
    const auto& row = words::AuxiliaryCode();
    Token number = token;
    number.format = {.int_digits = token.digits};
    const ExprId value = Literal(number);
    const auto index = static_cast<std::uint32_t>(&token - tokens_.data());
    Word& word = AddWord(row.op, index, index);
    word.phase = row.phase;
    word.value = value;
    word.spelling = SpellingOf(row.text, row.rule);
    return true;
  }
  const auto& row = words::Codes().Rows()[token.data];
  if (row.group != 0) {
    const std::uint64_t bit = std::uint64_t{1} << row.group;
    if ((groups_ & bit) != 0) {
      // The other word of the group stands before this one.
      for (const Token& other : tokens_) {
        if (other.kind == token.kind && other.data != kAuxiliaryRow &&
            words::Codes().Rows()[other.data].group == row.group) {
          Fail(Code::kWordConflict, token);
          error_.other_begin = other.offset;
          error_.other_length = other.length;
          return false;
        }
      }
    }
    groups_ |= bit;
  }
  ExprId value;
  if (row.op == WordOp::kAux) {
    Token number = token;
    number.format = {.int_digits = token.digits};
    value = Literal(number);
  }
  const auto index = static_cast<std::uint32_t>(&token - tokens_.data());
  Word& word = AddWord(row.op, index, index);
  word.index = row.index;
  if (row.op != WordOp::kAux) word.extra = row.extra;  // there it is the number, which the word holds as its value
  word.phase = row.phase;
  word.flags = row.flags;
  word.value = value;
  word.spelling = CodeSpelling(token.data);
  if (token.digits != 0 && token.digits + 1U != row.text.size()) word.digits = token.digits;
  if (row.op == WordOp::kInert && row.phase == ir::Phase::kMotion) dwell_ = &token;
  return true;
}

bool Lowering::AddConstant(const Token& token) {
  const auto index = static_cast<std::uint32_t>(&token - tokens_.data());
  const ExprId value = Literal(token);
  if (token.kind == static_cast<std::uint16_t>(TokenKind::kAxisValue)) {
    if (!OnceAxis(token.sub, token)) return false;
    Word& word = AddWord(WordOp::kAxis, index, index);
    word.index = token.sub;
    word.value = value;
    return true;
  }
  // The row of the address is found by its letter: data holds the spelling of a number kept as text.
  const std::uint32_t row_number = token.digits;
  const Row& row = words::Addresses()[row_number];
  if (!OnceAddress(row_number, token)) return false;
  Word& word = AddWord(row.op, index, index);
  word.index = row.index;
  word.phase = row.phase;
  word.value = value;
  word.spelling = AddressSpelling(row_number);
  if (row.op == WordOp::kCenter) word.mode = ValueMode::kStep;
  return true;
}

bool Lowering::AddAxis(const Action& action) {
  const ExprId value = Pop();
  const Token& token = At(action.first);
  std::uint8_t axis = 0;
  if (!AxisOf(token, axis) || !OnceAxis(axis, token)) return false;
  Word& word = AddWord(WordOp::kAxis, action.first, action.last);
  word.index = axis;
  word.value = value;
  word.flags = Word::kEqualSign;
  return TakeMode(word, words::kLinearModes | words::kRotaryModes | words::kDiameterModes);
}

bool Lowering::AddAddress(const Action& action) {
  const ExprId value = Pop();
  const ExprId index = action.arg != 0 ? Pop() : ExprId{};
  const Token& token = At(action.first);
  const Row& row = words::Addresses()[token.data];
  if (!OnceAddress(token.data, token)) return false;
  if (row.op == WordOp::kInert && index.Valid()) return AddInertText(action);
  Word& word = AddWord(row.op, action.first, action.last);
  word.index = row.index;
  word.phase = row.phase;
  word.value = value;
  word.flags = Word::kEqualSign;
  word.spelling = AddressSpelling(token.data);
  if (row.op == WordOp::kCenter) word.mode = ValueMode::kStep;
  if (row.extension != words::Extension::kNone) word.index = token.sub;
  if (index.Valid()) {
    std::uint32_t number = 0;
    if (row.extension == words::Extension::kNone || token.sub != 0)
      return Fail(Code::kUnexpectedText, At(action.first + 1U));
    if (!LiteralInt(index, 99, number)) {
      return Fail(Code::kNotSupported, token, "the number in the brackets must be a constant");
    }
    word.index = static_cast<std::uint8_t>(number);
  }
  return TakeMode(word, row.modes);
}

// M=3, M2=3, M[2]=3, M=expr, M=QU(5).
bool Lowering::AddComputedM(const Action& action) {
  const ExprId value = Pop();
  const ExprId index = action.arg != 0 ? Pop() : ExprId{};
  const Token& token = At(action.first);
  std::uint32_t extension = token.sub;
  if (index.Valid() && (extension != 0 || !LiteralInt(index, 99, extension))) {
    return Fail(Code::kNotSupported, token, "the number in the brackets must be a constant");
  }
  std::uint32_t number = 0;
  const std::uint32_t row_number =
      mode_ == nullptr && LiteralInt(value, 99, number) ? FindMCode(number) : kAuxiliaryRow;
  if (row_number != kAuxiliaryRow) {
    const auto& row = words::Codes().Rows()[row_number];
    if (extension == 0 || row.op == WordOp::kSpindle || row.op == WordOp::kAux) {
      Word& word = AddWord(row.op, action.first, action.last);
      word.index =
          row.op == WordOp::kSpindle || row.op == WordOp::kAux ? static_cast<std::uint8_t>(extension) : row.index;
      if (row.op != WordOp::kAux) word.extra = row.extra;
      word.phase = row.phase;
      word.flags = Word::kEqualSign;
      word.spelling = CodeSpelling(row_number);
      if (row.op == WordOp::kAux) word.value = value;
      return true;
    }
  }
  Word& word = AddWord(WordOp::kComputedM, action.first, action.last);
  word.index = static_cast<std::uint8_t>(extension);
  word.value = value;
  word.flags = Word::kEqualSign;
  return TakeMode(word, words::kQuickMode);
}

bool Lowering::AddInertText(const Action& action) {
  Word& word = AddWord(WordOp::kInert, action.first, action.last);
  word.spelling = SpellingOf(TextOf(action), "sinumerik-8.11");
  return word.spelling != 0 || Fail(Code::kTooManyWords, At(action.first));
}

bool Lowering::DoWord(const Action& action) {
  const Token& token = At(action.first);
  switch (static_cast<Step>(action.op)) {
    case Step::kSkip:
    case Step::kBlockNumber:
    case Step::kMainNumber:
    case Step::kLabel: {
      // The head was filled before: a refused block has one too.
      return true;
    }
    case Step::kCode:
      return AddCode(token);
    case Step::kConstant:
      return AddConstant(token);
    case Step::kMode:
      mode_ = &token;
      return true;
    case Step::kAxis:
      return AddAxis(action);
    case Step::kAxisAt: {
      const ExprId value = Pop();
      const ExprId axis = Pop();
      Word& word = AddWord(WordOp::kAxisComputed, action.first, action.last);
      word.value = value;
      word.extra = axis.value;
      word.flags = Word::kEqualSign;
      return TakeMode(word, words::kLinearModes | words::kRotaryModes | words::kDiameterModes);
    }
    case Step::kAddress:
      return AddAddress(action);
    case Step::kComputedG: {
      Word& word = AddWord(WordOp::kComputedG, action.first, action.last);
      word.value = Pop();
      word.flags = Word::kEqualSign;
      return true;
    }
    case Step::kComputedM:
      return AddComputedM(action);
    case Step::kAssign: {
      const ExprId value = Pop();
      const ExprId place = Pop();
      Word& word = AddWord(WordOp::kAssign, action.first, action.last);
      word.value = value;
      word.extra = place.value;
      word.flags = Word::kEqualSign;
      return true;
    }
    case Step::kAssignList:
    case Step::kAssignRepeated: {
      ir::AssignList list;
      list.repeat = static_cast<Step>(action.op) == Step::kAssignRepeated;
      const std::size_t values = list.repeat ? 1 : action.count;
      if (list.repeat && action.count == 2) list.count = Pop();
      list.values = {static_cast<std::uint32_t>(module_.expr_items.size()), static_cast<std::uint32_t>(values)};
      for (std::size_t i = values_.size() - values; i < values_.size(); ++i) module_.expr_items.push_back(values_[i]);
      values_.resize(values_.size() - values);
      list.place = Pop();
      const ir::AssignListId id = module_.assign_lists.Add(list);
      AddWord(WordOp::kAssignList, action.first, action.last).extra = id.value;
      return true;
    }
    default:
      NCPORT_BUG("step {} is no word", action.op);
  }
}

}  // namespace ncport::frontend::sinumerik
