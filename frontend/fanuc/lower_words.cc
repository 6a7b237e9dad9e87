// Words with a letter: what they mean beside the codes of their block (fanuc-2.2, 8; mazak-lathe-3, 4, 5).
#include <algorithm>
#include <cmath>

#include "base/result.h"
#include "frontend/fanuc/cycle_words.h"
#include "frontend/fanuc/lower.h"
#include "ir/axis_names.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using diag::Code;
using ir::ExprId;
using ir::Word;
using ir::WordOp;
using words::NumberForm;

namespace {

constexpr std::uint8_t At8(ir::CycleField field) { return static_cast<std::uint8_t>(field); }

}  // namespace

Word& Lowering::AddWord(WordOp op, const Pending& pending) { return AddWord(op, pending.first, pending.last); }

const Lowering::Pending* Lowering::FindLetter(char letter) const {
  for (const Pending& pending : pending_) {
    if (pending.letter == letter) return &pending;
  }
  return nullptr;
}

bool Lowering::NamesAxes() const {
  return std::ranges::any_of(pending_, [](const Pending& pending) { return ir::AxisOf(pending.letter).has_value(); });
}

bool Lowering::Whole(const Pending& pending) {
  if (!IsLiteral(pending) || !HasPoint(pending)) return true;
  return Fail(Code::kUnexpectedText, pending, "this address takes whole numbers without a point");
}

bool Lowering::Meaningless(const Pending& pending) {
  // Whether U and W move incrementally without G91 there is a matter of the control (fanuc-8.2, 30i).
  const bool by_g91 = system_ == words::System::kLatheB || system_ == words::System::kLatheC;
  if (by_g91 && (pending.letter == 'U' || pending.letter == 'W'))
    return Fail(Code::kNotSupported, pending, "not all controls take it: G91 with X or Z says the same");
  return Fail(Code::kUnknownAddress, pending, "no code of this block gives the letter a meaning");
}

ExprId Lowering::ValueOf(const Pending& pending, std::uint8_t& flags) {
  if (!IsLiteral(pending)) {
    flags |= Word::kVanishesVacant;
    return pending.value;
  }
  return Literal(At(pending.first));
}

bool Lowering::SetValue(Word& word, const Pending& pending, bool scaled) {
  std::uint8_t flags = 0;
  const ExprId value = ValueOf(pending, flags);
  if (!IsLiteral(pending)) {
    flags |= Word::kRoundsValue;
  } else if (scaled && !HasPoint(pending) && increments_ && NumberOf(pending) != 0) {
    flags |= Word::kIncrements;
  }
  word.value = value;
  word.flags |= flags;
  return scaled || Whole(pending);
}

bool Lowering::AddPending(const Pending& pending, const Context& context) {
  switch (pending.letter) {
    case kSkipLetter: {
      const Token& token = At(pending.first);
      Word& word = AddWord(WordOp::kSkipRest, pending);
      word.index = token.digits != 0 ? token.sub : static_cast<std::uint8_t>(profile_.skip.Or(1));
      word.digits = token.digits;
      word.spelling = SpellingOf("/", "fanuc-1");
      return true;
    }
    case kNameLetter:
      if (context.subprogram) return true;
      return Fail(Code::kUnexpectedText, pending, "a name stands behind M98, G65 or G66");
    case 'c':
    case 'r':
    case 'a':
      return AddOption(pending);
    case 'G':
    case 'M':
      if (IsLiteral(pending))
        return pending.meaning.special != nullptr ? AddSpecial(pending, context) : AddCode(pending, context);
      break;
    default:
      break;
  }
  const words::AddressRow* row = words::FindAddress(system_, pending.letter);
  if (context.cycle != nullptr) {
    bool done = false;
    if (!AddCycleWord(pending, context, done)) return false;
    if (done) return true;
  }
  if (row == nullptr) return Meaningless(pending);
  if (row->op == WordOp::kAxis) return AddAxis(pending, context, *row);
  return AddLetter(pending, context, *row);
}

bool Lowering::AddOption(const Pending& pending) {
  const bool angle = pending.letter == 'a';
  Word& word = AddWord(angle ? WordOp::kContourAngle : WordOp::kChamfer, pending);
  if (!angle)
    word.index = static_cast<std::uint8_t>(pending.letter == 'c' ? ir::ChamferKind::kLeg : ir::ChamferKind::kRound);
  word.spelling = SpellingOf(angle ? ",A" : pending.letter == 'c' ? ",C" : ",R", "fanuc-8.10");
  return SetValue(word, pending, true);
}

