// Codes of one meaning each: one row a function, one column a G-code system, as fanuc-8.1 and mazak-lathe-2.2 print
// them.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "dialects/fanuc/words.h"
#include "ir/modes.h"

namespace ncport::dialects::fanuc {

namespace {

using ir::Phase;
using Op = ir::WordOp;

constexpr std::uint32_t kNone = Id<void>::kNone;

/// Texts by System; empty: the system has no such word.
using Texts = std::array<std::string_view, kSystems>;
/// Modal group of mills, Fanuc lathes, Mazak turning machines; 0 = one-shot.
using Groups = std::array<std::uint8_t, 3>;

struct Row {
  Texts text;
  Op op;
  std::uint8_t index;
  std::uint32_t extra;
  Phase phase;
  Groups group;
  std::string_view rule;
  bool alias = false;
  std::uint8_t flags = 0;
};

constexpr Texts Everywhere(std::string_view text) { return {text, text, text, text, text, text}; }

template <class Mode>
constexpr Row Modal(const Texts& text, Op op, Mode mode, Groups group, std::string_view rule = "fanuc-8.1",
                    bool alias = false, std::uint8_t flags = 0) {
  return {text, op, static_cast<std::uint8_t>(mode), kNone, Phase::kSetting, group, rule, alias, flags};
}
template <class Kind>
constexpr Row Move(const Texts& text, Op op, Kind kind, std::string_view rule = "fanuc-8.1") {
  return {text, op, static_cast<std::uint8_t>(kind), kNone, Phase::kMotion, {0, 0, 0}, rule};
}
constexpr Row Length(const Texts& text, std::uint8_t index) {
  return {text, Op::kLengthOffset, index, kNone, Phase::kBefore, {8, 8, 8}, "fanuc-8.1"};
}
constexpr Row Offset(std::string_view text, std::uint32_t number) {
  return {Everywhere(text), Op::kWorkOffset, 0, number, Phase::kSetting, {14, 14, 12}, "fanuc-8.4"};
}
constexpr Row M(const Texts& text, Op op, std::uint32_t extra, Phase phase) {
  return {text, op, 0, extra, phase, {0, 0, 0}, "fanuc-8.11"};
}

constexpr Row kRows[] = {
    //                  mill   T-A    T-B    T-C    Mazak T Mazak M
    Modal(Everywhere("G0"), Op::kMotion, ir::Motion::kRapid, {1, 1, 1}),
    Modal(Everywhere("G1"), Op::kMotion, ir::Motion::kLinear, {1, 1, 1}),
    Modal(Everywhere("G2"), Op::kMotion, ir::Motion::kArcCw, {1, 1, 1}, "fanuc-8.3"),
    Modal(Everywhere("G3"), Op::kMotion, ir::Motion::kArcCcw, {1, 1, 1}, "fanuc-8.3"),
    Modal(Texts{"G33", "G32", "G33", "G33", "G32", "G32"}, Op::kMotion, ir::Motion::kThread, {1, 1, 1}),
    Modal(Texts{"", "", "", "", "G33", "G33"}, Op::kMotion, ir::Motion::kThread, {1, 1, 1}, "mazak-lathe-2.2", true),
    Modal(Texts{"", "G34", "G34", "G34", "G34", "G34"}, Op::kMotion, ir::Motion::kThreadIncreasing, {1, 1, 1}),
    Modal(Everywhere("G31"), Op::kMotion, ir::Motion::kProbe, {0, 0, 0}),

    Modal(Everywhere("G17"), Op::kPlane, ir::Plane::kXY, {2, 16, 2}),
    Modal(Everywhere("G18"), Op::kPlane, ir::Plane::kZX, {2, 16, 2}),
    Modal(Everywhere("G19"), Op::kPlane, ir::Plane::kYZ, {2, 16, 2}),

    Modal(Texts{"G90", "", "G90", "G90", "", "G90"}, Op::kDistance, ir::Distance::kAbsolute, {3, 3, 3}),
    Modal(Texts{"G91", "", "G91", "G91", "", "G91"}, Op::kDistance, ir::Distance::kIncremental, {3, 3, 3}),

    Modal(Texts{"G93", "G93", "G93", "G93", "", "G93"}, Op::kFeedMode, ir::FeedMode::kInverseTime, {5, 5, 5}),
    Modal(Texts{"G94", "G98", "G94", "G94", "G98", "G94"}, Op::kFeedMode, ir::FeedMode::kPerMinute, {5, 5, 5}),
    Modal(Texts{"G95", "G99", "G95", "G95", "G99", "G95"}, Op::kFeedMode, ir::FeedMode::kPerRevolution, {5, 5, 5}),

    Modal(Texts{"G20", "G20", "G20", "G70", "G20", "G20"}, Op::kUnits, ir::Units::kInch, {6, 6, 6}),
    Modal(Texts{"G21", "G21", "G21", "G71", "G21", "G21"}, Op::kUnits, ir::Units::kMm, {6, 6, 6}),

    Modal(Everywhere("G40"), Op::kCutterComp, ir::CutterComp::kOff, {7, 7, 7}),
    Modal(Everywhere("G41"), Op::kCutterComp, ir::CutterComp::kLeft, {7, 7, 7}),
    Modal(Everywhere("G42"), Op::kCutterComp, ir::CutterComp::kRight, {7, 7, 7}),

    // The H word of the block is the number; G49 needs none. Index: 0 off, 1 plus, 2 minus.
    Length(Texts{"G43", "", "", "", "", "G43"}, 1),
    Length(Texts{"G44", "", "", "", "", "G44"}, 2),
    Length(Texts{"G49", "", "", "", "", "G49"}, 0),

    Modal(Texts{"G98", "", "G98", "G98", "", "G98"}, Op::kReturnLevel, ir::ReturnLevel::kInitial, {10, 11, 10}),
    Modal(Texts{"G99", "", "G99", "G99", "", "G99"}, Op::kReturnLevel, ir::ReturnLevel::kRPlane, {10, 11, 10}),

    Modal(Everywhere("G96"), Op::kSpeedMode, ir::SpeedMode::kConstantSurface, {13, 2, 17}),
    // G97 without S: the card is silent; the speed of the moment stays, as the Mazak card says of its header (10.1).
    Modal(Everywhere("G97"), Op::kSpeedMode, ir::SpeedMode::kRpm, {13, 2, 17}, "fanuc-8.1", false, ir::Word::kFreezes),

    Modal(Everywhere("G53"), Op::kMachineCoords, 0, {0, 0, 0}, "fanuc-8.4"),
    Offset("G54", 54),
    Offset("G55", 55),
    Offset("G56", 56),
    Offset("G57", 57),
    Offset("G58", 58),
    Offset("G59", 59),

    Modal(Texts{"G9", "G9", "", "", "", ""}, Op::kExactOnce, 0, {0, 0, 0}),
    Modal(Everywhere("G61"), Op::kPathMode, ir::PathMode::kExact, {15, 15, 13}),
    Modal(Everywhere("G64"), Op::kPathMode, ir::PathMode::kContinuous, {15, 15, 13}),
    // Corner override, tapping mode, shape compensation: no exact stop; none is ever printed.
    Modal(Everywhere("G62"), Op::kPathMode, ir::PathMode::kContinuous, {15, 15, 13}, "fanuc-8.1", true),
    Modal(Everywhere("G63"), Op::kPathMode, ir::PathMode::kContinuous, {15, 15, 13}, "fanuc-8.1", true),
    Modal(Texts{"G61.1", "", "", "", "", "G61.1"}, Op::kPathMode, ir::PathMode::kContinuous, {15, 15, 13}, "fanuc-12.1",
          true),

    Move(Everywhere("G28"), Op::kReference, ir::ReferenceKind::kReference),
    Move(Texts{"G29", "G29", "G29", "G29", "", "G29"}, Op::kReference, ir::ReferenceKind::kFromReference),
    Move(Everywhere("G30"), Op::kReference, ir::ReferenceKind::kSecondReference),

    M(Everywhere("M0"), Op::kStop, kNone, Phase::kAfter),
    M(Everywhere("M1"), Op::kOptionalStop, kNone, Phase::kAfter),
    M(Everywhere("M2"), Op::kProgramEnd, 2, Phase::kLast),
    M(Everywhere("M30"), Op::kProgramEnd, 30, Phase::kLast),
    // M3 M4 M5 stand in the profile: which spindle they mean is a fact of the machine.
    M(Texts{"M6", "", "", "", "", "M6"}, Op::kToolChange, kNone, Phase::kBefore),
    M(Everywhere("M9"), Op::kAux, 9, Phase::kAfter),
};

constexpr CodeRow kAuxiliary{"M", Op::kAux, 0, kNone, Phase::kBefore, 0, "fanuc-8.11", false, 0};

constexpr std::size_t GroupColumn(System system) {
  switch (system) {
    case System::kMill:
      return 0;
    case System::kLatheA:
    case System::kLatheB:
    case System::kLatheC:
      return 1;
    case System::kMazakT:
    case System::kMazakM:
      return 2;
  }
  return 0;
}

/// The column of one system as a table of its own.
struct Column {
  explicit Column(System system) : rows(RowsOf(system)), table(rows) {}

