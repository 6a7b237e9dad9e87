// Hands events to the sink of the run, in order. While a corner waits for the next element of the contour, the events
// behind it wait too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exec/channel.h"
#include "exec/event.h"
#include "exec/session.h"

namespace ncport::exec {

class Emitter {
 public:
  Emitter(Session& session, Channel& channel, EventSink& sink) : session_(session), channel_(channel), sink_(sink) {
    event_.transverse_axis = session.machine.transverse_axis;
  }

  /// A fresh event of this kind from the present block.
  Event& Begin(EventKind kind);
  /// Fills what motions share: positions, masks, diameter, feed mode; `from` is the position before.
  Event& BeginMotion(EventKind kind, const double* from);
  /// Hands the event out, or keeps it while the corner waits.
  void Send(const Event& event);
  /// Past the corner: straight to the sink.
  void SendNow(const Event& event);

  /// From now on events wait, until Release hands them out.
  void Hold() { holding_ = true; }
  void Release();
  [[nodiscard]] bool Moved() const { return moved_; }
  void SetFrames(const CallFrameView* frames) { frames_ = frames; }

 private:
  static constexpr std::size_t kMaxWaiting = 10000;

  struct Waiting {
    Event event;
    std::string text;
    std::string code;
  };

  Session& session_;
  Channel& channel_;
  EventSink& sink_;
  Event event_;
  const CallFrameView* frames_ = nullptr;
  std::vector<Waiting> waiting_;
  bool holding_ = false;
  bool moved_ = false;
};

}  // namespace ncport::exec
