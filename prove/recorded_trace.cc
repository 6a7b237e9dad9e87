#include "prove/recorded_trace.h"

#include <algorithm>
#include <iterator>

#include "exec/arc_geometry.h"
#include "exec/frame.h"

namespace ncport::prove {

using exec::EventKind;

/// Additional full turns as circles of their own, as a control without a word for them runs them: the other axes run
/// evenly over the whole angle.
bool RecordedTrace::OnEvent(const exec::Event& event) {
  if (event.kind != EventKind::kArc || event.turns == 0) return Keep(event);
  const exec::PlaneAxes axes = exec::AxesOf(event.plane);
  const exec::Point start{event.from[axes.first], event.from[axes.second]};
  const exec::Point end{event.position[axes.first], event.position[axes.second]};
  const double sweep =
      event.full_circle ? 360 : exec::SweepOf(start, end, {event.center[0], event.center[1]}, event.clockwise);
  const double whole = 360.0 * event.turns + sweep;
  exec::Event part = event;
  part.turns = 0;
  part.full_circle = true;
  for (std::uint32_t turn = 1; turn <= event.turns; ++turn) {
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      const bool moved = (event.moved_axes >> axis & 1U) != 0 && axis != axes.first && axis != axes.second;
      const double way = moved ? event.position[axis] - event.from[axis] : 0;
      part.position[axis] = event.from[axis] + way * 360.0 * turn / whole;
      if (!moved && axis != axes.first && axis != axes.second) part.position[axis] = event.position[axis];
    }
    if (!Keep(part)) return false;
    std::copy(std::begin(part.position), std::end(part.position), part.from);
  }
  exec::Event last = event;
  last.turns = 0;
  std::copy(std::begin(part.from), std::end(part.from), last.from);
  return Keep(last);
}

bool RecordedTrace::Keep(const exec::Event& event) {
  if (events_.size() >= max_events_) {
    full_ = true;
    return false;
  }
  exec::Event& kept = events_.emplace_back(event);
  kept.text = texts_.View(texts_.Intern(event.text));
  kept.code = texts_.View(texts_.Intern(event.code));
  kept.frames = nullptr;  // valid during the call only
  return true;
}

void RecordedTrace::Clear() {
  events_.clear();
  full_ = false;
}

bool IsMotion(EventKind kind) {
  switch (kind) {
    case EventKind::kRapid:
    case EventKind::kLine:
    case EventKind::kArc:
    case EventKind::kThread:
    case EventKind::kTap:
    case EventKind::kRapidMachine:
    case EventKind::kReference:
    case EventKind::kProbe:
      return true;
    default:
      return false;
  }
}

bool IsCutting(EventKind kind) {
  return kind == EventKind::kLine || kind == EventKind::kArc || kind == EventKind::kThread || kind == EventKind::kTap;
}

}  // namespace ncport::prove
