// What the generator knows of the machine at one place of a program, whatever way led there: the same on all ways, or
// not known. Words are then written so that they mean one thing.
#pragma once

#include <cstdint>

#include "ir/modes.h"

namespace ncport::tests::random {

/// Parts of the state that loops keep or give up together.
enum Group : std::uint32_t {
  kMotionGroup = 1U << 0U,
  kPlaneGroup = 1U << 1U,
  kDistanceGroup = 1U << 2U,
  kUnitsGroup = 1U << 3U,
  kFeedGroup = 1U << 4U,  // feed mode, speed mode, and whether a feed is in force
  kDiameterGroup = 1U << 5U,
  kFrameGroup = 1U << 6U,
  kPathGroup = 1U << 7U,
  kOffsetGroup = 1U << 8U,
  kAllGroups = (1U << 9U) - 1,
};

/// Rotation of the programmable frame: arcs need their plane unturned.
enum class Turned : std::uint8_t { kNo, kInXY, kInZX, kInYZ, kUnknown };

struct Knowledge {
  ir::ModalState modes;  // kUnknown: not one value here
  bool feed = false;     // a feed of the mode in force was written
  Turned turned = Turned::kUnknown;
  bool frame_clear = false;  // no programmable frame at all
  std::uint32_t fixed = 0;   // groups that no word of the language changes, or none here: always known
  std::uint16_t placed = 0;  // bit per axis whose position follows from words of this program on every way here

  /// Forgets the groups in `mask`.
  void Forget(std::uint32_t mask) {
    mask &= ~fixed;
    if ((mask & kMotionGroup) != 0) modes.motion = ir::Motion::kUnknown;
    if ((mask & kPlaneGroup) != 0) modes.plane = ir::Plane::kUnknown;
    if ((mask & kDistanceGroup) != 0) modes.distance = ir::Distance::kUnknown;
    if ((mask & kUnitsGroup) != 0) modes.units = ir::Units::kUnknown;
    if ((mask & kFeedGroup) != 0) {
      modes.feed_mode = ir::FeedMode::kUnknown;
      modes.speed_mode = ir::SpeedMode::kUnknown;
      feed = false;
    }
    if ((mask & kDiameterGroup) != 0) modes.diameter = ir::Diameter::kUnknown;
    if ((mask & kFrameGroup) != 0) {
      turned = Turned::kUnknown;
      frame_clear = false;
    }
    if ((mask & kPathGroup) != 0) modes.path = ir::PathMode::kUnknown;
    if ((mask & kOffsetGroup) != 0) modes.work_offset = {};
  }

  /// Groups in which the two differ.
  [[nodiscard]] std::uint32_t Differences(const Knowledge& other) const {
    std::uint32_t mask = 0;
    if (modes.motion != other.modes.motion) mask |= kMotionGroup;
    if (modes.plane != other.modes.plane) mask |= kPlaneGroup;
    if (modes.distance != other.modes.distance) mask |= kDistanceGroup;
    if (modes.units != other.modes.units) mask |= kUnitsGroup;
    if (modes.feed_mode != other.modes.feed_mode || modes.speed_mode != other.modes.speed_mode || feed != other.feed) {
      mask |= kFeedGroup;
    }
    if (modes.diameter != other.modes.diameter) mask |= kDiameterGroup;
    if (turned != other.turned || frame_clear != other.frame_clear) mask |= kFrameGroup;
    if (modes.path != other.modes.path) mask |= kPathGroup;
    if (modes.work_offset != other.modes.work_offset) mask |= kOffsetGroup;
    return mask;
  }

  /// What is known where two ways meet.
  void Join(const Knowledge& other) {
    Forget(Differences(other));
    feed = feed && other.feed;
    placed &= other.placed;
  }
};

}  // namespace ncport::tests::random
