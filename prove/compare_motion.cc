// What two motions have to agree in: end points, arcs, threads, feeds, each within the error of the words of both
// sides.
#include <algorithm>
#include <cmath>
#include <optional>

#include "exec/arc_geometry.h"
#include "exec/frame.h"
#include "ir/axis_names.h"
#include "prove/comparer.h"

namespace ncport::prove {

using exec::Event;
using exec::EventKind;

namespace {

constexpr double kRelative = 1e-6;
constexpr double kInchWord = 2.54;  // 0.0001 inch against 0.001 mm (fanuc-4.4)

double WordErrorOf(const Precision& precision) {
  switch (precision.word_error) {
    case ir::WordError::kNone:
      return 0;
    case ir::WordError::kRound:
      return precision.increment / 2;
    case ir::WordError::kTruncate:
      return precision.increment;
  }
  return 0;
}

/// The centre of an arc as a control leaves it that moves it along the chord until the radii at both ends agree. None
/// where they differ by more than `radii` or it would move by more than `most`.
std::optional<exec::Point> Moved(const Event& arc, double radii, double most) {
  const exec::PlaneAxes axes = exec::AxesOf(arc.plane);
  const exec::Point start{arc.from[axes.first], arc.from[axes.second]};
  const exec::Point end{arc.position[axes.first], arc.position[axes.second]};
  const exec::Point center{arc.center[0], arc.center[1]};
  const double u = end.u - start.u, v = end.v - start.v;
  const double chord = std::hypot(u, v);
  const double difference =
      std::hypot(start.u - center.u, start.v - center.v) - std::hypot(end.u - center.u, end.v - center.v);
  if (!(chord > 0) || !(std::fabs(difference) <= radii)) return std::nullopt;
  const double along = ((center.u - (start.u + end.u) / 2) * u + (center.v - (start.v + end.v) / 2) * v) / chord;
  if (!(std::fabs(along) <= most)) return std::nullopt;
  return exec::Point{center.u - along * u / chord, center.v - along * v / chord};
}

/// Which one of the points of its kind: the first fixed point and the second reference point need no number.
std::uint32_t PointNumber(const Event& event) {
  if (event.extension != 0) return event.extension;
  return event.number == static_cast<std::uint32_t>(ir::ReferenceKind::kSecondReference) ? 2 : 1;
}

/// The first fixed point of one language is the reference point of another (sinumerik-12.2).
bool IsFirst(const Event& event) {
  return event.number == static_cast<std::uint32_t>(ir::ReferenceKind::kReference) ||
         (event.number == static_cast<std::uint32_t>(ir::ReferenceKind::kFixedPoint) && PointNumber(event) == 1);
}

}  // namespace

bool Comparer::SamePoint(const Event& a, const Event& b) const {
  return (a.number == b.number && PointNumber(a) == PointNumber(b)) ||
         (options_.maps.cross_language && IsFirst(a) && IsFirst(b));
}

std::string AxisName(std::uint8_t axis) {
  return axis < ir::kLetterAxes ? std::string(1, ir::kAxisLetters[axis]) : fmt::format("axis {}", axis);
}

double Comparer::Allowed(const Event& a, const Event& b, std::uint8_t axis) const {
  const auto side = [axis](const Precision& precision, const Event& event, std::uint16_t inch) {
    const double error = WordErrorOf(precision) * (!ir::IsRotary(axis) && (inch >> axis & 1U) != 0 ? kInchWord : 1);
    return precision.diameter_axis == axis && event.diameter_active ? error / 2 : error;
  };
  return options_.tolerance + side(options_.source, a, source_inch_) + side(options_.target, b, target_inch_);
}

void Comparer::CompareNumber(const Event& a, const Event& b, double x, double y, std::string_view what) {
  const double allowed = kRelative * std::max({1.0, std::fabs(x), std::fabs(y)}) + WordErrorOf(options_.source) +
                         WordErrorOf(options_.target);
  if (!(std::fabs(x - y) <= allowed)) Fail(&a, &b, fmt::format("{} {:.10g} became {:.10g}", what, x, y));
}

void Comparer::CompareSpeed(const Event& a, const Event& b, double x, double y, std::string_view what) {
  const double words = options_.source.speed_error + options_.target.speed_error;
  if (std::fabs(x - y) > words) CompareNumber(a, b, x, y, what);
}

void Comparer::NoteLonely(const Event& event, std::uint16_t axes, std::array<std::optional<double>, ir::kMaxAxes>& seen,
                          std::uint16_t& moving) {
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((axes >> axis & 1U) == 0) continue;
    if (!seen[axis]) {
      seen[axis] = event.position[axis];
    } else if (std::fabs(*seen[axis] - event.position[axis]) > options_.tolerance) {
      moving = static_cast<std::uint16_t>(moving | (1U << axis));
    }
  }
}

