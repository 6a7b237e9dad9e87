#include "prove/walk.h"

#include <algorithm>

namespace ncport::prove {

using exec::Event;
using exec::EventKind;
using exec::OffsetKind;

void Walk::TakeSpindle(const Event& event, Spindles& spindles) {
  SpindleNow& state = spindles[event.spindle];
  switch (event.kind) {
    case EventKind::kSpindle:
      state.sense = event.spindle_state;
      break;
    case EventKind::kSpindleSpeed:
      state.surface = false;
      state.speed = event.value;
      break;
    case EventKind::kSpindleSurface:
      state.surface = true;
      state.speed = event.value;
      break;
    case EventKind::kSpindleLimit:
      state.limit = event.value;
      break;
    default:
      break;
  }
}

/// Takes a selecting event into `now_`; true when it changes what the program itself selected.
bool Walk::TakeState(const Event& event) {
  const auto apply = [&](Selected& state) {
    const Selected before = state;
    switch (event.kind) {
      case EventKind::kTool:
        state.called_known = true;
        state.called = event.number;
        state.called_name = event.text;
        if (!event.tool_waits) state.TakeTool();
        return true;  // the same tool called twice is two calls
      case EventKind::kAux:
        if (event.tool_change) state.TakeTool();
        return true;
      case EventKind::kOffset:
        state.offset_known = true;
        state.offset_kind = event.offset;
        state.offset = event.offset == OffsetKind::kNone ? 0 : event.number;
        if (event.offset != OffsetKind::kRadius) {
          state.length = state.offset;
          state.length_minus = event.length_minus;
        }
        if (event.offset != OffsetKind::kLength) state.radius = state.offset;
        // Where none was selected, none more changes nothing.
        if (!before.offset_known) return state.offset_kind != OffsetKind::kNone;
        return before.offset_kind != state.offset_kind || before.offset != state.offset ||
               before.length_minus != state.length_minus;
      case EventKind::kWorkOffset:
        state.wcs_known = true;
        state.wcs = event.number;
        state.wcs_extension = event.extension;
        return !before.wcs_known || before.wcs != state.wcs || before.wcs_extension != state.wcs_extension;
      case EventKind::kComp:
        state.comp = event.comp;
        return before.comp != state.comp &&
               !(before.comp == ir::CutterComp::kUnknown && state.comp == ir::CutterComp::kOff);
      case EventKind::kPath:
        // Behind an exact stop of one block holds what held before it, be it the word of a block that was added.
        if (event.one_block && event.path == ir::PathMode::kExact) state.path_before = state.path;
        state.path = event.one_block && event.path != ir::PathMode::kExact ? state.path_before : event.path;
        return before.path != state.path;
      default:
        return true;
    }
  };
  apply(now_);
  // Added path words put back or name what was in force at the start: no word of the program chose it.
  if (event.kind == EventKind::kPath) {
    if (!start_path_) start_path_ = event.added ? event.path : ir::PathMode::kUnknown;
    if (event.added) own_.path = ir::PathMode::kUnknown;
  }
  return event.added ? false : apply(own_);
}

bool Walk::ToolAhead() const {
  for (std::size_t i = index_; i < events_.size(); ++i) {
    if (events_[i].kind == EventKind::kTool) return true;
    if (IsMotion(events_[i].kind) && !events_[i].added) return false;
  }
  return false;
}

void Walk::TakeAdded(const Event& event) {
  if (!IsMotion(event.kind)) return;
  dirty_ = static_cast<std::uint16_t>(dirty_ | event.moved_axes);
  if (motions_done_ == 0 || motions_left_ == 0 || tool_since_motion_ || ToolAhead()) return;
  if (!complaint_) complaint_ = "an added block moves between two motions of the program, away from any tool change";
}

/// A rapid by nothing on the way to the reference point: only some controls name a point on that way.
bool Walk::IsStepOfNothing(std::size_t index) const {
  const Event& event = events_[index];
  if (event.kind != EventKind::kRapid || event.added) return false;
  std::size_t behind = index + 1;
  while (behind < events_.size() && !IsMotion(events_[behind].kind)) ++behind;
  if (behind == events_.size()) return false;
  const Event& next = events_[behind];
  if (next.moved_axes != event.moved_axes) return false;
  // The program may stand still of its own before it: the same on both sides.
  if (next.kind != EventKind::kReference && !IsStepOfNothing(behind)) return false;
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((event.moved_axes >> axis & 1U) == 0) continue;
    std::size_t before = index;
    // Other axes may have gone where nobody knows.
    while (before-- > 0) {
      const Event& move = events_[before];
      if (!IsMotion(move.kind)) continue;
      const bool known = move.kind != EventKind::kReference && move.kind != EventKind::kRapidMachine;
      if (known && (move.known_axes >> axis & 1U) != 0 && move.position[axis] == event.position[axis]) break;
      if (known || (move.moved_axes >> axis & 1U) != 0) return false;
    }
    if (before >= index) return false;
  }
  return true;
}