  static std::vector<CodeRow> RowsOf(System system) {
    std::vector<CodeRow> rows;
    for (const Row& row : kRows) {
      const std::string_view text = row.text[static_cast<std::size_t>(system)];
      if (text.empty()) continue;
      rows.push_back({text, row.op, row.index, row.extra, row.phase, row.group[GroupColumn(system)], row.rule,
                      row.alias, row.flags});
    }
    return rows;
  }

  std::vector<CodeRow> rows;
  CodeTable table;
};

}  // namespace

const CodeTable& Codes(System system) {
  switch (system) {
    case System::kMill: {
      static const Column column{System::kMill};
      return column.table;
    }
    case System::kLatheA: {
      static const Column column{System::kLatheA};
      return column.table;
    }
    case System::kLatheB: {
      static const Column column{System::kLatheB};
      return column.table;
    }
    case System::kLatheC: {
      static const Column column{System::kLatheC};
      return column.table;
    }
    case System::kMazakT: {
      static const Column column{System::kMazakT};
      return column.table;
    }
    case System::kMazakM:
      break;
  }
  static const Column column{System::kMazakM};
  return column.table;
}

const CodeRow& AuxiliaryCode() { return kAuxiliary; }

std::optional<System> SystemOf(const Profile& profile) {
  if (!profile.IsLathe()) return System::kMill;
  if (!profile.series.Known()) return std::nullopt;
  switch (*profile.series) {
    case Series::kA:
      return System::kLatheA;
    case Series::kB:
      return System::kLatheB;
    case Series::kC:
      return System::kLatheC;
    case Series::kT:
      return System::kMazakT;
    case Series::kM:
      return System::kMazakM;
    case Series::kNone:
      break;
  }
  return std::nullopt;
}

}  // namespace ncport::dialects::fanuc
