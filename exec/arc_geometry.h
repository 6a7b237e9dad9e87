// Circles in a plane: centres from radius, opening angle, three points, tangent. Pure geometry, lengths in mm, angles
// in degrees; `clockwise` is seen against the third axis of the plane.
#pragma once

namespace ncport::exec {

struct Point {
  double u = 0;
  double v = 0;
};

enum class ArcFault : unsigned char {
  kNone,
  kRadiusTooSmall,  // for the distance of start and end
  kNoEnd,           // start and end are one point where two are needed
  kBadAngle,        // opening angle not in (0, 360)
  kRadiiDiffer,     // at start and end, by more than the tolerance
  kCenterOnPoint,   // centre at the start or end point
  kOnLine,          // three points on one line
};

struct Arc {
  Point center;
  Point end;
  bool clockwise = false;
  bool line = false;  // tangent arc that is a straight line
  ArcFault fault = ArcFault::kNone;
  double start_radius = 0;
  double end_radius = 0;
};

/// How far the radii of a centre may differ: `length` mm or `factor` times the start radius, whichever is larger; the
/// centre is then moved to the nearest place that fits both (`correct`), seen from the start by at most `angle` degrees
/// (0 = any).
struct ArcTolerance {
  double length = 0.01;
  double factor = 0.001;
  bool correct = true;
  double angle = 1.8;
};

/// Negative radius: the arc over 180 degrees.
Arc ArcByRadius(Point start, Point end, double radius, bool clockwise, const ArcTolerance& tolerance);
Arc ArcByCenter(Point start, Point end, Point center, bool clockwise, const ArcTolerance& tolerance);
/// Chord and opening angle.
Arc ArcByAngle(Point start, Point end, double degrees, bool clockwise);
/// Centre and opening angle: the end is computed.
Arc ArcByCenterAndAngle(Point start, Point center, double degrees, bool clockwise);
Arc ArcThrough(Point start, Point via, Point end);
/// Leaves the start in the direction (not null).
Arc ArcByTangent(Point start, Point direction, Point end);

/// Direction of motion at a point of an arc, length 1.
Point DirectionAt(Point point, Point center, bool clockwise);
/// Angle that the arc sweeps, 0..360 degrees (0 only if start and end are one point).
double SweepOf(Point start, Point end, Point center, bool clockwise);

}  // namespace ncport::exec
