// The state of the machine during a run as far as programs can see or change it.
#pragma once

#include <cstdint>
#include <string>

#include "exec/arc_geometry.h"
#include "exec/event.h"
#include "exec/frame.h"
#include "ir/modes.h"

namespace ncport::exec {

constexpr std::uint16_t AxisBit(std::uint8_t axis) { return static_cast<std::uint16_t>(1U << axis); }

/// The programmable frame of controls where shift, rotation, scale and mirror stand beside each other: the frame is
/// made from these whenever one of them changes. Coordinates in mm and degrees, transverse axis as radius.
struct FrameLayers {
  double shift[ir::kMaxAxes] = {};   // local shift
  double preset[ir::kMaxAxes] = {};  // shift by which the present position got new values
  bool rotates = false;
  std::uint8_t rotation_axis = 2;
  double rotation_center[3] = {};
  double angle = 0;
  bool scales = false;
  double scale_center[3] = {};
  double factor[3] = {1, 1, 1};
  std::uint16_t mirrored = 0;
  double mirror_at[ir::kMaxAxes] = {};
};

constexpr bool IsHole(ir::Cycle cycle) { return cycle >= ir::Cycle::kDrill && cycle <= ir::Cycle::kCrossBore; }

/// A canned cycle in force and the data that stay stored for it. Levels are workpiece coordinates in mm.
struct CycleState {
  ir::Cycle cycle = ir::Cycle::kNone;
  bool rigid = false;  // taps turn with their feed (M29), from the word for it until the cycles end
  bool initial_known = false, level_known = false, depth_known = false, step_known = false, dwell_known = false;
  double initial = 0;  // level of the drilling axis before the cycle
  double level = 0;
  double depth = 0;
  double step = 0;
  double dwell = 0;  // seconds
  double taper = 0;
  std::uint16_t ends_known = 0;  // turning: axes whose end is stored
  double end[3] = {};
};

struct Channel {
  ir::ModalState modal;

  // Position of the last programmed point. `base` is what traces show, `work` is the same point before the frame.
  double base[ir::kMaxAxes] = {};
  double work[ir::kMaxAxes] = {};
  double step_from[ir::kMaxAxes] = {};  // where increments start when they traverse a frame change (Machine)
  std::uint16_t base_known = 0;
  std::uint16_t work_known = 0;
  std::uint16_t uncertain = 0;  // last moved under another work offset or to a probe: good to show, not to compute with
  std::uint16_t programmed = 0;  // axes of the trace that the run has named
  Frame frame;
  FrameLayers layers;
  CycleState cycle;
  bool polar_words = false;  // words of the plane are radius and angle

  // Feed: mm/min, mm/rev or 1/min by the mode in which it was written.
  bool feed_known = false;
  ir::FeedMode feed_mode = ir::FeedMode::kUnknown;
  double feed = 0;
  double thread_change = 0;  // of the lead, per revolution

  // Spindle 0 is the master spindle. Spindle 1 by its number is the master too: no program that is run makes another
  // one the master.
  static constexpr std::uint8_t SpindleByNumber(std::uint8_t number) { return number == 1 ? std::uint8_t{0} : number; }
  struct Spindle {
    ir::SpindleState state = ir::SpindleState::kUnknown;
    bool speed_known = false;
    double speed = 0;            // 1/min, or m/min in constant surface speed
    bool surface_known = false;  // the last surface speed, m/min: a mode word without S brings it back
    double surface = 0;
    bool limit_known = false;
    double limit = 0;     // 1/min
    double position = 0;  // degrees
  };
  Spindle spindles[kSpindles];

  // Tool: of the last tool word, and the one in the spindle.
  bool prepared_known = false;
  double prepared_number = 0;
  std::string prepared_name;
  bool tool_known = false;
  double tool_number = 0;
  std::string tool_name;
  bool length_minus = false;  // the length offset that H selects is taken off
  bool edge_known = false;
  double edge = 0;

  // Polar words: pole in the plane of the workpiece system.
  Point pole;
  Point last_pole;
  bool polar_radius_known = false;
  bool polar_angle_known = false;
  double polar_radius = 0;
  double polar_angle = 0;

  // Direction at the end of the last motion in trace coordinates, for tangent arcs.
  bool direction_known = false;
  double direction[3] = {};

  double modal_rounding = 0;                             // RNDM, mm; 0 = off
  ir::CutterComp shown_comp = ir::CutterComp::kUnknown;  // side as traces show it: mirrors exchange it
};

}  // namespace ncport::exec
