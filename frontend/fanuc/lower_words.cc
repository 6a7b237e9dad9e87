// Words with a letter: what they mean beside the codes of their block (fanuc-2.2, 8; mazak-lathe-3, 4, 5).
#include <cmath>

#include "base/result.h"
#include "frontend/fanuc/cycle_words.h"
#include "frontend/fanuc/lower.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using diag::Code;
using ir::ExprId;
using ir::FrameOp;
using ir::Word;
using ir::WordOp;
using words::NumberForm;

namespace {

constexpr std::uint8_t At8(ir::CycleField field) { return static_cast<std::uint8_t>(field); }
constexpr std::uint8_t At8(FrameOp op) { return static_cast<std::uint8_t>(op); }

bool IsAxisLetter(char letter) {
  switch (letter) {
    case 'X':
    case 'Y':
    case 'Z':
    case 'A':
    case 'B':
    case 'C':
    case 'U':
    case 'V':
    case 'W':
      return true;
    default:
      return false;
  }
}

/// Letters of which several may stand in one block.
bool MayRepeat(char letter) { return letter == 'G' || letter == 'M' || letter == '/' || letter == '<'; }

}  // namespace

Word& Lowering::AddWord(WordOp op, const Pending& pending) { return AddWord(op, pending.first, pending.last); }

const Lowering::Pending* Lowering::FindLetter(char letter) const {
  for (const Pending& pending : pending_) {
    if (pending.letter == letter) return &pending;
  }
  return nullptr;
}

bool Lowering::Whole(const Pending& pending) {
  if (!IsLiteral(pending) || !HasPoint(pending)) return true;
  return Fail(Code::kUnexpectedText, pending, "this address takes whole numbers without a point");
}

