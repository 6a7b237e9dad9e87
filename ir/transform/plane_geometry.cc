#include "ir/transform/plane_geometry.h"

#include <cmath>

#include "ir/builder.h"
#include "ir/ops/trigonometry.h"

namespace ncport::ir::transform {

namespace {

constexpr double kSamePoint = 1e-9;  // mm

/// a * x + b * y
LinearForm Mix(const Module& module, const LinearForm& x, double a, const LinearForm& y, double b) {
  return Sum(module, Sum(module, {}, x, a), y, b);
}

ExprId Bracketed(Module& module, ExprId expr) {
  if (OperandsOf(module.exprs[expr].op) == Operands::kLeaf) return expr;
  return ExprBuilder(module).Unary(ExprOp::kGroup, expr);
}

}  // namespace

PlanePoint CenterByOpening(const Module& module, const PlanePoint& way, double degrees, bool clockwise) {
  // The centre stands on the perpendicular in the middle of the chord, at half the chord times the cotangent of half
  // the angle: to the left of a counter-clockwise way, behind the chord (negative) from 180 degrees on.
  const double height = ops::Cos(degrees / 2) / ops::Sin(degrees / 2) / 2 * (clockwise ? -1 : 1);
  return {Mix(module, way.u, 0.5, way.v, -height), Mix(module, way.v, 0.5, way.u, height)};
}

std::optional<PlanePoint> CenterByRadius(double u, double v, double radius, bool clockwise) {
  const double chord = std::hypot(u, v);
  const double size = std::fabs(radius);
  if (chord <= kSamePoint || size < chord / 2) return std::nullopt;
  // To the left of the way for a short counter-clockwise arc.
  const double height = std::sqrt((size - chord / 2) * (size + chord / 2)) / chord;
  const double side = clockwise == (radius < 0) ? height : -height;
  return PlanePoint{{u / 2 - v * side, {}}, {v / 2 + u * side, {}}};
}

PlanePoint EndByOpening(const Module& module, const PlanePoint& center, double degrees, bool clockwise) {
  // center + turned(-center)
  const double c = ops::Cos(degrees);
  const double s = ops::Sin(degrees) * (clockwise ? -1 : 1);
  return {Mix(module, center.u, 1 - c, center.v, s), Mix(module, center.v, 1 - c, center.u, -s)};
}

PlanePoint PolarPoint(Module& module, const PlanePoint& pole, const LinearForm& radius, const LinearForm& angle) {
  if (angle.IsConstant()) {
    return {Sum(module, pole.u, radius, ops::Cos(angle.constant)),
            Sum(module, pole.v, radius, ops::Sin(angle.constant))};
  }
  ExprBuilder make(module);
  const ExprId degrees = ExprOf(module, angle);
  const auto part = [&](Function function) {
    const ExprId turned = make.Function(function, {degrees});
    if (radius.IsConstant()) return Sum(module, {}, FormOf(module, turned), radius.constant);
    const ExprId length = Bracketed(module, ExprOf(module, radius));
    return FormOf(module, make.Binary(ExprOp::kMultiply, length, turned));
  };
  const LinearForm along = part(Function::kCos);
  const LinearForm across = part(Function::kSin);
  return {Sum(module, pole.u, along), Sum(module, pole.v, across)};
}

std::optional<ThroughArc> ArcThroughPoints(double via_u, double via_v, double end_u, double end_v) {
  const double cross = via_u * end_v - via_v * end_u;
  const double via2 = via_u * via_u + via_v * via_v;
  const double end2 = end_u * end_u + end_v * end_v;
  if (via2 <= kSamePoint * kSamePoint || end2 <= kSamePoint * kSamePoint) return std::nullopt;
  if (std::fabs(cross) <= 1e-12 * std::sqrt(via2 * end2)) return std::nullopt;
  // + 0.0: no negative zero is printed.
  return ThroughArc{(end_v * via2 - via_v * end2) / (2 * cross) + 0.0,
                    (via_u * end2 - end_u * via2) / (2 * cross) + 0.0, cross < 0};
}

}  // namespace ncport::ir::transform
