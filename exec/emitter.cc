#include "exec/emitter.h"

#include <cstring>
#include <utility>

#include "ir/length_units.h"

namespace ncport::exec {

Event& Emitter::Begin(EventKind kind) {
  event_.kind = kind;
  event_.plane = channel_.modal.plane;  // in force; an arc under a frame has its own
  event_.feed_mode = channel_.modal.feed_mode;
  event_.spindle = 0;
  event_.number = 0;
  event_.extension = 0;
  event_.value = 0;
  event_.per_revolution = false;
  event_.tool_waits = false;
  event_.tool_change = false;
  event_.one_block = false;
  event_.text = {};
  event_.code = {};
  event_.block = session_.block;
  event_.frames = frames_;
  event_.added = session_.block.Valid() && (session_.module.blocks[session_.block].flags & ir::Block::kAdded) != 0;
  return event_;
}

Event& Emitter::BeginMotion(EventKind kind, const double* from) {
  Begin(kind);
  event_.full_circle = false;
  event_.turns = 0;
  event_.feed = 0;
  event_.start_angle = 0;
  event_.change = 0;
  event_.diameter_active =
      channel_.modal.diameter == ir::Diameter::kDiameter || channel_.modal.diameter == ir::Diameter::kDiameterAbsolute;
  event_.inch = ir::LengthsAreInches(channel_.modal.units);
  event_.known_axes = channel_.programmed & channel_.base_known;
  std::memcpy(event_.position, channel_.base, sizeof event_.position);
  std::memcpy(event_.from, from, sizeof event_.from);
  return event_;
}

void Emitter::Send(const Event& event) {
  if (session_.halted) return;  // the block has failed: nothing of it happens any more
  if (!holding_) {
    SendNow(event);
    return;
  }
  if (waiting_.size() >= kMaxWaiting) {
    session_.Refuse(diag::Code::kCornerWaits, kMaxWaiting);
    return;
  }
  Waiting& kept = waiting_.emplace_back(Waiting{event, std::string(event.text), std::string(event.code)});
  kept.event.frames = nullptr;  // the calls may have returned when it is handed out
}

void Emitter::SendNow(const Event& event) {
  if (event.kind <= EventKind::kRapidMachine || event.kind == EventKind::kProbe || event.kind == EventKind::kReference)
    moved_ = true;
  if (sink_.OnEvent(event) || session_.halted) return;
  session_.halted = true;
  session_.outcome = Outcome::kStopped;
}

void Emitter::Release() {
  holding_ = false;
  const std::vector<Waiting> waiting = std::exchange(waiting_, {});
  for (const Waiting& kept : waiting) {
    Event event = kept.event;
    event.text = kept.text;
    event.code = kept.code;
    SendNow(event);
    if (session_.outcome == Outcome::kStopped) return;
  }
}

}  // namespace ncport::exec