bool Lowering::AddAxis(const Pending& pending, const Context& context, const words::AddressRow& row) {
  if (context.dwell && (pending.letter == 'X' || pending.letter == 'U')) {
    Word& word = AddWord(WordOp::kDwellSeconds, pending);
    word.spelling = SpellingOf(pending.letter == 'X' ? "X" : "U", "fanuc-8.1");
    return SetValue(word, pending, true);
  }
  if (context.dwell) return Fail(Code::kUnexpectedText, pending, "a dwell moves no axis");
  if (context.diameter_switch) return true;
  if (!AxisExists(row.index)) return Fail(Code::kUnknownAddress, pending, "the profile has no such axis");
  Word& word = AddWord(WordOp::kAxis, pending);
  word.index = row.index;
  word.mode = row.mode;
  return SetValue(word, pending, true);
}

// Q of a thread counts thousandths of a degree, as a variable too: #1=90000 is 90 degrees (fanuc-8.1).
bool Lowering::AddStartAngle(const Pending& pending, std::string_view rule) {
  Word& word = AddWord(WordOp::kStartAngle, pending);
  word.spelling = SpellingOf("Q", rule);
  if (!SetValue(word, pending, false)) return false;  // with a point it is no count
  word.flags |= Word::kIncrements;
  return true;
}

bool Lowering::AddFeed(const Pending& pending) {
  Word& word = AddWord(WordOp::kFeed, pending);
  std::uint8_t flags = 0;
  word.value = ValueOf(pending, flags);
  if (IsLiteral(pending) && !HasPoint(pending) && increments_ && NumberOf(pending) != 0) flags |= Word::kIncrements;
  word.flags |= flags;
  return true;
}

// A lathe's T holds station and offset, the digits as the profile writes them (fanuc-8.11, mazak-lathe-4.1).
bool Lowering::AddTool(const Pending& pending) {
  const Token& token = At(pending.first);
  const bool turret = profile_.IsLathe() && system_ != words::System::kMazakM;
  if (!turret) {
    // `T01 T02 M6`: the second one is only made ready (mazak-lathe-4.2).
    const bool ready = FindLetter('T') != &pending;
    Word& word = AddWord(ready ? WordOp::kInert : WordOp::kTool, pending);
    word.digits = token.digits;
    word.spelling = SpellingOf("T", "fanuc-8.11");
    const bool suffix = system_ == words::System::kMazakM;
    return SetValue(word, pending, suffix) && ((word.flags &= static_cast<std::uint8_t>(~Word::kIncrements)), true);
  }
  if (!IsLiteral(pending))
    return Fail(Code::kNotSupported, pending, "the tool of a turret is translated as a number only");
  if (!Whole(pending)) return false;
  double base = 1;
  for (std::uint32_t digit = 0; digit < profile_.OffsetDigits(); ++digit) base *= 10;
  const double number = token.number;
  const double station = std::floor(number / base);
  if (station != 0) {
    Token value = token;
    value.number = station;
    value.format = {.int_digits = static_cast<std::uint8_t>(station < 10 ? 1 : station < 100 ? 2 : 3)};
    const ExprId id = Literal(value);
    Word& word = AddWord(WordOp::kTool, pending);
    word.value = id;
    word.digits = token.digits;
    word.spelling = SpellingOf("T", "fanuc-8.11");
  }
  const double offset = number - station * base;
  Token value = token;
  value.number = offset;
  value.format = {.int_digits = static_cast<std::uint8_t>(offset < 10 ? 1 : offset < 100 ? 2 : 3)};
  const ExprId id = Literal(value);
  Word& word = AddWord(WordOp::kToolOffset, pending);
  word.value = id;
  word.digits = token.digits;
  word.spelling = SpellingOf("T", "fanuc-8.11");
  return true;
}