bool Lowering::Meaningless(const Pending& pending) {
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

// --- what the codes of the block are

bool Lowering::Scan(Context& context) {
  const bool mazak_lathe = system_ == words::System::kMazakT || system_ == words::System::kMazakM;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    Pending& pending = pending_[i];
    for (std::size_t k = 0; k < i; ++k) {
      const bool next_tool =
          pending.letter == 'T' && profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kMazak);
      if (context.call == nullptr && pending_[k].letter == pending.letter && !MayRepeat(pending.letter) && !next_tool) {
        return Fail(Code::kDoubleWord, pending);
      }
    }
    if (context.call != nullptr || (pending.letter != 'G' && pending.letter != 'M') || !IsLiteral(pending)) continue;
    const double number = NumberOf(pending);
    const double tenths = std::round(number * 10);
    if (number < 0 || std::fabs(number * 10 - tenths) > 1e-9 || tenths > 1e7) return Fail(Code::kUnknownCode, pending);
    if (pending.letter == 'M' && !Whole(pending)) return false;
    pending.meaning = codes_.Find(pending.letter, static_cast<std::uint32_t>(tenths));
    const CodeMeaning& meaning = pending.meaning;
    if (!meaning.Known()) {
      if (pending.letter == 'G') return Fail(Code::kUnknownCode, pending);
      continue;
    }
    if (meaning.spindle) context.spindle = true;
    if (meaning.code != nullptr) {
      switch (meaning.code->op) {
        case WordOp::kMotion: {
          const auto motion = static_cast<ir::Motion>(meaning.code->index);
          context.arc |= motion == ir::Motion::kArcCw || motion == ir::Motion::kArcCcw;
          context.thread |= motion == ir::Motion::kThread || motion == ir::Motion::kThreadIncreasing;
          break;
        }
        case WordOp::kSpeedMode:
          context.spindle = true;
          break;
        case WordOp::kReference:
          context.reference = true;
          break;
        case WordOp::kWorkOffset:
          context.offset = true;
          break;
        case WordOp::kLengthOffset:
          context.length_switch = true;
          break;
        default:
          break;
      }
    } else if (meaning.cycle != nullptr) {
      if (context.cycle != nullptr) return Fail(Code::kNotAlone, pending, "one cycle a block");
      context.cycle = meaning.cycle;
    } else if (meaning.special != nullptr) {
      switch (meaning.special->special) {
        case Special::kDwell:
          context.dwell = true;
          break;
        case Special::kData:
          context.data = true;
          break;
        case Special::kLocalShift:
        case Special::kMirrorOn:
        case Special::kMirrorOff:
          context.frame = true;
          break;
        case Special::kPreset:
          context.preset = true;
          break;
        case Special::kExtendedOffset:
          context.extended_offset = true;
          break;
        case Special::kRotationOn:
          context.rotation = true;
          break;
        case Special::kScalingOn:
          context.scaling = true;
          break;
        case Special::kDiameterSwitch:
          context.diameter_switch = true;
          break;
        case Special::kMacroCall:
        case Special::kModalMacro:
        case Special::kModalMacroEachBlock:
          context.call = &pending;
          context.call_kind = meaning.special->special;
          break;
        case Special::kSubprogram:
        case Special::kExternalSubprogram:
          if (context.subprogram_word != nullptr) return Fail(Code::kNotAlone, pending, "one call a block");
          context.subprogram = true;
          context.subprogram_word = &pending;
          if (meaning.special->special == Special::kExternalSubprogram) {
            return Fail(Code::kNotSupported, pending, "programs of an external device are not read");
          }
          break;
        case Special::kLocalSubprogram:
          context.local_call = true;
          context.subprogram_word = &pending;
          break;
        case Special::kReturn:
          context.returns = true;
          break;
        case Special::kQuiet:
          context.quiet = true;
          break;
        default:
          break;
      }
    }
  }
  context.cycle_block_numbers = FindLetter('P') != nullptr && FindLetter('Q') != nullptr;
  // G43 P1: the offset of a turning tool, in all its axes (mazak-lathe-4.3).
  const Pending* kind = FindLetter('P');
  context.turning_offset = system_ == words::System::kMazakM && context.length_switch && kind != nullptr &&
                           IsLiteral(*kind) && NumberOf(*kind) == 1;
  // R names the spindle beside speeds (mazak-lathe-5.2).
  const Pending* spindle = FindLetter('R');
  if (mazak_lathe && spindle != nullptr && (context.spindle || context.preset) && IsLiteral(*spindle) &&
      context.cycle == nullptr && !context.arc) {
    if (NumberOf(*spindle) != 1 && NumberOf(*spindle) != 2)
      return Fail(Code::kOutOfRange, *spindle, nullptr, "the spindles 1 and 2");
    context.spindle_index = NumberOf(*spindle) == 1 ? kMainSpindle : kSecondSpindle;
    context.spindle = true;
  } else {
    context.spindle = false;  // R is no spindle here
  }
  return true;
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

bool Lowering::AddCode(const Pending& pending, const Context& context) {
  const Token& token = At(pending.first);
  const CodeMeaning& meaning = pending.meaning;
  if (meaning.spindle) {
    Word& word = AddWord(WordOp::kSpindle, pending);
    word.index = meaning.spindle_index;
    if (context.spindle && meaning.spindle_index == kMainSpindle) word.index = context.spindle_index;
    word.extra = static_cast<std::uint32_t>(meaning.state);
    word.phase = meaning.state == ir::SpindleState::kStop ? ir::Phase::kAfter : ir::Phase::kBefore;
    word.digits = token.digits;
    word.spelling = SpellingOf("M" + std::to_string(static_cast<int>(token.number)), "fanuc-8.11");
    return true;
  }
  if (meaning.cycle != nullptr) {
    Word& word = AddWord(WordOp::kCycle, pending);
    word.index = static_cast<std::uint8_t>(meaning.cycle->cycle);
    word.spelling = SpellingOf(meaning.cycle->text, meaning.cycle->rule);
    word.digits = token.digits;
    return true;
  }
  const dialects::CodeRow& row = meaning.code != nullptr ? *meaning.code : words::AuxiliaryCode();
  if (row.op == WordOp::kLengthOffset && context.turning_offset) return AddTurningOffset(pending);
  ExprId value;
  if (row.op == WordOp::kAux) {
    value = Literal(token);
  } else if (row.op == WordOp::kWorkOffset) {
    // G54 P3 is G54.1 P3 (fanuc-8.1).
    if (const Pending* extension = FindLetter('P'); extension != nullptr && !context.subprogram) {
      std::uint8_t flags = 0;
      if (!Whole(*extension)) return false;
      value = ValueOf(*extension, flags);
    }
  }
  Word& word = AddWord(row.op, pending);
  word.value = value;
  word.index = row.op == WordOp::kAux ? std::uint8_t{0} : row.index;
  word.extra = row.op == WordOp::kAux ? Id<void>::kNone : row.extra;
  word.phase = row.phase;
  word.flags |= row.flags;
  word.spelling = SpellingOf(row.text, row.rule);
  if (token.digits + 1U != row.text.size()) word.digits = token.digits;
  return true;
}

