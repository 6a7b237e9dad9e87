#include "dialects/iso/words.h"

#include "ir/modes.h"

namespace ncport::dialects::iso {
namespace {

using ir::Phase;
using Op = ir::WordOp;

constexpr std::uint32_t kNone = Id<void>::kNone;

template <class Mode>
constexpr CodeRow Modal(std::string_view text, Op op, Mode mode, std::uint8_t group, std::string_view rule,
                        std::uint8_t flags = 0) {
  return {text, op, static_cast<std::uint8_t>(mode), kNone, Phase::kSetting, group, rule, false, flags};
}
constexpr CodeRow Offset(std::string_view text, std::uint32_t number) {
  return {text, Op::kWorkOffset, 0, number, Phase::kSetting, 12, "iso-7", false, 0};
}
constexpr CodeRow Length(std::string_view text, std::uint8_t index) {
  return {text, Op::kLengthOffset, index, kNone, Phase::kBefore, 8, "iso-7", false, 0};
}
constexpr CodeRow M(std::string_view text, Op op, std::uint32_t extra, Phase phase, std::string_view rule) {
  return {text, op, 0, extra, phase, 0, rule, false, 0};
}

constexpr CodeRow kRows[] = {
    Modal("G0", Op::kMotion, ir::Motion::kRapid, 1, "iso-6"),
    Modal("G1", Op::kMotion, ir::Motion::kLinear, 1, "iso-6"),
    Modal("G2", Op::kMotion, ir::Motion::kArcCw, 1, "iso-6"),
    Modal("G3", Op::kMotion, ir::Motion::kArcCcw, 1, "iso-6"),
    Modal("G33", Op::kMotion, ir::Motion::kThread, 1, "iso-6"),
    Modal("G17", Op::kPlane, ir::Plane::kXY, 2, "iso-7"),
    Modal("G18", Op::kPlane, ir::Plane::kZX, 2, "iso-7"),
    Modal("G19", Op::kPlane, ir::Plane::kYZ, 2, "iso-7"),
    Modal("G90", Op::kDistance, ir::Distance::kAbsolute, 3, "iso-4"),
    Modal("G93", Op::kFeedMode, ir::FeedMode::kInverseTime, 5, "iso-7"),
    Modal("G94", Op::kFeedMode, ir::FeedMode::kPerMinute, 5, "iso-7"),
    Modal("G95", Op::kFeedMode, ir::FeedMode::kPerRevolution, 5, "iso-8"),
    Modal("G20", Op::kUnits, ir::Units::kInch, 6, "iso-4"),
    Modal("G21", Op::kUnits, ir::Units::kMm, 6, "iso-4"),
    Modal("G40", Op::kCutterComp, ir::CutterComp::kOff, 7, "iso-7"),
    Modal("G41", Op::kCutterComp, ir::CutterComp::kLeft, 7, "iso-7"),
    Modal("G42", Op::kCutterComp, ir::CutterComp::kRight, 7, "iso-7"),
    Length("G43", 1),
    Length("G49", 0),
    Offset("G54", 54),
    Offset("G55", 55),
    Offset("G56", 56),
    Offset("G57", 57),
    Offset("G58", 58),
    Offset("G59", 59),
    Modal("G96", Op::kSpeedMode, ir::SpeedMode::kConstantSurface, 13, "iso-8"),
    Modal("G97", Op::kSpeedMode, ir::SpeedMode::kRpm, 13, "iso-8", ir::Word::kFreezes),
    M("M0", Op::kStop, kNone, Phase::kAfter, "iso-9"),
    M("M1", Op::kOptionalStop, kNone, Phase::kAfter, "iso-9"),
    M("M2", Op::kProgramEnd, 2, Phase::kLast, "iso-9"),
    M("M30", Op::kProgramEnd, 30, Phase::kLast, "iso-9"),
    M("M3", Op::kSpindle, static_cast<std::uint32_t>(ir::SpindleState::kCw), Phase::kBefore, "iso-7"),
    M("M4", Op::kSpindle, static_cast<std::uint32_t>(ir::SpindleState::kCcw), Phase::kBefore, "iso-7"),
    M("M5", Op::kSpindle, static_cast<std::uint32_t>(ir::SpindleState::kStop), Phase::kAfter, "iso-7"),
    M("M6", Op::kToolChange, kNone, Phase::kBefore, "iso-7"),
};
constexpr CodeRow kAuxiliary{"M", Op::kAux, 0, kNone, Phase::kBefore, 0, "iso-7", false, 0};

}  // namespace

const CodeTable& Codes() {
  static const CodeTable table{kRows};
  return table;
}

const CodeRow& AuxiliaryCode() { return kAuxiliary; }

}  // namespace ncport::dialects::iso
