#include "prove/recorded_trace.h"

namespace ncport::prove {

using exec::EventKind;

bool RecordedTrace::OnEvent(const exec::Event& event) {
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