bool Lowering::AddSpecial(const Pending& pending, const Context& context) {
  const words::SpecialRow& row = *pending.meaning.special;
  const Token& token = At(pending.first);
  const auto add = [&](WordOp op, std::uint8_t index) -> Word& {
    Word& word = AddWord(op, pending);
    word.index = index;
    word.spelling = SpellingOf(row.text, row.rule);
    if (token.digits + 1U != row.text.size()) word.digits = token.digits;
    return word;
  };
  switch (row.special) {
    case Special::kDwell:
      if (FindLetter('X') == nullptr && FindLetter('U') == nullptr && FindLetter('P') == nullptr) {
        return Fail(Code::kMissingValue, pending, "write the seconds as X or the milliseconds as P");
      }
      add(WordOp::kInert, 0).phase = ir::Phase::kMotion;
      return true;
    case Special::kLocalShift:
      add(WordOp::kFrame, At8(FrameOp::kLocalShift));
      return true;
    case Special::kRotationOn:
      add(WordOp::kFrame, At8(FrameOp::kRotateAbout));
      return true;
    case Special::kRotationOff:
      add(WordOp::kFrame, At8(FrameOp::kRotateEnd));
      return true;
    case Special::kScalingOn:
      add(WordOp::kFrame, At8(FrameOp::kScaleAbout));
      return true;
    case Special::kScalingOff:
      add(WordOp::kFrame, At8(FrameOp::kScaleEnd));
      return true;
    case Special::kMirrorOn:
      add(WordOp::kFrame, At8(FrameOp::kMirrorAbout));
      return true;
    case Special::kMirrorOff:
      add(WordOp::kFrame, At8(FrameOp::kMirrorEnd));
      return true;
    case Special::kPolarOn:
      add(WordOp::kPolarMode, 1);
      return true;
    case Special::kPolarOff:
      add(WordOp::kPolarMode, 0);
      return true;
    case Special::kPreset: {
      bool axes = false;
      for (const Pending& other : pending_) axes |= IsAxisLetter(other.letter);
      if (axes) {
        add(WordOp::kPresetPosition, 0);
      } else if (FindLetter('S') == nullptr) {
        return Fail(Code::kMissingValue, pending);
      }
      return true;
    }
    case Special::kExtendedOffset: {
      const Pending* number = FindLetter('P');
      std::uint8_t flags = 0;
      if (number != nullptr && !Whole(*number)) return false;
      const ExprId value = number != nullptr ? ValueOf(*number, flags) : Implied(1);  // missing: P1 (mazak-lathe-3.4)
      Word& word = add(WordOp::kWorkOffset, 0);
      word.extra = 54;
      word.value = value;
      return true;
    }
    case Special::kDiameterSwitch: {
      const Pending* axis = FindLetter('X');
      if (axis == nullptr || !IsLiteral(*axis) || (NumberOf(*axis) != 0 && NumberOf(*axis) != 1)) {
        return Fail(Code::kExpectedText, pending, nullptr, "X0 or X1");
      }
      add(WordOp::kDiameter,
          static_cast<std::uint8_t>(NumberOf(*axis) == 1 ? ir::Diameter::kDiameter : ir::Diameter::kRadius));
      return true;
    }
    case Special::kRadiusOn:
      add(WordOp::kDiameter, static_cast<std::uint8_t>(ir::Diameter::kRadius));
      return true;
    case Special::kRadiusOff:
      add(WordOp::kDiameter, static_cast<std::uint8_t>(ir::Diameter::kDiameter));
      return true;
    case Special::kModalMacroEnd:
      add(WordOp::kModalCall, 0).extra = Id<void>::kNone;
      return true;
    case Special::kCycleEnd:
      add(WordOp::kCycle, static_cast<std::uint8_t>(ir::Cycle::kNone));
      return true;
    case Special::kSubprogram:
    case Special::kLocalSubprogram:
      return true;  // the call is the last word of the block
    case Special::kReturn:
      return Return(context, pending);
    case Special::kMazatrolOff:
    case Special::kDataEnd:
    case Special::kQuiet:
      add(WordOp::kInert, 0);
      return true;
    case Special::kData:
    case Special::kMacroCall:
    case Special::kModalMacro:
    case Special::kModalMacroEachBlock:
      NCPORT_BUG("{} is no word of its own", row.text);
    case Special::kPresetReset:
    case Special::kCylinder:
    case Special::kPolarMillingOn:
    case Special::kPolarMillingOff:
    case Special::kExternalSubprogram:
    case Special::kMazatrolOn:
    case Special::kRefused:
      return Fail(Code::kNotSupported, pending, nullptr);
  }
  return true;
}

