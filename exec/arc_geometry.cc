#include "exec/arc_geometry.h"

#include <cmath>

#include "ir/ops/trigonometry.h"

namespace ncport::exec {
namespace {

constexpr double kSamePoint = 1e-9;  // mm
constexpr double kPi = 3.14159265358979323846;

double Distance(Point a, Point b) { return std::hypot(a.u - b.u, a.v - b.v); }

Arc Fault(ArcFault fault) {
  Arc arc;
  arc.fault = fault;
  return arc;
}

/// Centre at `height` from the middle of the chord, to the left of the way from start to end (negative: to the right).
Arc OverChord(Point start, Point end, double height, bool clockwise) {
  const double chord = Distance(start, end);
  Arc arc;
  arc.clockwise = clockwise;
  arc.end = end;
  arc.center = {(start.u + end.u) / 2 - (end.v - start.v) / chord * height,
                (start.v + end.v) / 2 + (end.u - start.u) / chord * height};
  arc.start_radius = Distance(start, arc.center);
  arc.end_radius = arc.start_radius;
  return arc;
}

}  // namespace

Arc ArcByRadius(Point start, Point end, double radius, bool clockwise, const ArcTolerance& tolerance) {
  const double half = Distance(start, end) / 2;
  if (half <= kSamePoint) return Fault(ArcFault::kNoEnd);
  double size = std::fabs(radius);
  if (size < half) {
    if (half - size > std::fmax(tolerance.length, tolerance.factor * size)) return Fault(ArcFault::kRadiusTooSmall);
    size = half;
  }
  const double height = std::sqrt(std::fmax(0.0, (size - half) * (size + half)));
  // The way turns to its centre: counter-clockwise has it on the left, unless the arc is the long one.
  const bool left = clockwise == (radius < 0);
  return OverChord(start, end, left ? height : -height, clockwise);
}

Arc ArcByCenter(Point start, Point end, Point center, bool clockwise, const ArcTolerance& tolerance) {
  Arc arc;
  arc.clockwise = clockwise;
  arc.end = end;
  arc.center = center;
  arc.start_radius = Distance(start, center);
  arc.end_radius = Distance(end, center);
  if (arc.start_radius <= kSamePoint || arc.end_radius <= kSamePoint) {
    arc.fault = ArcFault::kCenterOnPoint;
    return arc;
  }
  const double difference = std::fabs(arc.start_radius - arc.end_radius);
  if (difference > std::fmax(tolerance.length, tolerance.factor * arc.start_radius)) {
    arc.fault = ArcFault::kRadiiDiffer;
    return arc;
  }
  const double chord = Distance(start, end);
  if (!tolerance.correct || difference <= kSamePoint || chord <= kSamePoint) return arc;
  // The nearest point of the perpendicular bisector.
  const double along = ((center.u - (start.u + end.u) / 2) * (end.u - start.u) +
                        (center.v - (start.v + end.v) / 2) * (end.v - start.v)) /
                       chord;
  arc.center = {center.u - along * (end.u - start.u) / chord, center.v - along * (end.v - start.v) / chord};
  const double turn =
      std::atan2((center.u - start.u) * (arc.center.v - start.v) - (center.v - start.v) * (arc.center.u - start.u),
                 (center.u - start.u) * (arc.center.u - start.u) + (center.v - start.v) * (arc.center.v - start.v));
  if (tolerance.angle > 0 && std::fabs(turn) * 180 / kPi > tolerance.angle) arc.fault = ArcFault::kRadiiDiffer;
  return arc;
}

Arc ArcByAngle(Point start, Point end, double degrees, bool clockwise) {
  if (!(degrees > 0 && degrees < 360)) return Fault(ArcFault::kBadAngle);
  const double chord = Distance(start, end);
  if (chord <= kSamePoint) return Fault(ArcFault::kNoEnd);
  // Height of the centre over the chord; negative behind it when the angle is over 180 degrees.
  const double sine = ir::ops::Sin(degrees / 2);
  const double height = chord / 2 * ir::ops::Cos(degrees / 2) / sine;
  return OverChord(start, end, clockwise ? -height : height, clockwise);
}

Arc ArcByCenterAndAngle(Point start, Point center, double degrees, bool clockwise) {
  if (!(degrees > 0 && degrees <= 360)) return Fault(ArcFault::kBadAngle);
  Arc arc;
  arc.clockwise = clockwise;
  arc.center = center;
  arc.start_radius = Distance(start, center);
  arc.end_radius = arc.start_radius;
  if (arc.start_radius <= kSamePoint) {
    arc.fault = ArcFault::kCenterOnPoint;
    return arc;
  }
  const double angle = clockwise ? -degrees : degrees;
  const double c = ir::ops::Cos(angle);
  const double s = ir::ops::Sin(angle);
  const double u = start.u - center.u;
  const double v = start.v - center.v;
  arc.end = degrees == 360 ? start : Point{center.u + c * u - s * v, center.v + s * u + c * v};
  return arc;
}

Arc ArcThrough(Point start, Point via, Point end) {
  const double bu = via.u - start.u, bv = via.v - start.v;
  const double cu = end.u - start.u, cv = end.v - start.v;
  const double cross = bu * cv - bv * cu;
  const double b2 = bu * bu + bv * bv;
  const double c2 = cu * cu + cv * cv;
  if (c2 <= kSamePoint * kSamePoint || b2 <= kSamePoint * kSamePoint) return Fault(ArcFault::kNoEnd);
  if (std::fabs(cross) <= 1e-12 * std::sqrt(b2 * c2)) return Fault(ArcFault::kOnLine);
  Arc arc;
  arc.end = end;
  arc.center = {start.u + (cv * b2 - bv * c2) / (2 * cross), start.v + (bu * c2 - cu * b2) / (2 * cross)};
  arc.clockwise = cross < 0;
  arc.start_radius = Distance(start, arc.center);
  arc.end_radius = Distance(end, arc.center);
  return arc;
}

Arc ArcByTangent(Point start, Point direction, Point end) {
  const double size = std::hypot(direction.u, direction.v);
  const double du = direction.u / size, dv = direction.v / size;
  const double cu = end.u - start.u, cv = end.v - start.v;
  const double chord = std::hypot(cu, cv);
  if (chord <= kSamePoint) return Fault(ArcFault::kNoEnd);
  const double across = du * cv - dv * cu;  // > 0: the end lies to the left
  if (std::fabs(across) <= 1e-12 * chord) {
    if (du * cu + dv * cv < 0) return Fault(ArcFault::kOnLine);  // straight back
    Arc arc;
    arc.line = true;
    arc.end = end;
    return arc;
  }
  const double radius = chord * chord / (2 * across);  // signed: to the left
  Arc arc;
  arc.end = end;
  arc.center = {start.u - dv * radius, start.v + du * radius};
  arc.clockwise = across < 0;
  arc.start_radius = std::fabs(radius);
  arc.end_radius = arc.start_radius;
  return arc;
}

Point DirectionAt(Point point, Point center, bool clockwise) {
  const double u = point.u - center.u, v = point.v - center.v;
  const double radius = std::hypot(u, v);
  const double sign = clockwise ? -1 : 1;
  return {-v / radius * sign, u / radius * sign};
}

double SweepOf(Point start, Point end, Point center, bool clockwise) {
  const double from = std::atan2(start.v - center.v, start.u - center.u);
  const double to = std::atan2(end.v - center.v, end.u - center.u);
  double sweep = (clockwise ? from - to : to - from) * 180 / kPi;
  if (sweep < 0) sweep += 360;
  return sweep;
}

}  // namespace ncport::exec
