#include "frontend/fanuc/cycle_words.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using F = ir::CycleField;
using L = CycleLetter;

namespace {

// R level, Q peck or shift, P dwell in milliseconds, K or L repeats; Haas I J K besides (fanuc-8.7, 13).
CycleLetter InDrillCycle(const words::CycleRow&, char letter, const CycleBlock& block) {
  switch (letter) {
    case 'R':
      return {L::kLength, F::kLevel};
    case 'Q':
      return {L::kLength, F::kStep};
    case 'P':
      return {L::kThousandths, F::kDwell};
    case 'L':
      return {L::kWhole, F::kRepeats};
    case 'K':
      return block.haas ? L{L::kLength, F::kShiftZ} : L{L::kWhole, F::kRepeats};
    case 'I':
      return {L::kLength, F::kShiftX};
    case 'J':
      return {L::kLength, F::kShiftY};
    default:
      return {};
  }
}

CycleLetter InSingleCycle(const words::CycleRow& row, char letter) {
  switch (letter) {
    case 'R':
      return {L::kLength, F::kTaper};
    case 'I':
      return row.cycle == ir::Cycle::kTurnFace ? L{L::kRefused, F::kTaper} : L{L::kLength, F::kTaper};
    case 'K':
      return row.cycle == ir::Cycle::kTurnFace ? L{L::kLength, F::kTaper} : L{L::kRefused, F::kTaper};
    case 'Q':
      return row.cycle == ir::Cycle::kTurnThread ? L{L::kStartAngle, F::kTaper} : L{L::kRefused, F::kTaper};
    case 'P':
    case 'J':
    case 'L':
    case 'D':
      return {L::kRefused, F::kTaper};
    default:
      return {};
  }
}

// G71 G72 G73 and G70: two blocks, or one with D (fanuc-8.8).
CycleLetter InContourCycle(const words::CycleRow& row, char letter, const CycleBlock& block) {
  const bool second = block.block_numbers;
  const bool pattern = row.cycle == ir::Cycle::kPattern;
  switch (letter) {
    case 'P':
      return {L::kWhole, F::kFirstBlock};
    case 'Q':
      return {L::kWhole, F::kLastBlock};
    case 'U':
      if (second) return {L::kLength, F::kAllowanceX};
      if (pattern) return {L::kLength, F::kReliefX};
      return row.cycle == ir::Cycle::kRoughTurn ? L{L::kLength, F::kDepth} : L{L::kRefused, F::kDepth};
    case 'W':
      if (second) return {L::kLength, F::kAllowanceZ};
      if (pattern) return {L::kLength, F::kReliefZ};
      return row.cycle == ir::Cycle::kRoughFace ? L{L::kLength, F::kDepth} : L{L::kRefused, F::kDepth};
    case 'R':
      if (second) return {L::kRefused, F::kRetract};
      return pattern ? L{L::kWhole, F::kPasses} : L{L::kLength, F::kRetract};
    case 'D':
      return pattern ? L{L::kWhole, F::kPasses} : L{L::kLength, F::kDepth};
    case 'I':
      return pattern ? L{L::kLength, F::kReliefX} : L{L::kRefused, F::kReliefX};
    case 'K':
      return pattern ? L{L::kLength, F::kReliefZ} : L{L::kRefused, F::kReliefZ};
    case 'F':
    case 'S':
    case 'T':
    case 'G':
    case 'M':
      return {};
    default:
      return {L::kRefused, F::kDepth};
  }
}

CycleLetter InGrooveCycle(const words::CycleRow& row, char letter, const CycleBlock& block) {
  const F relief = row.cycle == ir::Cycle::kGroove ? F::kReliefZ : F::kReliefX;
  switch (letter) {
    case 'R':
      return block.axis_words ? L{L::kLength, relief} : L{L::kLength, F::kRetract};
    case 'P':
      return {L::kThousandths, F::kStepX};
    case 'Q':
      return {L::kThousandths, F::kStepZ};
    case 'I':
      return {L::kLength, F::kStepX};
    case 'K':
      return {L::kLength, F::kStepZ};
    case 'D':
      return {L::kLength, relief};
    default:
      return {};
  }
}

CycleLetter InThreadCycle(char letter, const CycleBlock& block) {
  if (!block.axis_words) {
    switch (letter) {
      case 'P':
        return {L::kWhole, F::kForm};
      case 'Q':
        return {L::kThousandths, F::kLeastDepth};
      case 'R':
        return {L::kLength, F::kFinishDepth};
      default:
        return {};
    }
  }
  switch (letter) {
    case 'R':
    case 'I':
      return {L::kLength, F::kTaper};
    case 'P':
      return {L::kThousandths, F::kHeight};
    case 'Q':
      return {L::kThousandths, F::kFirstDepth};
    case 'K':
      return {L::kLength, F::kHeight};
    case 'D':
      return {L::kLength, F::kFirstDepth};
    case 'A':
      return {L::kWhole, F::kAngle};
    default:
      return {};
  }
}

}  // namespace

CycleLetter MeaningInCycle(const words::CycleRow& cycle, char letter, const CycleBlock& block) {
  switch (cycle.kind) {
    case words::CycleKind::kDrill:
      return InDrillCycle(cycle, letter, block);
    case words::CycleKind::kTurningSingle:
      return InSingleCycle(cycle, letter);
    case words::CycleKind::kRepetitive:
      break;
  }
  switch (cycle.cycle) {
    case ir::Cycle::kFaceGroove:
    case ir::Cycle::kGroove:
      return InGrooveCycle(cycle, letter, block);
    case ir::Cycle::kMultiThread:
      return InThreadCycle(letter, block);
    default:
      return InContourCycle(cycle, letter, block);
  }
}

}  // namespace ncport::frontend::fanuc
