// Address letters, their number formats, and the letters of macro arguments (fanuc-2.2, 7.3; mazak-lathe-3.1, 7).
#include <algorithm>
#include <iterator>

#include "dialects/fanuc/words.h"

namespace ncport::dialects::fanuc {

namespace {

using F = NumberForm;
using ir::Phase;
using ir::ValueMode;
using Op = ir::WordOp;

constexpr std::uint8_t kX = 0, kY = 1, kZ = 2, kA = 3, kB = 4, kC = 5, kU = 6, kV = 7, kW = 8;

constexpr AddressRow Axis(char letter, std::uint8_t axis, F form = F::kLength) {
  return {letter, Op::kAxis, axis, ValueMode::kModal, form, Phase::kMotion, "fanuc-2.2"};
}
constexpr AddressRow Increment(char letter, std::uint8_t axis, F form = F::kLength) {
  return {letter, Op::kAxis, axis, ValueMode::kIncremental, form, Phase::kMotion, "fanuc-8.2"};
}
constexpr AddressRow Other(char letter, Op op, F form, Phase phase, std::string_view rule, std::uint8_t index = 0) {
  return {letter, op, index, ValueMode::kModal, form, phase, rule};
}

// What all systems share.
#define NCPORT_COMMON_ROWS                                                                                        \
  Axis('X', kX), Axis('Y', kY), Axis('Z', kZ), Axis('A', kA, F::kAngle), Axis('B', kB, F::kAngle),                \
      Axis('C', kC, F::kAngle), {'I', Op::kCenter, 0, ValueMode::kStep, F::kLength, Phase::kMotion, "fanuc-8.3"}, \
      {'J', Op::kCenter, 1, ValueMode::kStep, F::kLength, Phase::kMotion, "fanuc-8.3"},                           \
      {'K', Op::kCenter, 2, ValueMode::kStep, F::kLength, Phase::kMotion, "fanuc-8.3"},                           \
      Other('R', Op::kRadius, F::kLength, Phase::kMotion, "fanuc-8.3"),                                           \
      Other('F', Op::kFeed, F::kFeed, Phase::kSetting, "fanuc-2.2"),                                              \
      Other('S', Op::kSpeed, F::kInteger, Phase::kBefore, "fanuc-8.11"),                                          \
      Other('T', Op::kTool, F::kInteger, Phase::kBefore, "fanuc-8.11"),                                           \
      Other('P', Op::kInert, F::kInteger, Phase::kSetting, "fanuc-2.2"),                                          \
      Other('Q', Op::kInert, F::kLength, Phase::kSetting, "fanuc-2.2"),                                           \
      Other('L', Op::kInert, F::kInteger, Phase::kSetting, "fanuc-2.2"),                                          \
      Other('E', Op::kInert, F::kFeed, Phase::kSetting, "fanuc-8.1"),                                             \
      Other('G', Op::kComputedG, F::kCode, Phase::kSetting, "fanuc-5"),                                           \
      Other('M', Op::kComputedM, F::kInteger, Phase::kBefore, "fanuc-5")

constexpr AddressRow kMillRows[] = {
    NCPORT_COMMON_ROWS,
    Axis('U', kU),
    Axis('V', kV),
    Axis('W', kW),
    Other('H', Op::kLengthOffset, F::kInteger, Phase::kBefore, "fanuc-8.11", 1),
    Other('D', Op::kRadiusOffset, F::kInteger, Phase::kBefore, "fanuc-8.11"),
};

// U W V H are increments of X Z Y C (fanuc-8.2); D is a word of cycles only.
constexpr AddressRow kIncrementRows[] = {
    NCPORT_COMMON_ROWS,
    Increment('U', kX),
    Increment('V', kY),
    Increment('W', kZ),
    Increment('H', kC, F::kAngle),
    Other('D', Op::kInert, F::kLength, Phase::kSetting, "fanuc-8.8"),
};

// Systems B and C: increments come by G91; that U W work besides is true of the 30i only, so they stay refused
// (fanuc-8.2).
constexpr AddressRow kAbsoluteRows[] = {
    NCPORT_COMMON_ROWS,
    Other('D', Op::kInert, F::kLength, Phase::kSetting, "fanuc-8.8"),
};

// INTEGREX: U V W may be axes of their own (mazak-lathe-3.1); the profile's list of axes decides.
constexpr AddressRow kMazakMRows[] = {
    NCPORT_COMMON_ROWS,
    Axis('U', kU),
    Axis('V', kV),
    Axis('W', kW),
    Other('H', Op::kLengthOffset, F::kInteger, Phase::kBefore, "mazak-lathe-3.1", 1),
    Other('D', Op::kRadiusOffset, F::kInteger, Phase::kBefore, "fanuc-8.11"),
};
#undef NCPORT_COMMON_ROWS

constexpr std::uint8_t kCells[26] = {
    // A  B  C  D  E  F  G  H   I  J  K  L  M   N  O  P  Q   R   S   T   U   V   W   X   Y   Z
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

constexpr NumberRange kFreeLocals[] = {{10, 10}, {12, 12}, {14, 16}, {27, 33}};

}  // namespace

std::span<const AddressRow> Addresses(System system) {
  switch (system) {
    case System::kMill:
      return kMillRows;
    case System::kLatheA:
    case System::kMazakT:
      return kIncrementRows;
    case System::kLatheB:
    case System::kLatheC:
      return kAbsoluteRows;
    case System::kMazakM:
      return kMazakMRows;
  }
  return {};
}

const AddressRow* FindAddress(System system, char letter) {
  for (const AddressRow& row : Addresses(system)) {
    if (row.letter == letter) return &row;
  }
  return nullptr;
}

NumberUnit UnitOf(WordContext context, System system) {
  const bool mill = system == System::kMill;
  const bool mazak = system == System::kMazakT || system == System::kMazakM;
  switch (context) {
    case WordContext::kFeedPerMinute:
      return {1, 0.01, true};
    case WordContext::kFeedPerRevolution:
      // Mazak 0.01 (mazak-lathe-7); Fanuc mills 0.01, lathes 0.0001 mm. The inch column of the lathes: a hundredth of
      // the metric one, decided here; the card prints none.
      if (mazak || mill) return {0.01, 0.0001, true};
      return {0.0001, 0.000001, true};
    case WordContext::kThreadLead:
      return {mill ? 0.01 : 0.0001, mill ? 0.0001 : 0.000001, true};
    case WordContext::kDwellSeconds:
      return {0.001, 0.001, true};
    case WordContext::kDwellMilliseconds:
      return {0.001, 0.001, false};
    case WordContext::kCycleStep:
      return {0.001, 0.0001, mazak};  // Mazak: with point (mazak-lathe-2.5)
    case WordContext::kScaleFactor:
      return {0.001, 0.001, true};
    case WordContext::kStartAngle:
      return {0.001, 0.001, true};
  }
  return {};
}

std::uint32_t ArgumentCell(char letter) { return letter >= 'A' && letter <= 'Z' ? kCells[letter - 'A'] : 0; }

char ArgumentLetter(std::uint32_t cell) {
  if (cell == 0) return 0;
  const auto* found = std::ranges::find(kCells, cell);
  return found == std::end(kCells) ? '\0' : static_cast<char>('A' + (found - kCells));
}

std::span<const NumberRange> FreeLocals() { return kFreeLocals; }

}  // namespace ncport::dialects::fanuc
