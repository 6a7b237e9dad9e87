#include "exec/corner.h"

#include <cmath>
#include <optional>

namespace ncport::exec {
namespace {

constexpr double kSmall = 1e-9;

Point operator+(Point a, Point b) { return {a.u + b.u, a.v + b.v}; }
Point operator-(Point a, Point b) { return {a.u - b.u, a.v - b.v}; }
Point operator*(Point a, double f) { return {a.u * f, a.v * f}; }
double Dot(Point a, Point b) { return a.u * b.u + a.v * b.v; }
double Cross(Point a, Point b) { return a.u * b.v - a.v * b.u; }
double Size(Point a) { return std::hypot(a.u, a.v); }
Point Left(Point a) { return {-a.v, a.u}; }

Point Direction(const Element& element, Point at) {
  if (element.arc) return DirectionAt(at, element.center, element.clockwise);
  const Point way = element.end - element.start;
  const double size = Size(way);
  return size == 0 ? Point{} : way * (1 / size);
}

/// True if a point that lies on the line or circle of the element lies between its ends.
bool Inside(const Element& element, Point point) {
  if (!element.arc) {
    const Point way = element.end - element.start;
    const double size = Size(way);
    const double along = Dot(point - element.start, way) / size;
    return along >= -kSmall && along <= size + kSmall;
  }
  const double radius = Size(element.start - element.center);
  const double whole = SweepOf(element.start, element.end, element.center, element.clockwise);
  const double part = SweepOf(element.start, point, element.center, element.clockwise);
  const double slack = kSmall / radius * 60;
  return part <= (whole == 0 ? 360 : whole) + slack || part >= 360 - slack;
}

/// The path of points at a signed distance to the left of an element: a line or a circle.
struct Offset {
  bool arc = false;
  Point point;  // of a line; centre of a circle
  Point direction;
  double radius = 0;
};

Offset OffsetOf(const Element& element, double left) {
  Offset offset;
  offset.arc = element.arc;
  if (element.arc) {
    offset.point = element.center;
    const double radius = Size(element.start - element.center);
    offset.radius = element.clockwise ? radius + left : radius - left;
  } else {
    offset.direction = Direction(element, element.end);
    offset.point = element.start + Left(offset.direction) * left;
  }
  return offset;
}

/// Common point nearest to `near`.
std::optional<Point> Intersect(const Offset& a, const Offset& b, Point near) {
  if (a.arc && !b.arc) return Intersect(b, a, near);
  Point candidates[2];
  if (!a.arc && !b.arc) {
    const double cross = Cross(a.direction, b.direction);
    if (std::fabs(cross) < 1e-12) return std::nullopt;
    return a.point + a.direction * (Cross(b.point - a.point, b.direction) / cross);
  }
  if (!a.arc) {
    const double along = Dot(b.point - a.point, a.direction);
    const Point foot = a.point + a.direction * along;
    const double away = Size(b.point - foot);
    const double square = b.radius * b.radius - away * away;
    if (square < -kSmall) return std::nullopt;
    const double half = std::sqrt(std::fmax(0, square));
    candidates[0] = foot + a.direction * half;
    candidates[1] = foot - a.direction * half;
  } else {
    const Point between = b.point - a.point;
    const double distance = Size(between);
    if (distance < kSmall) return std::nullopt;
    const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
    const double square = a.radius * a.radius - along * along;
    if (square < -kSmall) return std::nullopt;
    const double half = std::sqrt(std::fmax(0, square));
    const Point unit = between * (1 / distance);
    candidates[0] = a.point + unit * along + Left(unit) * half;
    candidates[1] = a.point + unit * along - Left(unit) * half;
  }
  return Size(candidates[0] - near) <= Size(candidates[1] - near) ? candidates[0] : candidates[1];
}

/// Where the circle around `center` touches the element.
Point Touch(const Element& element, Point center) {
  if (!element.arc) {
    const Point way = Direction(element, element.end);
    return element.start + way * Dot(center - element.start, way);
  }
  const Point out = center - element.center;
  return element.center + out * (Size(element.start - element.center) / Size(out));
}

Corner Fault(CornerFault fault) {
  Corner corner;
  corner.fault = fault;
  return corner;
}

/// Sine and cosine of the change of direction at the corner.
struct Bend {
  double sine, cosine;
};
Bend BendOf(const Element& first, const Element& second) {
  const Point in = Direction(first, first.end);
  const Point out = Direction(second, second.start);
  return {Cross(in, out), Dot(in, out)};
}

CornerFault FaultOf(const Bend& bend) {
  if (std::fabs(bend.sine) > kSmall) return CornerFault::kNone;
  return bend.cosine >= 0 ? CornerFault::kSmooth : CornerFault::kReversal;
}

/// Point of the element at a straight distance from its end at the corner.
std::optional<Point> PointAt(const Element& element, bool from_end, double distance) {
  const Point corner = from_end ? element.end : element.start;
  if (!element.arc) {
    const Point way = Direction(element, element.end);
    return from_end ? corner - way * distance : corner + way * distance;
  }
  const double radius = Size(element.start - element.center);
  if (distance > 2 * radius) return std::nullopt;
  const double angle = 2 * std::asin(distance / (2 * radius)) * (element.clockwise == from_end ? 1 : -1);
  const Point arm = corner - element.center;
  return element.center +
         Point{arm.u * std::cos(angle) - arm.v * std::sin(angle), arm.u * std::sin(angle) + arm.v * std::cos(angle)};
}

}  // namespace

Corner RoundCorner(const Element& first, const Element& second, double radius) {
  const Bend bend = BendOf(first, second);
  if (const CornerFault fault = FaultOf(bend); fault != CornerFault::kNone) return Fault(fault);
  const double left = bend.sine > 0 ? radius : -radius;
  const Offset a = OffsetOf(first, left);
  const Offset b = OffsetOf(second, left);
  if ((a.arc && a.radius <= kSmall) || (b.arc && b.radius <= kSmall)) return Fault(CornerFault::kTooShort);
  const std::optional<Point> center = Intersect(a, b, first.end);
  if (!center.has_value()) return Fault(CornerFault::kTooShort);
  Corner corner;
  corner.center = *center;
  corner.clockwise = bend.sine < 0;
  corner.first = Touch(first, *center);
  corner.second = Touch(second, *center);
  if (!Inside(first, corner.first) || !Inside(second, corner.second)) corner.fault = CornerFault::kTooShort;
  return corner;
}

Corner CutCorner(const Element& first, const Element& second, double leg) {
  if (const CornerFault fault = FaultOf(BendOf(first, second)); fault != CornerFault::kNone) return Fault(fault);
  const std::optional<Point> from = PointAt(first, true, leg);
  const std::optional<Point> to = PointAt(second, false, leg);
  if (!from.has_value() || !to.has_value() || !Inside(first, *from) || !Inside(second, *to))
    return Fault(CornerFault::kTooShort);
  Corner corner;
  corner.first = *from;
  corner.second = *to;
  return corner;
}

double LegOfChamfer(const Element& first, const Element& second, double length) {
  const Bend bend = BendOf(first, second);
  if (FaultOf(bend) != CornerFault::kNone) return 0;
  // The inner angle is 180 degrees less the bend; sin of its half from the cosine of the bend.
  const double half_sine = std::sqrt(std::fmax(0, (1 + bend.cosine) / 2));
  return length / (2 * half_sine);
}

}  // namespace ncport::exec
