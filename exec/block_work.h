// The words of one block with their values, collected in source order before anything but assignments takes effect.
#pragma once

#include <cstdint>

#include "exec/value.h"
#include "ir/modes.h"
#include "ir/nodes.h"

namespace ncport::exec {

struct BlockWork {
  /// Which single words the block holds.
  enum Has : std::uint32_t {
    kRadius = 1U << 0U,
    kOpening = 1U << 1U,
    kTurns = 1U << 2U,
    kPolarRadius = 1U << 3U,
    kPolarAngle = 1U << 4U,
    kChamfer = 1U << 5U,
    kContourAngle = 1U << 6U,
    kStartAngle = 1U << 7U,
    kFeed = 1U << 8U,
    kFeedOnce = 1U << 9U,
    kMachineCoords = 1U << 10U,
    kReference = 1U << 11U,
    kPole = 1U << 12U,
    kFrame = 1U << 13U,  // the frame operation with values
    kFrameAngle = 1U << 14U,
    kPreset = 1U << 15U,
    kDwell = 1U << 16U,
    kExactOnce = 1U << 17U,
    kOneShotMotion = 1U << 18U,  // a motion word that holds for this block only
    kMotionWord = 1U << 19U,
    kSpeed = 1U << 20U,
    kRoundModal = 1U << 21U,
    kSpeedLimit = 1U << 22U,
    kEdge = 1U << 23U,
    kFeedMode = 1U << 24U,
    kCycleWord = 1U << 25U,  // a cycle begins or ends here
    kRotateEnd = 1U << 26U,  // these may stand beside each other and beside an operation with values
    kScaleEnd = 1U << 27U,
    kMirrorEnd = 1U << 28U,  // its axis words name axes
    kPoint = 1U << 29U,      // the number of a reference point
    kRigid = 1U << 30U,      // the taps that follow are rigid
    kFrameEnds = kRotateEnd | kScaleEnd | kMirrorEnd,
  };

  static constexpr std::size_t kCycleFields = 32;

  std::uint32_t has = 0;
  std::uint32_t scaled = 0;         // single words that count increments (Word::kIncrements)
  std::uint32_t rounded_words = 0;  // single words that pass through Machine::word_error
  std::uint32_t cycle_fields = 0;   // bit per ir::CycleField
  std::uint32_t cycle_scaled = 0;
  std::uint32_t cycle_rounded = 0;  // lengths of a cycle that pass through Machine::word_error
  std::uint16_t scaled_axes = 0;
  std::uint8_t scaled_centers = 0;
  std::uint8_t rounded_centers = 0;
  std::uint8_t factors = 0;  // bits: all axes, X, Y, Z
  std::uint8_t scaled_factors = 0;
  std::uint16_t axes = 0;
  std::uint16_t rounded = 0;  // axes whose word passes through Machine::word_error
  std::uint8_t centers = 0;   // bits I J K
  std::uint8_t vias = 0;

  double axis[ir::kMaxAxes];
  ir::ValueMode axis_mode[ir::kMaxAxes];
  double center[3];
  double center_written[3];  // before increments are counted: K of a cycle is a count
  double factor[4];
  double cycle_value[kCycleFields];
  ir::Cycle cycle;
  ir::ValueMode center_mode[3];
  double via[3];
  ir::ValueMode via_mode[3];
  double radius, opening, turns, polar_radius, polar_angle, chamfer, round_modal, contour_angle, start_angle, feed,
      feed_once, frame_angle, dwell;
  ir::ValueMode polar_angle_mode;
  ir::ChamferKind chamfer_kind;
  ir::FrameOp frame;
  ir::ReferenceKind reference;
  double point;
  ir::PoleBase pole;
  bool dwell_revolutions;
  ir::Motion one_shot;

  [[nodiscard]] bool HasField(ir::CycleField field) const {
    return (cycle_fields >> static_cast<unsigned>(field) & 1U) != 0;
  }
  [[nodiscard]] double Field(ir::CycleField field) const { return cycle_value[static_cast<std::size_t>(field)]; }
  [[nodiscard]] bool Has(std::uint32_t bits) const { return (has & bits) != 0; }
  void Clear() {
    has = 0;
    scaled = 0;
    rounded_words = 0;
    cycle_fields = 0;
    cycle_scaled = 0;
    cycle_rounded = 0;
    scaled_axes = 0;
    scaled_centers = 0;
    rounded_centers = 0;
    factors = 0;
    scaled_factors = 0;
    axes = 0;
    rounded = 0;
    centers = 0;
    vias = 0;
  }
};

}  // namespace ncport::exec
