// G and M codes: what those of a block say about its other words, and the words that they become (fanuc-8).
#include <cmath>
#include <string>

#include "base/result.h"
#include "frontend/fanuc/lower.h"
#include "ir/motions.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using diag::Code;
using ir::ExprId;
using ir::FrameOp;
using ir::Word;
using ir::WordOp;

namespace {

constexpr std::uint8_t At8(FrameOp op) { return static_cast<std::uint8_t>(op); }

/// Letters of which several may stand in one block.
bool MayRepeat(char letter) { return letter == 'G' || letter == 'M' || letter == '/' || letter == '<'; }

}  // namespace

/// The same address again; on Mazak a second T is the next tool.
bool Lowering::IsRepeated(const Pending& before, const Pending& pending) const {
  return before.letter == pending.letter && !MayRepeat(pending.letter) &&
         !(pending.letter == 'T' && profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kMazak));
}

/// Of an address that stands twice the last one counts; Haas raises an alarm, and the words of a macro call are
/// arguments (fanuc-1, "Repeated address").
void Lowering::DropRepeated() {
  if (macro_block_ || skips_ || profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas)) return;
  for (std::size_t i = 1; i < pending_.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!IsRepeated(pending_[k], pending_[i])) continue;
      (void)Fail(Code::kDoubleWord, pending_[i], "the last one counts: take the other one out");
      repeated_ = true;
      pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(k));
      --i;
      break;
    }
  }
}

bool Lowering::Scan(Context& context) {
  const bool mazak_lathe = system_ == words::System::kMazakT || system_ == words::System::kMazakM;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    Pending& pending = pending_[i];
    for (std::size_t k = 0; k < i && context.call == nullptr; ++k) {
      if (IsRepeated(pending_[k], pending)) return Fail(Code::kDoubleWord, pending);
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
          context.arc |= ir::IsPlaneArc(motion);
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
          context.data = &pending;
          break;
        case Special::kStrokeCheck:
          if (NamesAxes() || FindLetter('I') != nullptr || FindLetter('J') != nullptr || FindLetter('K') != nullptr)
            context.data = &pending;
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
        case Special::kQuietAlone:
          // Smoothing and the like take axis words as data; none of these codes shares its block with a move
          // (fanuc-8.1).
          if (NamesAxes()) return Fail(Code::kNotAlone, pending, "give the move a block of its own");
          [[fallthrough]];
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
      if (NamesAxes()) {
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
      // G110 to G129 of a Haas are the offsets 1 to 20.
      constexpr double kFirstOwn = 110, kLastOwn = 129;
      const bool own = token.number >= kFirstOwn && token.number <= kLastOwn;
      if (own && number != nullptr) return Meaningless(*number);
      const ExprId value = own                 ? Implied(token.number - kFirstOwn + 1)
                           : number != nullptr ? ValueOf(*number, flags)
                                               : Implied(1);  // missing: P1 (mazak-lathe-3.4)
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
    case Special::kRigidTaps: {
      constexpr std::uint32_t kNumber = 29;
      add(WordOp::kCycle, static_cast<std::uint8_t>(ir::Cycle::kRigidTap)).extra = kNumber;
      return true;
    }
    case Special::kMazatrolOff:
    case Special::kDataEnd:
    case Special::kQuiet:
    case Special::kQuietAlone:
    case Special::kStrokeCheck:
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
    case Special::kRefusedByHaas:
      return Fail(Code::kNotSupported, pending, nullptr);
  }
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

}  // namespace ncport::frontend::fanuc