// --- letters

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

// `G43 P1 Z50. H#3020`: #3020 is the place of the active tool in the tool data, so the offset is that tool's own; a
// number names an offset (mazak-lathe-4.3). That H may be left out hangs on a parameter (F93.3): not read.
bool Lowering::AddTurningOffset(const Pending& pending) {
  const Pending* number = FindLetter('H');
  if (number == nullptr) return Fail(Code::kMissingValue, pending, "write H#3020, or H and the number of the offset");
  std::uint8_t flags = 0;
  ExprId value = ValueOf(*number, flags);
  const ir::Expr& given = module_.exprs[value];
  if (given.op == ir::ExprOp::kSystem && module_.systems[ir::SystemId{given.a}].number == words::kToolDataIndex) {
    const words::SystemRange* active = words::FindSystemVariable(profile_, words::kActiveTool);
    NCPORT_CHECK(active != nullptr, "no row for the active tool");
    value = List(ir::ExprOp::kSystem, SystemOf(words::kActiveTool, *active).value, {}, active->type, 0);
  } else if (IsLiteral(*number) && !Whole(*number)) {
    return false;
  }
  Word& word = AddWord(WordOp::kToolOffset, pending);
  word.value = value;
  word.flags |= flags;
  word.phase = ir::DefaultPhaseOf(WordOp::kToolOffset);
  word.spelling = SpellingOf("G43", "mazak-lathe-4.3");
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
      return field(ir::CycleField::kDwell, false, true);
    case 'Q':
      if (context.subprogram) return true;
      if (context.thread) {
        Word& word = AddWord(WordOp::kStartAngle, pending);
        word.spelling = SpellingOf("Q", "fanuc-8.1");
        return SetValue(word, pending, true);
      }
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
  bool axes = false;
  for (const Pending& other : pending_) axes |= IsAxisLetter(other.letter);
  const CycleLetter letter =
      MeaningInCycle(*context.cycle, pending.letter,
                     {.block_numbers = context.cycle_block_numbers,
                      .axis_words = axes,
                      .haas = profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas)});
  if (letter.kind == CycleLetter::kPlain) return true;
  done = true;
  if (letter.kind == CycleLetter::kRefused) return Meaningless(pending);
  if (letter.kind == CycleLetter::kStartAngle) {
    Word& word = AddWord(WordOp::kStartAngle, pending);
    word.spelling = SpellingOf(std::string(1, pending.letter), context.cycle->rule);
    return SetValue(word, pending, true);
  }
  // Mazak posts write the steps of grooves and threads with a point (mazak-lathe-2.5).
  const bool point =
      IsLiteral(pending) && HasPoint(pending) && profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kMazak);
  const bool length = letter.kind == CycleLetter::kLength || (letter.kind == CycleLetter::kThousandths && point);
  Word& word = AddWord(WordOp::kCycleValue, pending);
  word.index = At8(letter.field);
  word.spelling = SpellingOf(std::string(1, pending.letter), context.cycle->rule);
  if (!SetValue(word, pending, length)) return false;
  if (letter.kind == CycleLetter::kThousandths && !length) word.flags |= Word::kIncrements;
  return true;
}

}  // namespace ncport::frontend::fanuc