bool Lowering::AddLetter(const Pending& pending, const Context& context, const words::AddressRow& row) {
  const auto inert = [&] {
    Word& word = AddWord(WordOp::kInert, pending);
    word.spelling = SpellingOf(std::string(1, pending.letter), row.rule);
    std::uint8_t flags = 0;
    word.value = ValueOf(pending, flags);
    word.flags |= flags;
    return true;
  };
  const auto field = [&](ir::CycleField which, bool scaled, bool thousandths = false) {
    Word& word = AddWord(WordOp::kCycleValue, pending);
    word.index = At8(which);
    word.spelling = SpellingOf(std::string(1, pending.letter), row.rule);
    if (!SetValue(word, pending, scaled)) return false;
    if (thousandths) word.flags |= Word::kIncrements;
    return true;
  };
  switch (pending.letter) {
    case 'G': {
      Word& word = AddWord(WordOp::kComputedG, pending);
      word.spelling = SpellingOf("G", row.rule);
      return SetValue(word, pending, true);
    }
    case 'M': {
      Word& word = AddWord(WordOp::kComputedM, pending);
      word.spelling = SpellingOf("M", row.rule);
      return SetValue(word, pending, false);
    }
    case 'F':
      return AddFeed(pending);
    case 'T':
      return AddTool(pending);
    case 'S': {
      Word& word = AddWord(context.preset ? WordOp::kSpeedLimit : WordOp::kSpeed, pending);
      word.index = context.spindle ? context.spindle_index : kMainSpindle;
      word.spelling = SpellingOf("S", row.rule);
      return SetValue(word, pending, false);
    }
    case 'I':
    case 'J':
    case 'K': {
      const auto coordinate = static_cast<std::uint8_t>(pending.letter - 'I');
      if (context.quiet) return inert();
      if (context.scaling) {
        Word& word = AddWord(WordOp::kFrameFactor, pending);
        word.index = static_cast<std::uint8_t>(coordinate + 1);
        word.spelling = SpellingOf(std::string(1, pending.letter), "fanuc-8.6");
        return SetValue(word, pending, true);
      }
      Word& word = AddWord(WordOp::kCenter, pending);
      word.index = coordinate;
      word.mode = row.mode;
      return SetValue(word, pending, true);
    }
    case 'R': {
      if (context.spindle || context.quiet) return inert();
      Word& word = AddWord(context.rotation ? WordOp::kFrameAngle : WordOp::kRadius, pending);
      word.spelling = SpellingOf("R", context.rotation ? "fanuc-8.5" : "fanuc-8.3");
      return SetValue(word, pending, true);
    }
    case 'P':
      if (context.subprogram || context.local_call || context.returns || context.extended_offset || context.offset)
        return true;
      if (context.dwell) {
        Word& word = AddWord(WordOp::kDwellSeconds, pending);
        word.spelling = SpellingOf("P", "fanuc-8.1");
        // Haas: seconds with a point, milliseconds without (fanuc-13).
        const bool seconds = profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas) && IsLiteral(pending) &&
                             HasPoint(pending);
        if (!SetValue(word, pending, seconds)) return false;
        if (!seconds) word.flags |= Word::kIncrements;
        return true;
      }
      if (context.scaling) {
        Word& word = AddWord(WordOp::kFrameFactor, pending);
        word.spelling = SpellingOf("P", "fanuc-8.6");
        if (!SetValue(word, pending, true)) return false;
        if (IsLiteral(pending) && !HasPoint(pending))
          word.flags |= Word::kIncrements;  // thousandths under both rules of the point
        return true;
      }
      if (context.quiet || context.reference || context.length_switch) return inert();
      // A dwell of a Haas: seconds with a point (fanuc-13).
      if (IsLiteral(pending) && HasPoint(pending) && profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas))
        return field(ir::CycleField::kDwell, true);
      return field(ir::CycleField::kDwell, false, true);
    case 'Q':
      if (context.subprogram) return true;
      if (context.thread) return AddStartAngle(pending, "fanuc-8.1");
      if (context.quiet || context.preset) return inert();
      return field(ir::CycleField::kStep, true);
    case 'L':
      if (context.subprogram || context.local_call || context.returns) return true;
      if (context.quiet) return inert();
      return field(ir::CycleField::kRepeats, false);
    case 'H':
      if (context.subprogram || context.turning_offset) return true;
      break;
    case 'E':
    case 'D':
      if (row.op == WordOp::kInert) return Meaningless(pending);
      break;
    default:
      break;
  }
  Word& word = AddWord(row.op, pending);
  word.index = row.index;
  word.phase = row.phase;
  word.spelling = SpellingOf(std::string(1, pending.letter), row.rule);
  return SetValue(word, pending, row.form != NumberForm::kInteger && row.form != NumberForm::kCode);
}

// Words of canned cycles (fanuc-8.7, 8.8). Not done: the letter means what it means everywhere (X, F, S, M).
bool Lowering::AddCycleWord(const Pending& pending, const Context& context, bool& done) {
  const CycleLetter letter =
      MeaningInCycle(*context.cycle, pending.letter,
                     {.block_numbers = context.cycle_block_numbers,
                      .axis_words = NamesAxes(),
                      .haas = profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas)});
  if (letter.kind == CycleLetter::kPlain) return true;
  done = true;
  if (letter.kind == CycleLetter::kRefused) return Meaningless(pending);
  if (letter.kind == CycleLetter::kStartAngle) return AddStartAngle(pending, context.cycle->rule);
  // Mazak posts write the steps of grooves and threads with a point (mazak-lathe-2.5).
  const bool point =
      IsLiteral(pending) && HasPoint(pending) && profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kMazak);
  // A dwell of a Haas: seconds with a point (fanuc-13).
  const bool seconds = IsLiteral(pending) && HasPoint(pending) && letter.field == ir::CycleField::kDwell &&
                       profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas);
  const bool length =
      letter.kind == CycleLetter::kLength || (letter.kind == CycleLetter::kThousandths && (point || seconds));
  Word& word = AddWord(WordOp::kCycleValue, pending);
  word.index = At8(letter.field);
  word.spelling = SpellingOf(std::string(1, pending.letter), context.cycle->rule);
  if (!SetValue(word, pending, length)) return false;
  if (letter.kind == CycleLetter::kThousandths && !length) word.flags |= Word::kIncrements;
  return true;
}

}  // namespace ncport::frontend::fanuc
