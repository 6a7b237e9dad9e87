// What a machine does, one record per event, in the units of traces: mm, degrees, mm/min or mm/rev, 1/min or m/min,
// transverse axis as radius. Events are handed to a sink while the program runs; nothing is collected.
#pragma once

#include <cstdint>
#include <string_view>

#include "ir/machine.h"
#include "ir/modes.h"
#include "ir/module.h"

namespace ncport::exec {

enum class EventKind : std::uint8_t {
  kRapid,
  kLine,
  kArc,
  kThread,
  kTap,
  kRapidMachine,
  kReference,
  kProbe,
  kDwell,
  kSpindle,
  kSpindleSpeed,
  kSpindleSurface,
  kSpindleLimit,
  kSpindlePosition,
  kTool,
  kOffset,
  kComp,
  kWorkOffset,
  kPath,
  kAux,
  kMessage,
  kPrint,
  kStop,
  kOptionalStop,
  kAlarm,
  kEnd,
  kSetVariable,
  kData,  // data of the machine are written (G10): `text` is all of them; comparisons must know, traces leave it out
};

/// Spindles of a machine that a run can tell apart.
constexpr std::uint8_t kSpindles = 8;

enum class OffsetKind : std::uint8_t { kNumber, kEdge, kLength, kRadius, kNone };

/// Where an event comes from: the block, the calls that lead to it, the turns of the loops around it.
struct CallFrameView {
  const ir::BlockId* call_blocks = nullptr;  // outermost first
  std::uint32_t depth = 0;
  /// How often call_blocks[i] was reached in its call, from 1; entry [depth]: the block of the event. Null unless
  /// RunOptions::count_turns.
  const std::uint32_t* turns = nullptr;
};

struct Event {
  EventKind kind = EventKind::kEnd;
  ir::Plane plane = ir::Plane::kXY;
  ir::FeedMode feed_mode = ir::FeedMode::kPerMinute;
  ir::CutterComp comp = ir::CutterComp::kOff;
  ir::PathMode path = ir::PathMode::kExact;  // kPath; unknown: comparisons must know, traces leave the event out
  ir::SpindleState spindle_state = ir::SpindleState::kStop;
  OffsetKind offset = OffsetKind::kNone;
  bool clockwise = false;               // kArc
  bool diameter_active = false;         // trace prints Xr
  bool per_revolution = false;          // kDwell in revolutions
  bool inch = false;                    // of a motion: lengths of the block are inches, its words rounded as such
  bool full_circle = false;             // kArc that ends where it starts
  bool added = false;                   // from a block or word that a pass added
  bool tool_waits = false;              // kTool: it only stands ready until a tool change
  bool length_minus = false;            // kOffset, kLength: it is taken off, not added
  bool one_block = false;               // kPath: begin or end of an exact stop of one block
  bool tool_change = false;             // kAux: the tool that stands ready comes in
  std::uint8_t spindle = 0;             // below kSpindles; 0 = master
  std::uint8_t transverse_axis = 0xFF;  // that diameter words hold for; 0xFF = none
  std::uint16_t known_axes = 0;         // axes programmed so far in this run: written by traces
  std::uint16_t moved_axes = 0;         // axes that this block names
  std::uint32_t turns = 0;              // kArc: additional full turns
  std::uint32_t number = 0;             // tool, offset, M function; work offset number
  // Of a work offset (G54.1 P), of several reference points, or the decimals of a tool number as hundredths.
  std::uint32_t extension = 0;
  double position[ir::kMaxAxes] = {};  // end point; kReference: unused
  double from[ir::kMaxAxes] = {};      // start point, where known
  double center[2] = {};               // in the axis order of the plane
  double radius = 0;                   // kArc
  double value = 0;                    // dwell, speed, lead, start angle see below
  double feed = 0;                     // kLine, kArc, kProbe
  double start_angle = 0;              // kThread
  double change = 0;                   // kThread: change of lead per revolution
  std::string_view text;  // message, print, alarm text, tool name, variable name; valid during the call only
  std::string_view code;  // alarm code; kSetVariable: the value as text
  ir::AlarmClass alarm = ir::AlarmClass::kOther;
  ir::BlockId block;  // the block that caused it
  const CallFrameView* frames = nullptr;
};

/// Receives the events of a run in order. Returning false stops the run (output full, user break).
class EventSink {
 public:
  EventSink() = default;
  EventSink(const EventSink&) = delete;
  EventSink& operator=(const EventSink&) = delete;
  virtual ~EventSink() = default;
  virtual bool OnEvent(const Event& event) = 0;
};

}  // namespace ncport::exec
