#include "backends/iso/flat_arc.h"

#include <cmath>
#include <numbers>

#include "backends/iso/flat_numbers.h"

namespace ncport::backends::iso {
namespace {

constexpr double kPi = std::numbers::pi;

double Sweep(double from0, double from1, double to0, double to1, bool clockwise) {
  double angle = std::atan2(to1, to0) - std::atan2(from1, from0);
  if (clockwise) angle = -angle;
  if (angle <= 0) angle += 2 * kPi;
  return angle;
}

}  // namespace

double SweepOf(const ExactArc& arc) {
  if (arc.full_circle) return 2 * kPi;
  return Sweep(arc.from[0] - arc.center[0], arc.from[1] - arc.center[1], arc.to[0] - arc.center[0],
               arc.to[1] - arc.center[1], arc.clockwise);
}

GridArc FitArc(const ExactArc& arc, const std::int64_t start[2], const std::int64_t end[2], const ArcGrid& grid,
               double tolerance) {
  GridArc result;
  const double s[2] = {static_cast<double>(start[0]) * grid.unit[0], static_cast<double>(start[1]) * grid.unit[1]};
  const double e[2] = {static_cast<double>(end[0]) * grid.unit[0], static_cast<double>(end[1]) * grid.unit[1]};
  const double scale = 1 / grid.increment;
  std::int64_t nearest[2];
  std::int64_t other[2];  // on the other side of the exact centre
  for (int i = 0; i < 2; ++i) {
    const double exact = arc.center[i] - s[i];
    nearest[i] = RoundToIncrements(exact, scale);
    other[i] = nearest[i] + (exact * scale > static_cast<double>(nearest[i]) ? 1 : -1);
  }

  // The nearest centre first; the other corners of its grid square only when the radii differ by more than an
  // increment.
  double least = INFINITY;
  for (int step = 0; step < 4; ++step) {
    const std::int64_t c0 = (step & 1) == 0 ? nearest[0] : other[0];
    const std::int64_t c1 = (step & 2) == 0 ? nearest[1] : other[1];
    const double i = static_cast<double>(c0) * grid.increment;
    const double j = static_cast<double>(c1) * grid.increment;
    const double start_radius = std::hypot(i, j);
    const double end_radius = std::hypot(e[0] - s[0] - i, e[1] - s[1] - j);
    const double difference = std::fabs(start_radius - end_radius);
    if (difference < least) {
      least = difference;
      result.center[0] = c0;
      result.center[1] = c1;
      result.start_radius = start_radius;
      result.end_radius = end_radius;
    }
    if (step == 0 && least <= grid.increment) break;
  }

  if (arc.full_circle) {
    // No larger than an increment: a circle without a radius.
    if (result.start_radius == 0) result.kind = GridArc::Kind::kLine;
  } else {
    // Rounding moves each end by less than an increment. Only where the ends are that near can an arc become a full
    // circle, or the end come to lie on the other side of the start.
    const double chord = std::hypot(e[0] - s[0], e[1] - s[1]);
    if (chord <= 2 * grid.increment) {
      const double sweep = SweepOf(arc);
      const double i = static_cast<double>(result.center[0]) * grid.increment;
      const double j = static_cast<double>(result.center[1]) * grid.increment;
      const bool closed = start[0] == end[0] && start[1] == end[1];
      const double written = closed ? 2 * kPi : Sweep(-i, -j, e[0] - s[0] - i, e[1] - s[1] - j, arc.clockwise);
      const bool tiny = result.start_radius == 0;
      if (tiny || std::fabs(written - sweep) * result.start_radius > 3 * grid.increment) {
        result.kind = sweep < kPi || tiny ? GridArc::Kind::kLine : GridArc::Kind::kBroken;
        return result;
      }
    }
  }
  if (least > tolerance) result.kind = GridArc::Kind::kBroken;
  return result;
}

}  // namespace ncport::backends::iso
