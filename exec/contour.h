// Joins the elements of a contour: a motion that asks for a chamfer or a rounding waits until the next element is
// known.
#pragma once

#include "exec/channel.h"
#include "exec/corner.h"
#include "exec/emitter.h"
#include "exec/event.h"
#include "exec/session.h"
#include "ir/nodes.h"

namespace ncport::exec {

class Contour {
 public:
  Contour(Session& session, Emitter& emitter) : session_(session), emitter_(emitter) {}

  struct Wish {
    bool active = false;
    ir::ChamferKind kind = ir::ChamferKind::kLength;
    double size = 0;                   // mm
    ir::Plane plane = ir::Plane::kXY;  // of the trace coordinates
  };

  /// Hands a line or arc on. `wish` is what its block asks for at its end.
  void Element(const Event& event, const Wish& wish);
  /// Any other motion. A rounding that holds by mode is left out; one that was asked for in the block is refused.
  void OtherMotion();
  /// Program end: nothing will follow.
  void Finish();
  /// The run ends in an alarm: an element that waits goes out as it is.
  void Abandon();

 private:
  void Join(Event& next, const Wish& wish);
  void Drop();

  Session& session_;
  Emitter& emitter_;
  Event first_;
  Wish wish_;
  bool waiting_ = false;
};

}  // namespace ncport::exec
