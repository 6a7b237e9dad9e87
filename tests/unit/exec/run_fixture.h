// Programs for tests of runs, built word by word. Words() reads a notation of its own, one token a word, so that a test
// shows the block it is about; expressions are made by ir::ExprBuilder.
#pragma once

#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "exec/link.h"
#include "exec/trace_text.h"
#include "ir/builder.h"
#include "ir/structure.h"

namespace ncport::exec {

/// A milling machine whose alarms are the names of their classes.
inline ir::Machine TestMachine() {
  ir::Machine machine;
  machine.start = {ir::Motion::kLinear,
                   ir::Plane::kXY,
                   ir::Distance::kAbsolute,
                   ir::Units::kMm,
                   ir::FeedMode::kPerMinute,
                   ir::SpeedMode::kRpm,
                   ir::CutterComp::kOff,
                   ir::Diameter::kRadius,
                   ir::PathMode::kExact,
                   ir::ReturnLevel::kInitial,
                   {true, 0, 0}};
  machine.compare_tolerance = 1e-12;
  constexpr const char* kCodes[ir::kAlarmClasses] = {
      "user", "arithmetic", "conversion", "index",    "target", "program", "nesting",    "range", "circle",
      "feed", "position",   "code",       "geometry", "syntax", "end",     "transverse", "other"};
  for (std::size_t i = 0; i < ir::kAlarmClasses; ++i) machine.alarms[i] = {kCodes[i], kCodes[i]};
  return machine;
}

inline ir::Machine TestLathe() {
  ir::Machine machine = TestMachine();
  machine.lathe = true;
  machine.transverse_axis = 0;
  machine.start.plane = ir::Plane::kZX;
  machine.start.diameter = ir::Diameter::kDiameter;
  return machine;
}

/// One module, run into text.
struct RunFixture {
  ir::Module module;
  ir::ExprBuilder e{module};
  ir::Machine machine = TestMachine();
  RunOptions options;
  diag::Sink sink;
  RunResult result;
  Coverage coverage;
  Environment* environment = nullptr;
  ir::SpaceId r = ir::AddSpace(module, "R", 0, 99);

  RunFixture() { options.entry = ir::ProgramId{std::size_t{0}}; }

  ir::ExprId R(std::uint32_t cell) { return e.Cell(r, cell); }
  ir::ExprId N(std::string_view number, ir::Type type = ir::Type::kReal) { return e.Number(number, type); }
  ir::ExprId I(std::string_view number) { return e.Number(number, ir::Type::kInt); }
  ir::ExprId Add(ir::ExprId a, ir::ExprId b) { return e.Binary(ir::ExprOp::kAdd, a, b); }

  /// Adds the words of `text` to the block: G0 G1 .. as the meanings below, X10 X=IC(5) CR=5 and the like with literal
  /// values.
  ir::BlockBuilder& Words(ir::BlockBuilder& block, std::string_view text) {
    while (!text.empty()) {
      const std::size_t blank = text.find(' ');
      const std::string_view token = text.substr(0, blank);
      text = blank == std::string_view::npos ? std::string_view{} : text.substr(blank + 1);
      if (!token.empty()) Word(block, token);
    }
    return block;
  }
  ir::BlockId Line(ir::ProgramBuilder& program, std::string_view text) {
    ir::BlockBuilder block = program.Block();
    return Words(block, text).Finish();
  }

  std::string Run() {
    std::string text;
    OutputSink output(text);
    TraceWriter writer(output, module);
    NoEnvironment none;
    for (const ir::ProgramId id : module.programs.Ids()) ir::BuildStructure(module, id, 0, sink);
    result = exec::Run(module, machine, options, environment != nullptr ? *environment : none, writer, sink, &coverage);
    (void)writer.Finish();
    return text;
  }
  /// The run of one main program of these blocks, without the END line.
  std::string Trace(std::initializer_list<std::string_view> blocks) {
    ir::ProgramBuilder program(module, "MAIN");
    for (const std::string_view block : blocks) Line(program, block);
    Line(program, "M30");
    program.Finish();
    std::string text = Run();
    if (text.ends_with("END\n")) text.resize(text.size() - 4);
    return text;
  }
  [[nodiscard]] std::string Finding() const { return sink.Empty() ? "" : sink.All().front().message; }

 private:
  using Op = ir::WordOp;
  template <class Enum>
  static constexpr std::uint8_t Index(Enum value) {
    return static_cast<std::uint8_t>(value);
  }

