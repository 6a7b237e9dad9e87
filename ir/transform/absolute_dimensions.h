// Writes every dimension word as an absolute one in the terms of the target, so that no later pass or printer depends
// on the distance, diameter or unit mode in force: an increment becomes the position it leads to.
// Positions are kept as sums; where ways with different sums meet, or a variable of a sum changes, the position is held
// in a local (POS_X). A step away and back costs nothing, and nothing is rounded on the way: no drift. Where a
// subprogram starts with increments, or its caller goes on with some, the position crosses the call in a cell (AT_X).
//
// What only the source has is written as end points and centres: arcs by opening angle or intermediate point, polar
// words about their pole, additional full turns as circles. Where that needs a start point, a pole or a radius that is
// not known, it is refused.
//
// Programmable frames can be worked into the coordinates: then a block has the words of all axes that its move changes,
// arcs their centres, senses and sizes as the frame makes them. A frame that is not the same on every way to a move, a
// computed angle or factor, and what keeps no circle a circle are refused.
//
// Increments can be kept instead (KeepIncrements) where the target has words for them: a word for one axis, or a mode
// of the whole block. One is kept where both controls go on from the same place: the axis was moved last in the present
// coordinates and by the present tool. All others become positions as said above.
//
// Afterwards all Axis words are kAbsolute (kIncremental where kept, kModal in blocks under a distance mode) and all
// Center words kStep (from the start point, radius); Distance, Diameter, OpeningAngle, Via, Turns, Pole and polar words
// are gone, and lengths are mm.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/diag/sink.h"
#include "ir/analysis/value_range.h"
#include "ir/machine.h"
#include "ir/module.h"
#include "ir/transform/frame_flow.h"

namespace ncport::ir::transform {

enum class KeepIncrements : std::uint8_t {
  kNo,
  kAxes,    // as words of their own (U, W)
  kBlocks,  // under a mode, by blocks all of whose axis words are increments (G91); behind them absolute again
};

struct AbsoluteDimensionsConfig {
  std::uint8_t diameter_axis = 0xFF;              // of the target: its words are diameters; 0xFF = none
  ModalState sub_entry;                           // state of subprograms that nothing in the module calls ([entry])
  std::vector<analysis::DeclaredRange> declared;  // what is promised of parameters
  std::string_view target;                        // its name, for findings
  bool work_frames_in = false;  // frames go into the coordinates, their words away; else they stay where they are
  FrameFlowOptions frames;
  /// Chamfers and roundings between straight moves that become moves of their own: none, chamfers by their length, all.
  enum class Corners : std::uint8_t { kNone, kByLength, kAll };
  Corners corners_to_moves = Corners::kNone;
  KeepIncrements keep = KeepIncrements::kNo;
  std::uint16_t keep_axes = 0;  // bit per axis that has a word for increments (kAxes)
  /// What the target makes of a computed word on its way to the axis, and the least increment of its words, in mm or
  /// degrees as the word says them: whether a kept increment is rounded each time.
  WordError word_error = WordError::kNone;
  double increment = 0;
};

/// Increments that were kept.
struct KeptIncrements {
  std::uint32_t words = 0;
  std::uint32_t drifting = 0;      // not proven to be multiples of the target's increment
  std::vector<ProgramId> started;  // programs whose first increments start where a caller outside of the module stands
};

/// Programs that find the position in cells when they start or end: nobody else may call them without filling these.
struct CarriedPositions {
  std::vector<ProgramId> programs;
  std::vector<SpaceId> cells;  // one cell each
};

/// All programs of the module. An increment from a position that is not known, and a word under a mode that is not one
/// value there, are findings (NC5001, NC5006) at the word; returns false then. A kept increment that the target may
/// round is a warning (NC6015) that says by how much.
bool AbsoluteDimensions(Module& module, const Machine& source, const AbsoluteDimensionsConfig& config, diag::Sink& sink,
                        CarriedPositions* carried = nullptr, KeptIncrements* kept = nullptr);

}  // namespace ncport::ir::transform
