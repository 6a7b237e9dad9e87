// What two motions have to agree in: end points, arcs, threads, feeds, each within the error of the words of both
// sides.
#include <algorithm>
#include <cmath>

#include "prove/comparer.h"

namespace ncport::prove {

using exec::Event;
using exec::EventKind;

namespace {

constexpr double kRelative = 1e-6;

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

/// The first fixed point of one language is the reference point of another (sinumerik-12.2).
bool IsFirst(const Event& event) {
  return event.number == static_cast<std::uint32_t>(ir::ReferenceKind::kReference) ||
         event.number == static_cast<std::uint32_t>(ir::ReferenceKind::kFixedPoint);
}

}  // namespace

bool Comparer::SamePoint(const Event& a, const Event& b) const {
  return a.number == b.number || (options_.maps.cross_language && IsFirst(a) && IsFirst(b));
}

std::string AxisName(std::uint8_t axis) {
  constexpr std::string_view kNames = "XYZABCUVW";
  return axis < kNames.size() ? std::string(1, kNames[axis]) : fmt::format("axis {}", axis);
}

double Comparer::Allowed(const Event& a, const Event& b, std::uint8_t axis) const {
  const auto side = [axis](const Precision& precision, const Event& event) {
    const double error = WordErrorOf(precision);
    return precision.diameter_axis == axis && event.diameter_active ? error / 2 : error;
  };
  return options_.tolerance + side(options_.source, a) + side(options_.target, b);
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

void Comparer::CompareMotionDetails(const Event& a, const Event& b) {
  switch (a.kind) {
    case EventKind::kArc: {
      if (a.plane != b.plane) return Fail(&a, &b, "the arc lies in another plane");
      if (a.clockwise != b.clockwise) return Fail(&a, &b, "the arc turns the other way");
      if (a.turns != b.turns) return Fail(&a, &b, fmt::format("{} full turns became {}", a.turns, b.turns));
      if (a.full_circle != b.full_circle) return Fail(&a, &b, "a full circle on one side only");
      const double allowed = options_.tolerance + 2 * (WordErrorOf(options_.source) + WordErrorOf(options_.target));
      for (int i = 0; i < 2; ++i) {
        if (!(std::fabs(a.center[i] - b.center[i]) <= allowed)) {
          return Fail(&a, &b,
                      fmt::format("the centre ({:.6f},{:.6f}) became ({:.6f},{:.6f})", a.center[0], a.center[1],
                                  b.center[0], b.center[1]));
        }
      }
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
