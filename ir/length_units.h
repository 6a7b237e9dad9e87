// Lengths in inches. Whatever runs, positions are kept in mm.
#pragma once

#include "ir/modes.h"

namespace ncport::ir {

inline constexpr double kMmPerInch = 25.4;
inline constexpr double kMetersPerFoot = 0.3048;  // surface speeds: ft/min in m/min

/// Lengths of the geometry are inches; the feed stays mm under kInchGeometry.
constexpr bool LengthsAreInches(Units units) { return units == Units::kInch || units == Units::kInchGeometry; }
/// The word of a cycle is a length, and no time, count, angle or number.
constexpr bool IsLength(CycleField field) {
  switch (field) {
    case CycleField::kDwell:
    case CycleField::kRepeats:
    case CycleField::kFirstBlock:
    case CycleField::kLastBlock:
    case CycleField::kPasses:
    case CycleField::kForm:
    case CycleField::kMethod:
    case CycleField::kAngle:
      return false;
    default:
      return true;
  }
}
/// Millimetres of one unit of length; 1 where the unit is not known.
constexpr double MmPerLengthUnit(Units units) { return LengthsAreInches(units) ? kMmPerInch : 1; }

}  // namespace ncport::ir