  static ir::ValueMode Mode(std::string_view& value) {
    static const std::map<std::string_view, ir::ValueMode> kModes = {{"AC(", ir::ValueMode::kAbsolute},
                                                                     {"IC(", ir::ValueMode::kIncremental},
                                                                     {"DC(", ir::ValueMode::kShortest},
                                                                     {"ACP(", ir::ValueMode::kPositive},
                                                                     {"ACN(", ir::ValueMode::kNegative},
                                                                     {"DAC(", ir::ValueMode::kAbsoluteDiameter},
                                                                     {"DIC(", ir::ValueMode::kIncrementalDiameter},
                                                                     {"RAC(", ir::ValueMode::kAbsoluteRadius},
                                                                     {"RIC(", ir::ValueMode::kIncrementalRadius}};
    const std::size_t bracket = value.find('(');
    if (bracket == std::string_view::npos) return ir::ValueMode::kModal;
    const ir::ValueMode mode = kModes.at(value.substr(0, bracket + 1));
    value = value.substr(bracket + 1, value.size() - bracket - 2);
    return mode;
  }

  void Word(ir::BlockBuilder& block, std::string_view token) {
    struct Row {
      Op op;
      std::uint8_t index = 0;
      std::uint32_t extra = Id<void>::kNone;
      ir::Phase phase = ir::Phase::kImmediate;  // kImmediate: the usual one
    };
    using enum ir::FrameOp;
    static const std::map<std::string_view, Row> kCodes = {
        {"G0", {Op::kMotion, Index(ir::Motion::kRapid)}},
        {"G1", {Op::kMotion, Index(ir::Motion::kLinear)}},
        {"G2", {Op::kMotion, Index(ir::Motion::kArcCw)}},
        {"G3", {Op::kMotion, Index(ir::Motion::kArcCcw)}},
        {"CIP", {Op::kMotion, Index(ir::Motion::kArcVia)}},
        {"CT", {Op::kMotion, Index(ir::Motion::kArcTangent)}},
        {"G33", {Op::kMotion, Index(ir::Motion::kThread)}},
        {"G34", {Op::kMotion, Index(ir::Motion::kThreadIncreasing)}},
        {"G35", {Op::kMotion, Index(ir::Motion::kThreadDecreasing)}},
        {"G331", {Op::kMotion, Index(ir::Motion::kTapIn)}},
        {"G63", {Op::kMotion, Index(ir::Motion::kTapFloating)}},
        {"MEAS", {Op::kMotion, Index(ir::Motion::kProbe)}},
        {"G17", {Op::kPlane, Index(ir::Plane::kXY)}},
        {"G18", {Op::kPlane, Index(ir::Plane::kZX)}},
        {"G19", {Op::kPlane, Index(ir::Plane::kYZ)}},
        {"G90", {Op::kDistance, Index(ir::Distance::kAbsolute)}},
        {"G91", {Op::kDistance, Index(ir::Distance::kIncremental)}},
        {"G70", {Op::kUnits, Index(ir::Units::kInchGeometry)}},
        {"G71", {Op::kUnits, Index(ir::Units::kMmGeometry)}},
        {"G700", {Op::kUnits, Index(ir::Units::kInch)}},
        {"G710", {Op::kUnits, Index(ir::Units::kMm)}},
        {"G93", {Op::kFeedMode, Index(ir::FeedMode::kInverseTime)}},
        {"G94", {Op::kFeedMode, Index(ir::FeedMode::kPerMinute)}},
        {"G95", {Op::kFeedMode, Index(ir::FeedMode::kPerRevolution)}},
        {"G96", {Op::kSpeedMode, Index(ir::SpeedMode::kConstantSurface)}},
        {"G40", {Op::kCutterComp, Index(ir::CutterComp::kOff)}},
        {"G41", {Op::kCutterComp, Index(ir::CutterComp::kLeft)}},
        {"G42", {Op::kCutterComp, Index(ir::CutterComp::kRight)}},
        {"DIAMON", {Op::kDiameter, Index(ir::Diameter::kDiameter)}},
        {"DIAM90", {Op::kDiameter, Index(ir::Diameter::kDiameterAbsolute)}},
        {"DIAMOF", {Op::kDiameter, Index(ir::Diameter::kRadius)}},
        {"G60", {Op::kPathMode, Index(ir::PathMode::kExact)}},
        {"G64", {Op::kPathMode, Index(ir::PathMode::kContinuous)}},
        {"G9", {Op::kExactOnce}},
        {"G500", {Op::kWorkOffset, 0, 0}},
        {"G54", {Op::kWorkOffset, 0, 54}},
        {"G55", {Op::kWorkOffset, 0, 55}},
        {"SUPA", {Op::kMachineCoords}},
        {"G74", {Op::kReference}},
        {"G92", {Op::kPresetPosition}},
        {"G110", {Op::kPole, Index(ir::PoleBase::kLastPosition)}},
        {"G111", {Op::kPole, Index(ir::PoleBase::kWorkpieceZero)}},
        {"G112", {Op::kPole, Index(ir::PoleBase::kLastPole)}},
        {"TRANS", {Op::kFrame, Index(kTranslate)}},
        {"ROT", {Op::kFrame, Index(kRotate)}},
        {"SCALE", {Op::kFrame, Index(kScale)}},
        {"MIRROR", {Op::kFrame, Index(kMirror)}},
        {"ATRANS", {Op::kFrame, Index(kAddTranslate)}},
        {"AROT", {Op::kFrame, Index(kAddRotate)}},
        {"ASCALE", {Op::kFrame, Index(kAddScale)}},
        {"AMIRROR", {Op::kFrame, Index(kAddMirror)}},
        {"G52", {Op::kFrame, Index(kLocalShift)}},
        {"G68", {Op::kFrame, Index(kRotateAbout)}},
        {"G69", {Op::kFrame, Index(kRotateEnd)}},
        {"G51", {Op::kFrame, Index(kScaleAbout)}},
        {"G50", {Op::kFrame, Index(kScaleEnd)}},
        {"G51.1", {Op::kFrame, Index(kMirrorAbout)}},
        {"G50.1", {Op::kFrame, Index(kMirrorEnd)}},
        {"M0", {Op::kStop}},
        {"M1", {Op::kOptionalStop}},
        {"M3", {Op::kSpindle, 0, static_cast<std::uint32_t>(ir::SpindleState::kCw)}},
        {"M4", {Op::kSpindle, 0, static_cast<std::uint32_t>(ir::SpindleState::kCcw)}},
        {"M5", {Op::kSpindle, 0, static_cast<std::uint32_t>(ir::SpindleState::kStop), ir::Phase::kAfter}},
        {"M6", {Op::kToolChange}},
        {"M17", {Op::kReturn}},
        {"M30", {Op::kProgramEnd, 0, 30}},
        {"RESTART", {Op::kRestart}},
        {"IF0", {Op::kInert}},
    };
    if (const auto row = kCodes.find(token); row != kCodes.end()) {
      block.Add(row->second.op, {}, row->second.index, row->second.extra);
      if (row->second.phase != ir::Phase::kImmediate) block.Last().phase = row->second.phase;
      return;
    }
    if (token == "G97") {
      block.Add(Op::kSpeedMode, {}, Index(ir::SpeedMode::kRpm));
      block.Last().flags |= ir::Word::kFreezes;
      return;
    }
    static const std::map<std::string_view, Row> kAddresses = {
        {"X", {Op::kAxis, 0}},
        {"Y", {Op::kAxis, 1}},
        {"Z", {Op::kAxis, 2}},
        {"A", {Op::kAxis, 3}},
        {"C", {Op::kAxis, 5}},
        {"I", {Op::kCenter, 0}},
        {"J", {Op::kCenter, 1}},
        {"K", {Op::kCenter, 2}},
        {"I1", {Op::kVia, 0}},
        {"J1", {Op::kVia, 1}},
        {"K1", {Op::kVia, 2}},
        {"CR", {Op::kRadius}},
        {"AR", {Op::kOpeningAngle}},
        {"TURN", {Op::kTurns}},
        {"RP", {Op::kPolarRadius}},
        {"AP", {Op::kPolarAngle}},
        {"CHF", {Op::kChamfer, Index(ir::ChamferKind::kLength)}},
        {"CHR", {Op::kChamfer, Index(ir::ChamferKind::kLeg)}},
        {"RND", {Op::kChamfer, Index(ir::ChamferKind::kRound)}},
        {"RNDM", {Op::kChamfer, Index(ir::ChamferKind::kRoundModal)}},
        {"ANG", {Op::kContourAngle}},
        {"SF", {Op::kStartAngle}},
        {"F", {Op::kFeed}},
        {"FB", {Op::kFeedOnce}},
        {"S", {Op::kSpeed}},
        {"S1", {Op::kSpeed, 1}},
        {"S2", {Op::kSpeed, 2}},
        {"LIMS", {Op::kSpeedLimit}},
        {"SPOS", {Op::kSpindlePosition}},
        {"T", {Op::kTool}},
        {"D", {Op::kEdge}},
        {"H", {Op::kAuxH}},
        {"M", {Op::kAux}},
        {"G4F", {Op::kDwellSeconds}},
        {"G4S", {Op::kDwellRevolutions}},
        {"RPL", {Op::kFrameAngle}},
        {"P", {Op::kFrameFactor}},
        {"SETAL", {Op::kAlarm, Index(ir::AlarmKind::kByNumber)}},
    };
    std::size_t split = token.find('=');
    std::string_view value;
    if (split != std::string_view::npos) {
      value = token.substr(split + 1);
    } else {
      split = token.find_first_of("+-.0123456789");
      value = token.substr(split);
    }
    const Row& row = kAddresses.at(token.substr(0, split));
    const ir::ValueMode mode = Mode(value);
    block.Add(row.op, e.Number(value), row.index, row.extra);
    block.Last().mode = row.op == Op::kCenter && mode == ir::ValueMode::kModal ? ir::ValueMode::kStep : mode;
  }
};

}  // namespace ncport::exec