void Comparer::ComparePositions(const Event& a, const Event& b) {
  const auto note_unit = [](std::uint16_t& inch, const Event& event) {
    inch = static_cast<std::uint16_t>(event.inch ? inch | event.moved_axes : inch & ~event.moved_axes);
  };
  note_unit(source_inch_, a);
  note_unit(target_inch_, b);
  const std::uint16_t both = a.known_axes & b.known_axes;
  common_axes_ = static_cast<std::uint16_t>(common_axes_ | both);
  // An axis that an added block moved stands elsewhere until the program names it: allowed for rapids only.
  const std::uint16_t away =
      a.kind == EventKind::kRapid
          ? static_cast<std::uint16_t>((target_.Dirty() & ~b.moved_axes) | (source_.Dirty() & ~a.moved_axes))
          : std::uint16_t{0};
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if (((both & ~away) >> axis & 1U) == 0) continue;
    if (!(std::fabs(a.position[axis] - b.position[axis]) <= Allowed(a, b, axis))) {
      Fail(&a, &b,
           fmt::format("{} is {:.6f} in the source and {:.6f} in the target", AxisName(axis), a.position[axis],
                       b.position[axis]));
      return;
    }
  }
  NoteLonely(a, static_cast<std::uint16_t>(a.known_axes & ~b.known_axes), lonely_source_, lonely_source_moving_);
  NoteLonely(b, static_cast<std::uint16_t>(b.known_axes & ~a.known_axes), lonely_target_, lonely_target_moving_);
}

/// Words that are rounded leave an arc with two radii. One control keeps the centre as it is written, another moves it
/// along the chord, by the difference times radius over chord: the kept one is moved likewise then. A difference that
/// rounding does not explain, or a way longer than the tolerance of circles, is none of the words (contracts section
/// 9).
void Comparer::CompareCenters(const Event& a, const Event& b) {
  const double words =
      WordErrorOf(options_.source) * (a.inch ? kInchWord : 1) + WordErrorOf(options_.target) * (b.inch ? kInchWord : 1);
  const double allowed = options_.tolerance + 2 * words;
  const auto agree = [&](const exec::Point& x, const exec::Point& y) {
    return std::fabs(x.u - y.u) <= allowed && std::fabs(x.v - y.v) <= allowed;
  };
  exec::Point source{a.center[0], a.center[1]}, target{b.center[0], b.center[1]};
  if (agree(source, target)) return;
  const bool one_moves = (options_.source.center_moves > 0) != (options_.target.center_moves > 0);
  if (one_moves && !a.full_circle) {
    // Start, end and centre, each off by a word on two axes; the centre counts from the start.
    const double radii = options_.tolerance + 4 * std::sqrt(2.0) * words;
    const double most = std::max(options_.source.center_moves, options_.target.center_moves);
    const bool source_keeps = options_.source.center_moves == 0;
    const std::optional<exec::Point> moved = Moved(source_keeps ? a : b, radii, most);
    if (moved && agree(*moved, source_keeps ? target : source)) {
      ++result_.centers_moved;
      return;
    }
  }
  Fail(&a, &b,
       fmt::format("the centre ({:.6f},{:.6f}) became ({:.6f},{:.6f})", source.u, source.v, target.u, target.v));
}

void Comparer::CompareMotionDetails(const Event& a, const Event& b) {
  switch (a.kind) {
    case EventKind::kArc: {
      if (a.plane != b.plane) return Fail(&a, &b, "the arc lies in another plane");
      if (a.clockwise != b.clockwise) return Fail(&a, &b, "the arc turns the other way");
      if (a.turns != b.turns) return Fail(&a, &b, fmt::format("{} full turns became {}", a.turns, b.turns));
      if (a.full_circle != b.full_circle) return Fail(&a, &b, "a full circle on one side only");
      CompareCenters(a, b);
      break;
    }
    case EventKind::kThread:
    case EventKind::kTap:
      CompareNumber(a, b, a.value, b.value, "the pitch");
      if (!Failed()) CompareNumber(a, b, a.start_angle, b.start_angle, "the start angle");
      if (!Failed()) CompareNumber(a, b, a.change, b.change, "the change of pitch");
      break;
    case EventKind::kReference:
      if (a.moved_axes != b.moved_axes) return Fail(&a, &b, "other axes go to the reference point");
      if (!SamePoint(a, b)) return Fail(&a, &b, "another reference point is approached");
      break;
    default:
      break;
  }
  if (Failed() || !(a.kind == EventKind::kLine || a.kind == EventKind::kArc || a.kind == EventKind::kProbe)) return;
  if (a.feed_mode != b.feed_mode)
    return Fail(&a, &b, "the feed has another unit (per minute, per revolution, inverse time)");
  CompareNumber(a, b, a.feed, b.feed, "the feed");
}

}  // namespace ncport::prove
