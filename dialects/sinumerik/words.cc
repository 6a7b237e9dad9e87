// Addresses, functions, attributes and inert procedures of SINUMERIK.
#include "dialects/sinumerik/words.h"

#include <algorithm>

#include "base/result.h"
#include "ir/modes.h"

namespace ncport::dialects::sinumerik {

namespace {

using ir::Phase;
using ir::Type;
using Op = ir::WordOp;
using F = ir::Function;

template <class Kind>
constexpr std::uint8_t At(Kind kind) {
  return static_cast<std::uint8_t>(kind);
}

constexpr AddressRow kAddresses[] = {
    // Card 5.1: I J K are incremental unless AC() says otherwise.
    {"I", Op::kCenter, 0, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"J", Op::kCenter, 1, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"K", Op::kCenter, 2, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"I1", Op::kVia, 0, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"J1", Op::kVia, 1, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"K1", Op::kVia, 2, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"CR", Op::kRadius, 0, kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"AR", Op::kOpeningAngle, 0, kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"TURN", Op::kTurns, 0, kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.3"},
    {"AP", Op::kPolarAngle, 0, kLinearModes, Extension::kNone, Phase::kMotion, "sinumerik-8.6"},
    {"RP", Op::kPolarRadius, 0, kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.6"},
    {"ANG", Op::kContourAngle, 0, kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.9"},
    {"CHF", Op::kChamfer, At(ir::ChamferKind::kLength), kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.9"},
    {"CHR", Op::kChamfer, At(ir::ChamferKind::kLeg), kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.9"},
    {"RND", Op::kChamfer, At(ir::ChamferKind::kRound), kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.9"},
    {"RNDM", Op::kChamfer, At(ir::ChamferKind::kRoundModal), kPlainOnly, Extension::kNone, Phase::kMotion,
     "sinumerik-8.9"},
    {"SF", Op::kStartAngle, 0, kPlainOnly, Extension::kNone, Phase::kMotion, "sinumerik-8.4"},
    {"F", Op::kFeed, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.8"},
    {"FB", Op::kFeedOnce, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.8"},
    {"S", Op::kSpeed, 0, kPlainOnly, Extension::kSpindle, Phase::kBefore, "sinumerik-8.8"},
    {"LIMS", Op::kSpeedLimit, 0, kPlainOnly, Extension::kSpindle, Phase::kBefore, "sinumerik-8.8"},
    {"SPOS", Op::kSpindlePosition, 0, kLinearModes | kRotaryModes, Extension::kSpindle, Phase::kBefore,
     "sinumerik-8.8"},
    {"SPOSA", Op::kSpindlePosition, 0, kLinearModes | kRotaryModes, Extension::kSpindle, Phase::kBefore,
     "sinumerik-8.8", true},
    {"T", Op::kTool, 0, kQuickMode, Extension::kSpindle, Phase::kBefore, "sinumerik-8.8"},
    {"D", Op::kEdge, 0, kQuickMode, Extension::kNone, Phase::kBefore, "sinumerik-8.8"},
    {"H", Op::kAuxH, 0, kQuickMode, Extension::kNumber, Phase::kBefore, "sinumerik-8.10"},
    {"RPL", Op::kFrameAngle, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.7"},
    // No effect on programmed end points: blending, tolerances, approach of threads, number of the fixed point.
    {"ADIS", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.2"},
    {"ADISPOS", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.2"},
    {"DISC", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.8"},
    {"CTOL", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.2"},
    {"OTOL", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.2"},
    {"ACC", Op::kInert, 0, kPlainOnly, Extension::kAxis, Phase::kSetting, "sinumerik-8.8"},
    {"DITS", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.4"},
    {"DITE", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.4"},
    {"FP", Op::kInert, 0, kPlainOnly, Extension::kNone, Phase::kSetting, "sinumerik-8.2"},
};

constexpr FunctionRow kFunctions[] = {
    {"SIN", F::kSin, Type::kReal, "sinumerik-4.3"},
    {"COS", F::kCos, Type::kReal, "sinumerik-4.3"},
    {"TAN", F::kTan, Type::kReal, "sinumerik-4.3"},
    {"ASIN", F::kAsin, Type::kReal, "sinumerik-4.3"},
    {"ACOS", F::kAcos, Type::kReal, "sinumerik-4.3"},
    {"ATAN2", F::kAtan2, Type::kReal, "sinumerik-4.3"},
    {"SQRT", F::kSqrt, Type::kReal, "sinumerik-4.3"},
    {"ABS", F::kAbs, Type::kAny, "sinumerik-4.3"},
    {"POT", F::kSquare, Type::kReal, "sinumerik-4.3"},
    {"TRUNC", F::kTruncate, Type::kReal, "sinumerik-4.3"},
    {"ROUND", F::kRound, Type::kReal, "sinumerik-4.3"},
    {"ROUNDUP", F::kRoundUp, Type::kReal, "sinumerik-4.3"},
    {"LN", F::kLn, Type::kReal, "sinumerik-4.3"},
    {"EXP", F::kExp, Type::kReal, "sinumerik-4.3"},
    {"MINVAL", F::kMinimum, Type::kAny, "sinumerik-4.3"},
    {"MAXVAL", F::kMaximum, Type::kAny, "sinumerik-4.3"},
    {"BOUND", F::kBound, Type::kAny, "sinumerik-4.3"},
    {"ISAXIS", F::kIsAxis, Type::kBool, "sinumerik-4.5"},
    {"ISVAR", F::kIsVariable, Type::kBool, "sinumerik-4.5"},
    {"AXNAME", F::kAxisFromText, Type::kAxis, "sinumerik-4.5"},
    {"AXSTRING", F::kAxisToText, Type::kString, "sinumerik-4.5"},
    {"STRLEN", F::kStringLength, Type::kInt, "sinumerik-4.6"},
    {"INDEX", F::kIndexOf, Type::kInt, "sinumerik-4.6"},
    {"RINDEX", F::kLastIndexOf, Type::kInt, "sinumerik-4.6"},
    {"MINDEX", F::kIndexOfAny, Type::kInt, "sinumerik-4.6"},
    {"MATCH", F::kFind, Type::kInt, "sinumerik-4.6"},
    {"SUBSTR", F::kSubstring, Type::kString, "sinumerik-4.6"},
    {"TOUPPER", F::kToUpper, Type::kString, "sinumerik-4.6"},
    {"TOLOWER", F::kToLower, Type::kString, "sinumerik-4.6"},
    {"NUMBER", F::kParseNumber, Type::kReal, "sinumerik-4.6"},
    {"ISNUMBER", F::kIsNumber, Type::kBool, "sinumerik-4.6"},
    {"SPRINT", F::kFormat, Type::kString, "sinumerik-4.6"},
};

constexpr ModeRow kModes[] = {
    {"AC", ir::ValueMode::kAbsolute, kLinearModes},
    {"IC", ir::ValueMode::kIncremental, kLinearModes},
    {"DC", ir::ValueMode::kShortest, kRotaryModes},
    {"ACP", ir::ValueMode::kPositive, kRotaryModes},
    {"ACN", ir::ValueMode::kNegative, kRotaryModes},
    {"DAC", ir::ValueMode::kAbsoluteDiameter, kDiameterModes},
    {"DIC", ir::ValueMode::kIncrementalDiameter, kDiameterModes},
    {"RAC", ir::ValueMode::kAbsoluteRadius, kDiameterModes},
    {"RIC", ir::ValueMode::kIncrementalRadius, kDiameterModes},
    {"QU", ir::ValueMode::kQuick, kQuickMode},
};

constexpr TypeRow kTypes[] = {
    {"INT", Type::kInt},   {"REAL", Type::kReal},     {"BOOL", Type::kBool},   {"CHAR", Type::kChar},
    {"AXIS", Type::kAxis}, {"STRING", Type::kString}, {"FRAME", Type::kFrame},
};

constexpr std::string_view kAttributes[] = {
    "SAVE",   "DISPLOF", "DISPLON",  "ACTBLOCNO",  "SBLOF",      "SBLON",      "PREPRO",
    "ICYCON", "ICYCOF",  "IPTRLOCK", "IPTRUNLOCK", "DELAYFSTON", "DELAYFSTOF",
};
constexpr std::string_view kFlags[] = {"SYNR", "SYNW", "SYNRW", "INIPO", "INIRE", "INICF", "PRLOC"};
constexpr std::string_view kValues[] = {"PHU", "APR", "APW", "APX", "APRP", "APWP", "APRB", "APWB"};
constexpr std::string_view kInertProcedures[] = {"GROUP_BEGIN", "GROUP_END", "BRISKA", "SOFTA", "SETMS"};

}  // namespace

std::span<const AddressRow> Addresses() { return kAddresses; }

const AddressRow* FindAddress(ir::WordOp op, std::uint8_t index) {
  if (op == Op::kInert) return nullptr;
  for (const AddressRow& row : kAddresses) {
    if (row.op == op && (row.index == index || row.extension != Extension::kNone) && !row.alias) return &row;
  }
  return nullptr;
}

std::span<const FunctionRow> Functions() { return kFunctions; }

const FunctionRow* FindFunction(ir::Function function) {
  for (const FunctionRow& row : kFunctions) {
    if (row.function == function) return &row;
  }
  return nullptr;
}

std::span<const ModeRow> ValueModes() { return kModes; }
std::span<const TypeRow> Types() { return kTypes; }
std::span<const std::string_view> ProgramAttributes() { return kAttributes; }
std::span<const std::string_view> DefinitionFlags() { return kFlags; }
std::span<const std::string_view> DefinitionValues() { return kValues; }
std::span<const std::string_view> InertProcedures() { return kInertProcedures; }

bool IsReserved(std::string_view word) {
  const auto words = ReservedWords();
  return std::binary_search(words.begin(), words.end(), word);
}

}  // namespace ncport::dialects::sinumerik