const Event* Walk::Next() {
  for (; index_ < events_.size(); ++index_) {
    const Event& event = events_[index_];
    switch (event.kind) {
      case EventKind::kSpindle:
      case EventKind::kSpindleSpeed:
      case EventKind::kSpindleSurface:
      case EventKind::kSpindleLimit:
        if (event.kind == EventKind::kSpindleSurface && spindles_[event.spindle].limit < 0 && !event.added) {
          // A limit later in the same block is in force with it.
          bool follows = false;
          for (std::size_t i = index_ + 1; i < events_.size() && events_[i].block == event.block; ++i) {
            follows = follows || events_[i].kind == EventKind::kSpindleLimit;
          }
          const bool later = std::any_of(events_.begin() + static_cast<std::ptrdiff_t>(index_), events_.end(),
                                         [](const Event& e) { return e.kind == EventKind::kSpindleLimit; });
          if (!follows && later && !complaint_)
            complaint_ = "constant surface speed starts before its speed limit is set";
        }
        TakeSpindle(event, spindles_);
        if (!event.added) {
          if (spindle_block_ != event.block) before_block_ = own_spindles_;
          spindle_block_ = event.block;
          TakeSpindle(event, own_spindles_);
        }
        continue;
      case EventKind::kTool:
        // The offset of the tool that is in: a turret says it by its tool word, the other side by a word of its own.
        if (maps_.offset_words && !event.tool_waits && now_.tool_known && now_.tool == event.number &&
            now_.tool_name == event.text)
          continue;
        tool_since_motion_ = true;
        if (TakeState(event)) return &event;
        continue;
      case EventKind::kOffset:
        if (TakeState(event) && !maps_.tools_mapped) return &event;  // mapped offsets are compared as state at motions
        continue;
      case EventKind::kWorkOffset:
        TakeState(event);  // compared as state at motions and at the end
        continue;
      case EventKind::kComp:
        if (TakeState(event)) return &event;
        continue;
      case EventKind::kPath:
        TakeState(event);  // compared as state at motions and at the end
        continue;
      case EventKind::kMessage:
      case EventKind::kPrint:
        if (maps_.messages_lost || event.added) continue;
        return &event;
      case EventKind::kSetVariable:
        continue;
      case EventKind::kAux:
        if (event.tool_change) TakeState(event);
        if (event.number == 6 && event.text.empty()) now_.loaded = now_.tool;
        if (event.added) continue;
        if (!source_ && maps_.tool_change_added && event.number == 6) continue;
        if (source_) {
          const auto pair = std::find_if(maps_.aux.begin(), maps_.aux.end(),
                                         [&](const AuxPair& aux) { return aux.source == event.number; });
          if (pair != maps_.aux.end() && !pair->target.has_value()) continue;
        }
        return &event;
      case EventKind::kRapid:
        if (IsStepOfNothing(index_)) {
          --motions_left_;
          continue;
        }
        [[fallthrough]];
      default:
        if (event.added && event.kind != EventKind::kAlarm && event.kind != EventKind::kEnd) {
          TakeAdded(event);
          continue;
        }
        return &event;
    }
  }
  return nullptr;
}

}  // namespace ncport::prove
