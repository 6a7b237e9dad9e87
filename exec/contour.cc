#include "exec/contour.h"

#include <utility>

namespace ncport::exec {
namespace {

using ir::ChamferKind;

Element ElementOf(const Event& event, const PlaneAxes& axes) {
  Element element;
  element.start = {event.from[axes.first], event.from[axes.second]};
  element.end = {event.position[axes.first], event.position[axes.second]};
  element.arc = event.kind == EventKind::kArc;
  element.center = {event.center[0], event.center[1]};
  element.clockwise = event.clockwise;
  return element;
}

bool MovesIn(const Event& event, const PlaneAxes& axes) {
  return event.full_circle || event.position[axes.first] != event.from[axes.first] ||
         event.position[axes.second] != event.from[axes.second];
}

/// True if an axis besides those of the plane moves: a shortened element would not end where its depth says.
bool MovesOutOf(const Event& event, const PlaneAxes& axes) {
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if (axis != axes.first && axis != axes.second && (event.moved_axes & AxisBit(axis)) != 0 &&
        event.position[axis] != event.from[axis]) {
      return true;
    }
  }
  return false;
}

}  // namespace

void Contour::Element(const Event& event, const Wish& wish) {
  if (waiting_) {
    Event next = event;
    Join(next, wish);
    return;
  }
  if (!wish.active) {
    emitter_.Send(event);
    return;
  }
  first_ = event;
  first_.frames = nullptr;
  wish_ = wish;
  waiting_ = true;
  emitter_.Hold();
}

/// The first element goes out as it is.
void Contour::Drop() {
  waiting_ = false;
  emitter_.SendNow(first_);
  emitter_.Release();
}

void Contour::OtherMotion() {
  if (!waiting_) return;
  if (wish_.kind != ChamferKind::kRoundModal) {
    session_.Refuse(diag::Code::kCannotRun,
                    "a chamfer or rounding before a motion that is no line and no arc in the plane");
    return;
  }
  Drop();
}

void Contour::Finish() {
  if (!waiting_) return;
  const bool modal = wish_.kind == ChamferKind::kRoundModal;
  Drop();
  if (!modal) session_.Alarm(ir::AlarmClass::kGeometry, "no motion behind the chamfer or rounding");
}

void Contour::Abandon() {
  if (waiting_) emitter_.SendNow(first_);
  waiting_ = false;
}

void Contour::Join(Event& next, const Wish& wish) {
  const PlaneAxes axes = AxesOf(wish_.plane);
  const bool modal = wish_.kind == ChamferKind::kRoundModal;
  const auto pass_on = [&] {
    Drop();
    Element(next, wish);
  };
  if (!MovesIn(next, axes) || !MovesIn(first_, axes)) {
    if (modal) return pass_on();
    return session_.Refuse(diag::Code::kCannotRun, "a chamfer or rounding at a motion that does not move in the plane");
  }
  const bool out = MovesOutOf(first_, axes) || MovesOutOf(next, axes) || first_.full_circle || next.full_circle ||
                   (next.kind == EventKind::kArc && next.plane != wish_.plane) ||
                   (first_.kind == EventKind::kArc && first_.plane != wish_.plane);
  if (out)
    return session_.Refuse(diag::Code::kCannotRun, "a chamfer or rounding at a motion that is not flat in the plane");

  const exec::Element a = ElementOf(first_, axes);
  const exec::Element b = ElementOf(next, axes);
  const bool round = wish_.kind == ChamferKind::kRound || modal;
  const double leg = wish_.kind == ChamferKind::kLength ? LegOfChamfer(a, b, wish_.size) : wish_.size;
  const Corner corner = round ? RoundCorner(a, b, wish_.size) : CutCorner(a, b, leg);
  if (corner.fault == CornerFault::kSmooth) return pass_on();
  if (corner.fault != CornerFault::kNone) {
    waiting_ = false;  // the control looks ahead: the element before the corner does not run either
    return session_.Alarm(ir::AlarmClass::kGeometry,
                          corner.fault == CornerFault::kReversal
                              ? "chamfer or rounding between elements that run back on each other"
                              : "chamfer or rounding is longer than its element");
  }
  const auto put = [&](double* position, Point point) {
    position[axes.first] = point.u;
    position[axes.second] = point.v;
  };
  Event inserted = first_;
  put(first_.position, corner.first);
  put(inserted.from, corner.first);
  put(inserted.position, corner.second);
  put(next.from, corner.second);
  inserted.kind = round ? EventKind::kArc : EventKind::kLine;
  inserted.plane = wish_.plane;
  inserted.clockwise = corner.clockwise;
  inserted.center[0] = corner.center.u;
  inserted.center[1] = corner.center.v;
  inserted.radius = round ? wish_.size : 0;
  inserted.turns = 0;
  if (session_.machine.chamfer_feed_from_next) {
    inserted.feed = next.feed;
    inserted.feed_mode = next.feed_mode;
  }
  waiting_ = false;
  emitter_.SendNow(first_);
  emitter_.SendNow(inserted);
  emitter_.Release();
  Element(next, wish);
}

}  // namespace ncport::exec
