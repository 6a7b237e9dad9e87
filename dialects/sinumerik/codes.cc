// The code words of card section 8.1 (G groups) and 8.10 (M). Words that change nothing a trace shows are inert; groups
// and words that are not here are refused by name (ReservedWords, kRefusedCodes of the reader).
#include <array>

#include "dialects/sinumerik/words.h"
#include "ir/modes.h"

namespace ncport::dialects::sinumerik {

namespace {

using ir::Phase;
using Op = ir::WordOp;

constexpr std::uint32_t kNone = Id<void>::kNone;

template <class Mode>
constexpr CodeRow Modal(std::string_view text, Op op, Mode mode, std::uint8_t group, std::string_view rule,
                        bool alias = false, std::uint8_t flags = 0) {
  return {text, op, static_cast<std::uint8_t>(mode), kNone, Phase::kSetting, group, rule, alias, flags};
}
template <class Kind>
constexpr CodeRow Action(std::string_view text, Op op, Kind kind, Phase phase, std::uint8_t group,
                         std::string_view rule, bool alias = false) {
  return {text, op, static_cast<std::uint8_t>(kind), kNone, phase, group, rule, alias, 0};
}
constexpr CodeRow Inert(std::string_view text, std::uint8_t group) {
  return {text, Op::kInert, 0, kNone, Phase::kSetting, group, "sinumerik-8.1", false, 0};
}
constexpr CodeRow Offset(std::string_view text, std::uint32_t number) {
  return {text, Op::kWorkOffset, 0, number, Phase::kSetting, 8, "sinumerik-8.2", false, 0};
}
constexpr CodeRow M(std::string_view text, Op op, std::uint32_t extra, Phase phase, bool alias = false) {
  return {text, op, 0, extra, phase, 0, "sinumerik-8.10", alias, 0};
}

constexpr CodeRow kFixedRows[] = {
    // group 1
    Modal("G0", Op::kMotion, ir::Motion::kRapid, 1, "sinumerik-8.2"),
    Modal("G1", Op::kMotion, ir::Motion::kLinear, 1, "sinumerik-8.2"),
    Modal("G2", Op::kMotion, ir::Motion::kArcCw, 1, "sinumerik-8.3"),
    Modal("G3", Op::kMotion, ir::Motion::kArcCcw, 1, "sinumerik-8.3"),
    Modal("CIP", Op::kMotion, ir::Motion::kArcVia, 1, "sinumerik-8.3"),
    Modal("CT", Op::kMotion, ir::Motion::kArcTangent, 1, "sinumerik-8.3"),
    Modal("G33", Op::kMotion, ir::Motion::kThread, 1, "sinumerik-8.4"),
    Modal("G34", Op::kMotion, ir::Motion::kThreadIncreasing, 1, "sinumerik-8.4"),
    Modal("G35", Op::kMotion, ir::Motion::kThreadDecreasing, 1, "sinumerik-8.4"),
    Modal("G331", Op::kMotion, ir::Motion::kTapIn, 1, "sinumerik-8.4"),
    Modal("G332", Op::kMotion, ir::Motion::kTapOut, 1, "sinumerik-8.4"),
    // group 2: one block. G4 has no word of its own in the IR: F and S of its block become the dwell.
    {"G4", Op::kInert, 0, kNone, Phase::kMotion, 2, "sinumerik-8.2", false, 0},
    Modal("G63", Op::kMotion, ir::Motion::kTapFloating, 2, "sinumerik-8.4"),
    Action("G74", Op::kReference, ir::ReferenceKind::kReference, Phase::kMotion, 2, "sinumerik-8.2"),
    Action("G75", Op::kReference, ir::ReferenceKind::kFixedPoint, Phase::kMotion, 2, "sinumerik-8.2"),
    // group 3: frames and poles
    Action("TRANS", Op::kFrame, ir::FrameOp::kTranslate, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("ROT", Op::kFrame, ir::FrameOp::kRotate, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("SCALE", Op::kFrame, ir::FrameOp::kScale, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("MIRROR", Op::kFrame, ir::FrameOp::kMirror, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("ATRANS", Op::kFrame, ir::FrameOp::kAddTranslate, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("AROT", Op::kFrame, ir::FrameOp::kAddRotate, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("ASCALE", Op::kFrame, ir::FrameOp::kAddScale, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("AMIRROR", Op::kFrame, ir::FrameOp::kAddMirror, Phase::kSetting, 3, "sinumerik-8.7"),
    Action("G110", Op::kPole, ir::PoleBase::kLastPosition, Phase::kMotion, 3, "sinumerik-8.6"),
    Action("G111", Op::kPole, ir::PoleBase::kWorkpieceZero, Phase::kMotion, 3, "sinumerik-8.6"),
    Action("G112", Op::kPole, ir::PoleBase::kLastPole, Phase::kMotion, 3, "sinumerik-8.6"),
    // group 4
    Inert("STARTFIFO", 4),
    Inert("STOPFIFO", 4),
    Inert("FIFOCTRL", 4),
    // groups 6 to 11
    Modal("G17", Op::kPlane, ir::Plane::kXY, 6, "sinumerik-8.1"),
    Modal("G18", Op::kPlane, ir::Plane::kZX, 6, "sinumerik-8.1"),
    Modal("G19", Op::kPlane, ir::Plane::kYZ, 6, "sinumerik-8.1"),
    Modal("G40", Op::kCutterComp, ir::CutterComp::kOff, 7, "sinumerik-8.8"),
    Modal("G41", Op::kCutterComp, ir::CutterComp::kLeft, 7, "sinumerik-8.8"),
    Modal("G42", Op::kCutterComp, ir::CutterComp::kRight, 7, "sinumerik-8.8"),
    Offset("G500", 0),
    Offset("G54", 54),
    Offset("G55", 55),
    Offset("G56", 56),
    Offset("G57", 57),
    // They differ in the basic frames and handwheel offsets, which no program of the source sets.
    Action("SUPA", Op::kMachineCoords, 0, Phase::kSetting, 9, "sinumerik-8.2"),
    Action("G53", Op::kMachineCoords, 0, Phase::kSetting, 9, "sinumerik-8.2", true),
    Action("G153", Op::kMachineCoords, 0, Phase::kSetting, 9, "sinumerik-8.2", true),
    Modal("G60", Op::kPathMode, ir::PathMode::kExact, 10, "sinumerik-8.2"),
    Modal("G64", Op::kPathMode, ir::PathMode::kContinuous, 10, "sinumerik-8.2"),
    Modal("G641", Op::kPathMode, ir::PathMode::kContinuous, 10, "sinumerik-8.2", true),
    Modal("G642", Op::kPathMode, ir::PathMode::kContinuous, 10, "sinumerik-8.2", true),
    Modal("G643", Op::kPathMode, ir::PathMode::kContinuous, 10, "sinumerik-8.2", true),
    Modal("G644", Op::kPathMode, ir::PathMode::kContinuous, 10, "sinumerik-8.2", true),
    Modal("G645", Op::kPathMode, ir::PathMode::kContinuous, 10, "sinumerik-8.2", true),
    Action("G9", Op::kExactOnce, 0, Phase::kSetting, 11, "sinumerik-8.2"),
    Inert("G601", 12),
    Inert("G602", 12),
    Inert("G603", 12),
    // groups 13 to 15
    Modal("G70", Op::kUnits, ir::Units::kInchGeometry, 13, "sinumerik-8.2"),
    Modal("G71", Op::kUnits, ir::Units::kMmGeometry, 13, "sinumerik-8.2"),
    Modal("G700", Op::kUnits, ir::Units::kInch, 13, "sinumerik-8.2"),
    Modal("G710", Op::kUnits, ir::Units::kMm, 13, "sinumerik-8.2"),
    Modal("G90", Op::kDistance, ir::Distance::kAbsolute, 14, "sinumerik-8.2"),
    Modal("G91", Op::kDistance, ir::Distance::kIncremental, 14, "sinumerik-8.2"),
    Modal("G93", Op::kFeedMode, ir::FeedMode::kInverseTime, 15, "sinumerik-8.8"),
    Modal("G94", Op::kFeedMode, ir::FeedMode::kPerMinute, 15, "sinumerik-8.8"),
    Modal("G95", Op::kFeedMode, ir::FeedMode::kPerRevolution, 15, "sinumerik-8.8"),
    Modal("G96", Op::kSpeedMode, ir::SpeedMode::kConstantSurface, 15, "sinumerik-8.8"),
    Modal("G97", Op::kSpeedMode, ir::SpeedMode::kRpm, 15, "sinumerik-8.8", false, ir::Word::kFreezes),
    // groups 16 to 28: feed at contours, approach, dynamics, orientation
    Inert("CFC", 16),
    Inert("CFTCP", 16),
    Inert("CFIN", 16),
    Inert("NORM", 17),
    Inert("KONT", 17),
    Inert("KONTT", 17),
    Inert("KONTC", 17),
    Inert("G450", 18),
    Inert("G451", 18),
    Inert("BRISK", 21),
    Inert("SOFT", 21),
    Inert("DRIVE", 21),
    Inert("CUT2D", 22),
    Inert("CUT2DF", 22),
    Inert("CDOF", 23),
    Inert("CDON", 23),
    Inert("CDOF2", 23),
    Inert("FFWOF", 24),
    Inert("FFWON", 24),
    Inert("ORIWKS", 25),
    Inert("ORIMKS", 25),
    Inert("RMB", 26),
    Inert("RMI", 26),
    Inert("RME", 26),
    Inert("RMN", 26),
    Inert("ORIC", 27),
    Inert("ORID", 27),
    Inert("WALIMON", 28),
    Inert("WALIMOF", 28),
    // group 29
    Modal("DIAMOF", Op::kDiameter, ir::Diameter::kRadius, 29, "sinumerik-8.5"),
    Modal("DIAMON", Op::kDiameter, ir::Diameter::kDiameter, 29, "sinumerik-8.5"),
    Modal("DIAM90", Op::kDiameter, ir::Diameter::kDiameterAbsolute, 29, "sinumerik-8.5"),
    Modal("DIAMCYCOF", Op::kDiameter, ir::Diameter::kRadius, 29, "sinumerik-8.5", true),
    // groups 30 to 62
    Inert("COMPOF", 30),
    Inert("COMPON", 30),
    Inert("COMPCURV", 30),
    Inert("COMPCAD", 30),
    Inert("COMPSURF", 30),
    Inert("FTOCOF", 33),
    Inert("OSOF", 34),
    Inert("OSC", 34),
    Inert("OSS", 34),
    Inert("OSSE", 34),
    Inert("OSD", 34),
    Inert("OST", 34),
    Inert("SPOF", 35),
    Inert("PDELAYON", 36),
    Inert("PDELAYOF", 36),
    Inert("FNORM", 37),
    Inert("CPRECOF", 39),
    Inert("CPRECON", 39),
    Inert("CUTCONOF", 40),
    Inert("LFOF", 41),
    Inert("LFON", 41),
    Inert("TCOABS", 42),
    Inert("G140", 43),
    Inert("G141", 43),
    Inert("G142", 43),
    Inert("G143", 43),
    Inert("G340", 44),
    Inert("G341", 44),
    Inert("SPATH", 45),
    Inert("UPATH", 45),
    Inert("LFTXT", 46),
    Inert("LFWP", 46),
    Inert("LFPOS", 46),
    Inert("G290", 47),
    Inert("G460", 48),
    Inert("G461", 48),
    Inert("G462", 48),
    Inert("CP", 49),
    Inert("ORIEULER", 50),
    Inert("ORIRPY", 50),
    Inert("ORIVIRT1", 50),
    Inert("ORIVIRT2", 50),
    Inert("ORIAXPOS", 50),
    Inert("ORIRPY2", 50),
    Inert("ORIVECT", 51),
    Inert("ORIAXES", 51),
    Inert("ORIPATH", 51),
    Inert("ORIPLANE", 51),
    Inert("PAROTOF", 52),
    Inert("TOROTOF", 53),
    Inert("ORIROTA", 54),
    Inert("ORIROTR", 54),
    Inert("ORIROTT", 54),
    Inert("ORIROTC", 54),
    Inert("RTLION", 55),
    Inert("RTLIOF", 55),
    Inert("TOWSTD", 56),
    Inert("TOWMCS", 56),
    Inert("TOWWCS", 56),
    Inert("TOWBCS", 56),
    Inert("TOWTCS", 56),
    Inert("TOWKCS", 56),
    Inert("FENDNORM", 57),
    Inert("G62", 57),
    Inert("G621", 57),
    Inert("DYNNORM", 59),
    Inert("DYNPOS", 59),
    Inert("DYNROUGH", 59),
    Inert("DYNSEMIFIN", 59),
    Inert("DYNFINISH", 59),
    Inert("DYNPREC", 59),
    Inert("WALCS0", 60),
    Inert("ORISOF", 61),
    Inert("ORISON", 61),
    Inert("RMBBL", 62),
    Inert("RMIBL", 62),
    Inert("RMEBL", 62),
    Inert("RMNBL", 62),
    // Words without a group. Transformations, position control and handwheel offsets are refused where they are
    // switched on, so switching them off changes nothing.
    Inert("TRAFOOF", 0),
    Inert("SPCOF", 0),
    Inert("SPCON", 0),
    Inert("DRFOF", 0),
    Inert("NEWCONF", 0),
    // M functions. Time of output: the default of the card.
    M("M0", Op::kStop, kNone, Phase::kAfter),
    M("M1", Op::kOptionalStop, kNone, Phase::kAfter),
    M("M2", Op::kProgramEnd, 2, Phase::kLast),
    M("M30", Op::kProgramEnd, 30, Phase::kLast),
    {"M17", Op::kReturn, static_cast<std::uint8_t>(ir::ReturnKind::kAuxiliary), kNone, Phase::kLast, 0, "sinumerik-7.5",
     false, 0},
    M("M3", Op::kSpindle, static_cast<std::uint32_t>(ir::SpindleState::kCw), Phase::kBefore),
    M("M4", Op::kSpindle, static_cast<std::uint32_t>(ir::SpindleState::kCcw), Phase::kBefore),
    M("M5", Op::kSpindle, static_cast<std::uint32_t>(ir::SpindleState::kStop), Phase::kAfter),
    M("M6", Op::kToolChange, kNone, Phase::kBefore),
    M("M9", Op::kAux, 9, Phase::kAfter),
};

// G505 to G599.
constexpr std::size_t kFurtherOffsets = 95;
constexpr auto kOffsetNames = [] {
  std::array<std::array<char, 4>, kFurtherOffsets> names{};
  for (std::size_t i = 0; i < kFurtherOffsets; ++i) {
    const std::size_t number = 505 + i;
    names[i] = {'G', '5', static_cast<char>('0' + number / 10 % 10), static_cast<char>('0' + number % 10)};
  }
  return names;
}();
constexpr auto kRows = [] {
  std::array<CodeRow, std::size(kFixedRows) + kFurtherOffsets> rows{};
  std::size_t count = 0;
  for (const CodeRow& row : kFixedRows) rows[count++] = row;
  for (std::size_t i = 0; i < kFurtherOffsets; ++i) {
    rows[count++] = Offset(std::string_view(kOffsetNames[i].data(), 4), static_cast<std::uint32_t>(505 + i));
  }
  return rows;
}();
constexpr CodeRow kAuxiliary{"M", Op::kAux, 0, kNone, Phase::kBefore, 0, "sinumerik-8.10", false, 0};

}  // namespace

const CodeTable& Codes() {
  static const CodeTable table{kRows};
  return table;
}

const CodeRow& AuxiliaryCode() { return kAuxiliary; }

}  // namespace ncport::dialects::sinumerik
