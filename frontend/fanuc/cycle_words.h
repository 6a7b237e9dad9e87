// What the letters of a block with a canned cycle mean (fanuc-8.7, 8.8; mazak-lathe-2.5).
#pragma once

#include <cstdint>

#include "dialects/fanuc/words.h"
#include "ir/modes.h"

namespace ncport::frontend::fanuc {

struct CycleLetter {
  enum Kind : std::uint8_t {
    kPlain,        // what the letter means in every block
    kLength,       // mm or degrees; without point least increments
    kThousandths,  // whole: milliseconds, 0.001 mm
    kWhole,
    kStartAngle,  // of a thread
    kRefused,
  };
  Kind kind = kPlain;
  ir::CycleField field = ir::CycleField::kLevel;
};

struct CycleBlock {
  bool block_numbers = false;  // P and Q stand in the block: of a contour cycle, the second block
  bool axis_words = false;
  bool haas = false;
};

CycleLetter MeaningInCycle(const dialects::fanuc::CycleRow& cycle, char letter, const CycleBlock& block);

}  // namespace ncport::frontend::fanuc
